#include "simulation/verification/noh_implosion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace fx::sim {
namespace {

TEST(NohImplosion, theMonatomicGasIsCompressedSixtyFourfold)
{
    const NohImplosion noh;
    EXPECT_NEAR(noh.at(0.1, 0.6).density, 64, 1e-12);
    EXPECT_NEAR(noh.at(0.1, 0.6).pressure, 64.0 / 3.0, 1e-12);
    EXPECT_NEAR(noh.shockSpeed(), 1.0 / 3.0, 1e-15);
    EXPECT_NEAR(noh.at(0.3, 0.6).density, 9, 1e-12);
}

TEST(NohImplosion, theShockConservesMassMomentumAndEnergy)
{
    for (double gamma : {1.4, 5.0 / 3.0}) {
        const NohImplosion noh{gamma, 2, 3};
        const double time = 0.5;
        const double front = noh.shockSpeed() * time;
        const FlowState in = noh.at(front * (1 - 1e-12), time);
        const FlowState out = noh.at(front * (1 + 1e-12), time);
        const double win = in.velocity - noh.shockSpeed();
        const double wout = out.velocity - noh.shockSpeed();
        EXPECT_NEAR(in.density * win, out.density * wout, 1e-9);
        EXPECT_NEAR(in.density * win * win + in.pressure, out.density * wout * wout, 1e-8);
        EXPECT_NEAR(gamma / (gamma - 1) * in.pressure / in.density + 0.5 * win * win, 0.5 * wout * wout,
                    1e-9);
    }
}

TEST(NohImplosion, theSphereHoldsItsMass)
{
    // What was within 1 at t = 0 is within 1 - t.
    const NohImplosion noh;
    const double time = 0.6;
    double mass = 0;
    const int count = 200'000;
    for (int i = 0; i < count; ++i) {
        const double r = (1 - time) * (i + 0.5) / count;
        mass += noh.at(r, time).density * 4 * std::numbers::pi * r * r * (1 - time) / count;
    }
    EXPECT_NEAR(mass, 4 * std::numbers::pi / 3, 1e-4);
}

} // namespace
} // namespace fx::sim
