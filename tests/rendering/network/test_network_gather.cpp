// What an eye sees of the light in a network.
#include "rendering/network/network_gather.h"
#include "rendering/network/network_light.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/network/network_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

/// Radiance of a ray through the middle of an even cube along z, with `behind` behind it.
double seenThrough(const NetworkCase& c, const ScatteringNetwork& network, const NetworkState& state,
                   double behind)
{
    const double k = double(c.extinction[0]), albedo = double(c.albedo[0]);
    const double share = network.phase().extinctionShare(albedo);
    const GatherMoments moments(network.phase(), state);
    const auto weights = moments.weights({0.0, 0.0, 1.0});
    constexpr int kSteps = 400;
    double light = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double s = (i + 0.5) / kSteps;
        light += std::exp(-share * k * s) * k / kSteps * albedo * moments.at({0.5, 0.5, 1.0 - s}, weights);
    }
    return light + std::exp(-share * k) * behind;
}

} // namespace

TEST(NetworkGather, ofAWhiteMediumInAWhiteRoomIsTheRoom)
{
    for (const NetworkSettings& form :
         {NetworkSettings{26, 4, 0.0}, {26, 4, 0.8}, {26, 9, 0.8}, {14, 9, 0.6}}) {
        NetworkCase c = evenCase(glm::ivec3(10), 3.0f, 1.0f, form);
        c.environment.assign(size_t(form.directions), 1.0f);
        ScatteringNetwork network;
        c.give(network);
        NetworkState state;
        network.sweep({300, 3, 1e-7}, state, *base::makeSerialRunner());
        EXPECT_NEAR(seenThrough(c, network, state, 1.0), 1.0, 1e-4)
            << form.directions << " " << form.anisotropy;
    }
}

TEST(NetworkGather, momentsAreWeightedByHarmonicsOfTheDirectionToTheEye)
{
    // formula (1) with light interpolated one moment after another, also outside of the grid
    for (const int moments : {4, 9}) {
        const NetworkPhase phase = networkPhase(0.6, moments);
        NetworkState state{{{-0.3, 0.2, 0.1}, 0.4, {3, 4, 5}}, moments, {}};
        for (size_t i = 0; i < size_t(moments) * state.grid.count(); ++i)
            state.light.push_back(i < state.grid.count() ? 9.0f : std::sin(0.7f * float(i)));
        const GatherMoments gather(phase, state);
        for (const glm::dvec3& toEye : {glm::dvec3(0.48, 0.6, -0.64), {0.0, -1.0, 0.0}})
            for (const glm::dvec3& place : {glm::dvec3(0.31, 0.77, 1.33), {-5.0, 0.9, 9.0}, {0.4, 0.4, 0.6}})
            {
                const auto y = harmonics(toEye);
                double sum = 0.0;
                for (size_t k = 0; k < size_t(moments); ++k)
                    sum += phase.factors[size_t(harmonicBand(int(k)))] * y[k] *
                           interpolated(state.light.data() + k * state.grid.count(), state.grid, place);
                EXPECT_NEAR(gather.at(place, gather.weights(toEye)), (1.0 - phase.peak) * sum, 2e-6)
                    << moments;
            }
    }
}

TEST(NetworkGather, ofIsotropicScatteringIsExactSingleScattering)
{
    for (const double eyeDepth : {0.0, 3.0}) {
        const GatheredLight light = gatherUnscattered({networkPhase(0.0, 4), 0.3}, {0.9, 2.0, eyeDepth, 4.0});
        EXPECT_NEAR(light.plain, 0.0, 1e-12);
        EXPECT_NEAR(light.scaled, 4.0 * std::exp(-2.0) * 0.9 / (4.0 * std::numbers::pi), 1e-6);
    }
}

TEST(NetworkGather, inThinMediaIsExactSingleScatteringWithTheWholePhaseFunction)
{
    for (const int moments : {4, 9})
        for (const double g : {-0.3, 0.4, 0.85, 0.95})
            for (const double cosine : {-1.0, 0.0, 0.9, 1.0}) {
                const GatheredLight light =
                    gatherUnscattered({networkPhase(g, moments), cosine}, {0.95, 0.0, 0.0, 1.0});
                EXPECT_NEAR(light.plain + light.scaled, 0.95 * formula64::fxHenyeyGreenstein(cosine, g),
                            1e-9);
            }
}

TEST(NetworkGather, hasTheLightThatIsScatteredTwiceThroughSmallAngles)
{
    // of all orders, the share of the second is that of the derivative by albedo^2 at albedo 0
    const NetworkPhase phase = networkPhase(0.85, 9);
    const double depth = 1.5, step = 1e-3, c = 0.98;
    const auto both = [&](double albedo) {
        const GatheredLight light = gatherUnscattered({phase, c}, {albedo, depth, 0.0, 1.0});
        return light.plain + light.scaled;
    };
    const double second = (both(2.0 * step) - 2.0 * both(step)) / (2.0 * step * step);
    const double f = phase.peak, twice = (1.0 - f) * (1.0 - f);
    double network = 0.0; // light that the network scatters twice, in the bands of the series
    const double legendre[3] = {1.0, 3.0 * c, 5.0 * (1.5 * c * c - 0.5)};
    for (size_t l = 0; l < 3; ++l)
        network += legendre[l] * twice * phase.factors[l] * phase.factors[l] / (4.0 * std::numbers::pi);
    const double whole = formula64::fxHenyeyGreenstein(c, 0.85 * 0.85);
    EXPECT_NEAR(second / (std::exp(-depth) * depth / 2.0), whole - network, 0.02 * whole);
}

TEST(NetworkGather, isNeverNegative)
{
    for (const double g : {-0.3, 0.3, 0.7, 0.9})
        for (const double cosine : {-1.0, -0.5, 0.0, 0.5, 1.0})
            for (const double depth : {0.0, 1.0, 20.0, 1000.0})
                for (const double eyeDepth : {0.0, 2.0, 30.0}) {
                    const NetworkPhase phase = networkPhase(g, 9);
                    const GatheredLight light =
                        gatherUnscattered({phase, cosine}, {1.0, depth, eyeDepth, 1.0});
                    EXPECT_GE(light.scaled, 0.0);
                    EXPECT_GE(light.plain + light.scaled * std::exp(phase.peak * eyeDepth), -1e-12);
                }
}
