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
    constexpr int kSteps = 400;
    double light = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double s = (i + 0.5) / kSteps;
        light += std::exp(-share * k * s) * k / kSteps *
                 gatherScattered(network.phase(), albedo, state, {0.5, 0.5, 1.0 - s}, {0.0, 0.0, 1.0});
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

TEST(NetworkGather, withoutAPeakIsExactSingleScattering)
{
    const NetworkPhase phase = networkPhase(0.0, 4);
    const GatheredLight light = gatherUnscattered(phase, {0.9, 2.0, 0.3, 4.0});
    EXPECT_NEAR(light.plain, 0.0, 1e-12);
    EXPECT_NEAR(light.scaled, 4.0 * std::exp(-2.0) * 0.9 / (4.0 * std::numbers::pi), 1e-6);
}

TEST(NetworkGather, inThinMediaIsExactSingleScatteringWithTheWholePhaseFunction)
{
    for (const int moments : {4, 9})
        for (const double cosine : {-1.0, 0.0, 0.9, 1.0}) {
            const GatheredLight light =
                gatherUnscattered(networkPhase(0.85, moments), {0.95, 0.0, cosine, 1.0});
            EXPECT_NEAR(light.plain + light.scaled, 0.95 * formula64::fxHenyeyGreenstein(cosine, 0.85), 1e-9);
        }
}

TEST(NetworkGather, isNeverNegativeInAllParts)
{
    // the part behind T may be; it is less than the one behind T', which is larger
    for (const double g : {-0.3, 0.3, 0.7, 0.9})
        for (const double cosine : {-1.0, -0.5, 0.0, 0.5, 1.0})
            for (const double depth : {0.0, 1.0, 20.0}) {
                const GatheredLight light = gatherUnscattered(networkPhase(g, 9), {1.0, depth, cosine, 1.0});
                EXPECT_GE(light.scaled + std::min(light.plain, 0.0), -1e-15);
            }
}
