// Light that reaches a network unscattered.
#include "rendering/network/network_light.h"
#include "tests/foundation/real_threads.h"
#include "tests/rendering/network/network_cases.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

/// [lx m2 sr^-1] power that the medium of albedo 1 scatters for the first time.
double firstPower(ScatteringNetwork& network, base::TaskRunner& tasks)
{
    return network.energy({}, tasks).emitted;
}

} // namespace

TEST(NetworkLight, opticalDepthIsThatOfTheCellsOnTheWay)
{
    NetworkCase c = evenCase({10, 5, 4}, 2.0f, 0.5f);
    c.grid.corner = {-3.0, 1.0, 2.0};
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 20; ++j)
            c.extinction[size_t(i + 10 * j)] = float(i); // grows along x
    ScatteringNetwork network;
    c.give(network);
    const auto depth = [&](glm::dvec3 from, glm::dvec3 to) {
        return network.opticalDepth(from, glm::normalize(to - from), glm::distance(from, to));
    };
    EXPECT_NEAR(depth({-3.0, 1.25, 2.2}, {-2.0, 1.25, 2.2}), 4.5, 1e-9) << "all of it";
    EXPECT_NEAR(depth({-9.0, 1.25, 2.2}, {9.0, 1.25, 2.2}), 4.5, 1e-9) << "from outside";
    EXPECT_NEAR(depth({-2.75, 1.25, 2.2}, {-2.65, 1.25, 2.2}), 0.05 * 2 + 0.05 * 3, 1e-9);
    EXPECT_NEAR(depth({-2.65, 1.25, 2.2}, {-2.75, 1.25, 2.2}), 0.05 * 2 + 0.05 * 3, 1e-9) << "backwards";
    EXPECT_NEAR(depth({-2.95, 1.05, 2.05}, {-2.75, 1.25, 2.25}),
                std::sqrt(3.0) * (0.05 * 0 + 0.1 * 1 + 0.05 * 2), 1e-9);
    EXPECT_EQ(depth({-9.0, 0.0, 2.2}, {9.0, 0.0, 2.2}), 0.0) << "past it";
    EXPECT_EQ(depth({-3.5, 1.25, 2.2}, {-3.1, 1.25, 2.2}), 0.0) << "before it";
}

TEST(NetworkLight, ofASunIsWhatTheMediumTakesOfItsBeam)
{
    const auto tasks = base::makeSerialRunner();
    for (const float depth : {0.1f, 3.0f}) {
        NetworkCase c = evenCase(glm::ivec3(16), depth, 1.0f);
        ScatteringNetwork network;
        c.give(network);
        addSun(network, {{0.0, 0.0, -1.0}, 5.0}, 2, *tasks);
        const double taken = 5.0 * (1.0 - std::exp(-double(depth))); // on 1 m2
        EXPECT_NEAR(firstPower(network, *tasks) / taken, 1.0, 2e-3) << depth;
    }
}

TEST(NetworkLight, ofALampInsideIsAllThatDoesNotEscape)
{
    const auto tasks = base::makeSerialRunner();
    for (const float depth : {0.5f, 8.0f})
        for (const glm::dvec3 place : {glm::dvec3(0.5), glm::dvec3(0.41, 0.52, 0.37)}) {
            NetworkCase c = evenCase(glm::ivec3(20), depth, 1.0f);
            ScatteringNetwork network;
            c.give(network);
            addLamp(network, {place, 0.0, 2.0}, 2, *tasks);
            double escaped = 0.0; // by rays from the lamp to all sides
            constexpr int kRays = 20000;
            for (int i = 0; i < kRays; ++i) {
                const double z = 1.0 - 2.0 * (i + 0.5) / kRays, r = std::sqrt(1.0 - z * z),
                             a = 2.39996323 * i;
                escaped +=
                    std::exp(-network.opticalDepth(place, {r * std::cos(a), r * std::sin(a), z}, 10.0)) /
                    kRays;
            }
            EXPECT_NEAR(firstPower(network, *tasks) / (2.0 * kSphere * (1.0 - escaped)), 1.0, 0.02)
                << depth << " " << place.x;
        }
}

TEST(NetworkLight, withoutTheForwardPeakMeetsLessMedium)
{
    const auto tasks = base::makeSerialRunner();
    NetworkCase c = evenCase(glm::ivec3(12), 4.0f, 1.0f, {26, 9, 0.8});
    ScatteringNetwork network;
    c.give(network);
    addSun(network, {{1.0, 0.0, 0.0}, 1.0}, 3, *tasks);
    const double share = network.phase().extinctionShare(1.0);
    EXPECT_LT(share, 0.6);
    EXPECT_NEAR(firstPower(network, *tasks) / (1.0 - std::exp(-4.0 * share)), 1.0, 2e-3);
}

TEST(NetworkLight, hasTheSameBitsForAnyNumberOfWorkers)
{
    const RealThreads threads(16);
    const NetworkCase c = randomCase(3, glm::ivec3(9, 8, 7));
    const auto lit = [&](base::TaskRunner& tasks) {
        ScatteringNetwork network;
        c.give(network);
        addSun(network, {glm::normalize(glm::dvec3(1.0, -2.0, 0.4)), 1.0}, 2, tasks);
        addLamp(network, {c.grid.middle({4, 4, 4}), 0.1, 3.0}, 2, tasks);
        NetworkState state;
        network.sweep({2, 0, 0.0}, state, tasks);
        return state.light;
    };
    const std::vector<float> one = lit(*base::makeSerialRunner());
    for (const uint32_t workers : {2u, 7u, 16u})
        EXPECT_EQ(lit(*base::makeTbbRunner(workers)), one) << workers;
}
