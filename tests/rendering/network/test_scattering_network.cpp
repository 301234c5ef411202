// Light at rest in a network: furnace, balance of energy, nowhere negative, bounds, symmetry, same bits.
#include "tests/foundation/real_threads.h"
#include "tests/rendering/network/network_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

const std::array<NetworkSettings, 6> kForms{
    {{26, 4, 0.0}, {14, 4, 0.0}, {6, 4, 0.0}, {26, 4, 0.8}, {26, 9, 0.8}, {14, 9, 0.8}}};

std::unique_ptr<base::TaskRunner> serial()
{
    return base::makeSerialRunner();
}

/// Mean radiance of a cell.
double meanOf(const NetworkState& state, size_t cell)
{
    return double(state.light[cell]) / std::sqrt(kSphere);
}

SweepReport toRest(ScatteringNetwork& network, NetworkState& state, double tolerance = 1e-7, int sweeps = 400)
{
    return network.sweep({sweeps, 3, tolerance}, state, *serial());
}

/// A ball of medium that is dense in the middle, within 12^3 cells.
NetworkCase lump(const NetworkSettings& settings, float depth, float albedo)
{
    NetworkCase c = evenCase(glm::ivec3(12), depth, albedo, settings);
    for (int i = 0; i < 12 * 12 * 12; ++i) {
        const glm::dvec3 p = c.grid.middle({i % 12, i / 12 % 12, i / 144}) - 0.5;
        c.extinction[size_t(i)] *= float(std::max(0.0, 1.0 - 4.0 * (p.x * p.x + p.y * p.y + p.z * p.z)));
    }
    return c;
}

} // namespace

TEST(ScatteringNetwork, inAFurnaceIsOneEverywhere)
{
    for (const NetworkSettings& form : kForms)
        for (const float depth : {1.0f, 20.0f}) {
            NetworkCase c = lump(form, depth, 1.0f);
            c.environment.assign(size_t(form.directions), 1.0f);
            ScatteringNetwork network;
            c.give(network);
            NetworkState state;
            toRest(network, state);
            for (size_t i = 0; i < c.grid.count(); ++i)
                ASSERT_NEAR(meanOf(state, i), 1.0, 1e-4)
                    << form.directions << " " << form.moments << " " << depth;
            for (size_t i = c.grid.count(); i < state.light.size(); ++i)
                ASSERT_NEAR(state.light[i], 0.0f, 1e-4f) << "no direction is brighter";
        }
}

TEST(ScatteringNetwork, ofAMediumInEquilibriumWithItsWallsIsThatOfTheWalls)
{
    for (const NetworkSettings& form : kForms) {
        NetworkCase c = randomCase(7, glm::ivec3(9, 7, 8), 0.98);
        c.settings = form;
        for (size_t i = 0; i < c.grid.count(); ++i)
            c.emission[i] = 3.0f * (1.0f - c.albedo[i]); // Kirchhoff
        c.environment.assign(size_t(form.directions), 3.0f);
        ScatteringNetwork network;
        c.give(network);
        NetworkState state;
        toRest(network, state);
        for (size_t i = 0; i < c.grid.count(); ++i)
            ASSERT_NEAR(meanOf(state, i), 3.0, 3e-4);
    }
}

TEST(ScatteringNetwork, losesAndMakesNoLight)
{
    for (const NetworkSettings& form : kForms)
        for (uint64_t seed = 0; seed < 6; ++seed) {
            NetworkCase c = randomCase(seed, glm::ivec3(8, 9, 7), seed % 2 ? 1.0 : 0.9);
            c.settings = form;
            c.environment.assign(size_t(form.directions), seed < 3 ? 0.0f : 0.2f);
            ScatteringNetwork network;
            c.give(network);
            for (size_t cell = 0; cell < c.grid.count(); cell += 5)
                network.addDirect(cell, harmonics({0.6, -0.8, 0.0}));
            NetworkState state;
            toRest(network, state);
            const NetworkEnergy energy = network.energy(state, *serial());
            EXPECT_GT(energy.emitted, 0.0);
            EXPECT_NEAR((energy.absorbed + energy.escaped) / energy.emitted, 1.0, 1e-5)
                << form.directions << " " << form.moments << " " << seed;
        }
}

TEST(ScatteringNetwork, isOffByNoMoreThanItsBoundAfterAnySweep)
{
    int looked = 0;
    double tightest = 1e30;
    for (uint64_t seed = 0; seed < 10000; ++seed) {
        const NetworkCase c =
            randomCase(seed, glm::ivec3(2, 1 + int(seed % 3), 1 + int(seed % 2)), seed % 4 == 0 ? 1.0 : 0.99);
        ScatteringNetwork network;
        c.give(network);
        const std::vector<double> exact = solvedExactly(c);
        NetworkState state;
        for (int sweep = 0; sweep < 3; ++sweep) {
            const SweepReport report = network.sweep({1, int(seed % 5), 0.0}, state, *serial());
            const double error = scatteredError(c, state.light, exact);
            double scattered =
                0.0; // the report's share is of the present light, that of the error of the last
            for (size_t i = 0; i < c.grid.count(); ++i)
                scattered += exact[i];
            if (scattered == 0.0)
                continue;
            const double share = report.bound;
            ASSERT_LE(error, (share + 1e-5) * (1.0 + error)) << seed << " sweep " << sweep;
            tightest = std::min(tightest, share / std::max(error, 1e-6));
            ++looked;
        }
    }
    EXPECT_GT(looked, 20000);
    EXPECT_LT(tightest, 3.0) << "a bound that says nothing would pass";
}

TEST(ScatteringNetwork, comesToTheSolutionByElimination)
{
    for (uint64_t seed = 0; seed < 12; ++seed) {
        const NetworkCase c = randomCase(seed, glm::ivec3(4, 3, 4));
        ScatteringNetwork network;
        c.give(network);
        NetworkState state;
        const SweepReport report = toRest(network, state, 1e-6);
        EXPECT_TRUE(report.isConverged);
        EXPECT_LE(scatteredError(c, state.light, solvedExactly(c)), report.bound + 1e-5) << seed;
        EXPECT_LE(scatteredError(c, state.light, solvedExactly(c)), 1e-3) << seed;
    }
}

TEST(ScatteringNetwork, isNowhereNegative)
{
    for (const double g : {-0.9, 0.0, 0.4, 0.7, 0.85, 0.95, 1.0})
        for (const int moments : {4, 9})
            for (const int directions : {14, 26}) {
                NetworkCase c = lump({directions, moments, g}, 40.0f, 1.0f);
                ScatteringNetwork network;
                c.give(network);
                const auto beam = harmonics({0.0, 0.0, -1.0});
                network.addDirect(c.grid.index({6, 6, 10}), beam);
                NetworkState state;
                for (int sweep = 0; sweep < 12; ++sweep) {
                    network.sweep({1, 4, 0.0}, state, *serial());
                    for (size_t i = 0; i < c.grid.count(); ++i)
                        ASSERT_GE(state.light[i], 0.0f);
                    const NetworkPhase& phase = network.phase();
                    for (size_t i = 0; i < c.grid.count(); ++i) // what any eye sees of it
                        for (int eye = 0; eye < 20; ++eye) {
                            const double z = -1.0 + (eye + 0.5) / 10.0, a = 2.4 * eye,
                                         r = std::sqrt(1.0 - z * z);
                            const auto y = harmonics({r * std::cos(a), r * std::sin(a), z});
                            double seen = 0.0;
                            for (int k = 0; k < moments; ++k)
                                seen += phase.factors[size_t(harmonicBand(k))] * y[size_t(k)] *
                                        double(state.light[size_t(k) * c.grid.count() + i]);
                            ASSERT_GE(seen, -1e-6 * double(state.light[i])) << g << " " << moments;
                        }
                }
            }
}

TEST(ScatteringNetwork, inAnEvenMediumFallsAsTheExponentialOfTheWay)
{
    // light from outside, no scattering: the mean over a cell of exp(-k z / cos)
    NetworkCase c = evenCase({1, 1, 40}, 8.0f, 0.0f);
    c.grid.side = 1.0 / 40.0;
    for (const NeighborDirection& d : neighborDirections(26))
        c.environment.push_back(d.step == glm::ivec3(0, 0, 1) ? 1.0f : 0.0f);
    ScatteringNetwork network;
    c.give(network);
    NetworkState state;
    network.sweep({1, 0, 0.0}, state, *serial());
    const double weight = kSphere / 21.0;
    for (int z = 0; z < 40; ++z) {
        const double tau = 8.0 / 40.0;
        const double exact = std::exp(-tau * z) * (1.0 - std::exp(-tau)) / tau;
        EXPECT_NEAR(double(state.light[size_t(z)]) * std::sqrt(kSphere) / weight, exact, 1e-6) << z;
    }
}

TEST(ScatteringNetwork, ofASymmetricMediumIsSymmetric)
{
    for (const NetworkSettings& form : kForms) {
        NetworkCase c = lump(form, 10.0f, 0.95f);
        c.emission.assign(c.grid.count(), 1.0f);
        ScatteringNetwork network;
        c.give(network);
        NetworkState state;
        toRest(network, state);
        const double most =
            double(*std::max_element(state.light.begin(), state.light.begin() + 12 * 12 * 12));
        for (int i = 0; i < 12 * 12 * 12; ++i) {
            const glm::ivec3 p(i % 12, i / 12 % 12, i / 144);
            for (const glm::ivec3 q : {glm::ivec3(11 - p.x, p.y, p.z), glm::ivec3(p.y, p.x, p.z),
                                       glm::ivec3(p.z, p.y, p.x), glm::ivec3(p.x, 11 - p.y, p.z)})
                ASSERT_NEAR(state.light[size_t(i)], state.light[c.grid.index(q)], 1e-5 * most);
        }
    }
}

TEST(ScatteringNetwork, hasTheReciprocityOfLight)
{
    // what a cell takes of the light of another, over what that would take of its
    NetworkCase c = randomCase(21, glm::ivec3(5, 4, 6), 0.95);
    for (const double g : {0.0, 0.7}) {
        c.settings = {26, 9, g};
        c.environment.clear();
        const size_t a = c.grid.index({1, 0, 2}), b = c.grid.index({3, 3, 4});
        c.extinction[a] = 2.0f;
        c.extinction[b] = 0.4f;
        c.albedo[a] = 0.3f;
        c.albedo[b] = 0.7f;
        const auto received = [&](size_t from, size_t to) {
            c.emission.assign(c.grid.count(), 0.0f);
            c.emission[from] = 1.0f;
            ScatteringNetwork network;
            c.give(network);
            NetworkState state;
            toRest(network, state);
            return meanOf(state, to) * double(c.extinction[to]);
        };
        const double there = received(a, b), back = received(b, a);
        EXPECT_GT(there, 0.0);
        EXPECT_NEAR(there / double(c.extinction[b] * c.extinction[a]),
                    back / double(c.extinction[a] * c.extinction[b]), 2e-5 * there);
    }
}

TEST(ScatteringNetwork, hasTheSameBitsForAnyNumberOfWorkers)
{
    const RealThreads threads(16);
    NetworkCase c = lump({26, 9, 0.6}, 15.0f, 0.99f);
    c.emission.assign(c.grid.count(), 0.01f);
    std::vector<float> first;
    for (uint32_t workers = 1; workers <= 16; ++workers) {
        ScatteringNetwork network;
        c.give(network);
        NetworkState state;
        const auto tasks = base::makeTbbRunner(workers);
        network.sweep({7, 3, 0.0}, state, *tasks);
        if (first.empty())
            first = state.light;
        ASSERT_EQ(state.light, first) << workers;
    }
    ScatteringNetwork network;
    c.give(network);
    NetworkState state;
    network.sweep({7, 3, 0.0}, state, *serial());
    EXPECT_EQ(state.light, first);
}

TEST(ScatteringNetwork, comesToRestSoonerWithAcceleration)
{
    NetworkCase c = lump({}, 30.0f, 0.99f);
    c.emission.assign(c.grid.count(), 1.0f);
    const auto sweeps = [&](int acceleration) {
        ScatteringNetwork network;
        c.give(network);
        NetworkState state;
        return network.sweep({500, acceleration, 1e-5}, state, *serial()).sweeps;
    };
    const int plain = sweeps(0), mixed = sweeps(2);
    EXPECT_LT(2 * mixed, plain);
}

TEST(ScatteringNetwork, thatRestsSweepsNoMoreUntilSomethingChanges)
{
    NetworkCase c = lump({}, 5.0f, 0.9f);
    c.emission.assign(c.grid.count(), 1.0f);
    ScatteringNetwork network;
    c.give(network);
    NetworkState state;
    EXPECT_GT(toRest(network, state, 1e-4).sweeps, 3);
    const std::vector<float> rest = state.light;
    EXPECT_EQ(toRest(network, state, 1e-4).sweeps, 0);
    EXPECT_EQ(state.light, rest);
    network.addDirect(c.grid.index({6, 6, 6}), harmonics({1.0, 0.0, 0.0}));
    EXPECT_GT(toRest(network, state, 1e-4).sweeps, 0);
    c.give(network);
    EXPECT_GT(toRest(network, state, 1e-4).sweeps, 0);
    state.light[0] += 1.0f; // another state
    EXPECT_GT(toRest(network, state, 1e-4).sweeps, 0);
}

TEST(ScatteringNetwork, fromTheLastFrameComesToTheSameRest)
{
    NetworkCase c = lump({}, 12.0f, 0.95f);
    c.emission.assign(c.grid.count(), 1.0f);
    ScatteringNetwork network;
    c.give(network);
    NetworkState cold, warm;
    toRest(network, cold);
    NetworkCase before = c;
    before.extinction[700] = 3.0f;
    before.grid.corner += 0.3;
    ScatteringNetwork earlier;
    before.give(earlier);
    toRest(earlier, warm);
    const SweepReport report = toRest(network, warm);
    EXPECT_EQ(warm.grid, c.grid);
    for (size_t i = 0; i < cold.light.size(); ++i)
        ASSERT_NEAR(warm.light[i], cold.light[i], (report.bound + 1e-5) * double(cold.light[0]) * 50.0);
}

TEST(ScatteringNetwork, ofNoMediumIsTheLightFromOutside)
{
    NetworkCase c = evenCase(glm::ivec3(3), 0.0f, 1.0f);
    c.environment.assign(26, 0.25f);
    ScatteringNetwork network;
    c.give(network);
    NetworkState state;
    const SweepReport report = toRest(network, state);
    EXPECT_EQ(report.bound, 0.0);
    for (size_t i = 0; i < c.grid.count(); ++i)
        EXPECT_NEAR(meanOf(state, i), 0.25, 1e-6);
}

TEST(ScatteringNetwork, ofAMediumThatNothingPassesIsFinite)
{
    NetworkCase c = evenCase(glm::ivec3(4), 1e10f, 1.0f);
    c.emission.assign(c.grid.count(), 1.0f);
    ScatteringNetwork network;
    c.give(network);
    NetworkState state;
    const SweepReport report = network.sweep({30, 3, 1e-6}, state, *serial());
    EXPECT_GT(report.bound, 0.1) << "it has no end";
    for (const float v : state.light)
        ASSERT_TRUE(std::isfinite(v));
    c.albedo.assign(c.grid.count(), 0.5f);
    c.give(network);
    toRest(network, state);
    EXPECT_NEAR(meanOf(state, 21), 2.0, 1e-4) << "1 / (1 - albedo)";
    c.albedo.assign(c.grid.count(), 0.0f);
    c.give(network);
    toRest(network, state);
    EXPECT_NEAR(meanOf(state, 21), 1.0, 1e-6) << "its own emission";
}

TEST(ScatteringNetwork, refusesWhatIsNotAllowedAndKeepsWhatItHad)
{
    const NetworkCase good = evenCase(glm::ivec3(2), 1.0f, 0.5f);
    ScatteringNetwork network;
    good.give(network);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInf = std::numeric_limits<float>::infinity();
    for (const float albedo : {1.0001f, -0.1f, kNan}) {
        NetworkCase c = good;
        c.albedo[3] = albedo;
        EXPECT_EQ(network.setMedium(c.medium(), c.settings).code(), base::Code::InvalidArgument) << albedo;
    }
    for (const float extinction : {-1.0f, kNan, kInf}) {
        NetworkCase c = good;
        c.extinction[0] = extinction;
        EXPECT_FALSE(network.setMedium(c.medium(), c.settings).ok()) << extinction;
    }
    for (const NetworkSettings& form :
         std::initializer_list<NetworkSettings>{{7, 4, 0.0},
                                                {26, 5, 0.0},
                                                {6, 9, 0.0},
                                                {26, 4, 1.5},
                                                {26, 4, std::numeric_limits<double>::quiet_NaN()}})
        EXPECT_FALSE(network.setMedium(good.medium(), form).ok());
    NetworkCase c = good;
    c.grid.cells.x = 0;
    EXPECT_FALSE(network.setMedium(c.medium(), c.settings).ok());
    c = good;
    c.emission.pop_back();
    EXPECT_FALSE(network.setMedium(c.medium(), c.settings).ok());
    EXPECT_FALSE(network.setEnvironment(std::vector<float>(25, 1.0f)).ok());
    EXPECT_FALSE(network.setEnvironment(std::vector<float>(26, kNan)).ok());
    EXPECT_EQ(network.grid(), good.grid);
    EXPECT_EQ(network.extinction(3), 1.0f);
}
