#include "simulation/verification/shear_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

const double kWavenumber = 4 * std::numbers::pi;

TEST(ShearLayer, twoToOneStreamsGrowAtThePublishedRate)
{
    const ShearLayer layer{kWavenumber, 2, 1, 0.5, -0.5, 1e3, 1e3};
    EXPECT_NEAR(layer.incompressibleGrowth(), 5.92, 0.005);
    EXPECT_NEAR(layer.growth(), layer.incompressibleGrowth(), 1e-5);
}

TEST(ShearLayer, compressibilitySlowsTheGrowth)
{
    const double gamma = 5.0 / 3.0;
    const ShearLayer layer{kWavenumber, 2, 1, 0.5, -0.5, std::sqrt(gamma * 2.5 / 2), std::sqrt(gamma * 2.5)};
    EXPECT_LT(layer.growth(), layer.incompressibleGrowth());
    EXPECT_GT(layer.growth(), 0.9 * layer.incompressibleGrowth());
}

TEST(ShearLayer, twinStreamsFollowTheClosedFormOfTheVortexSheet)
{
    // Equal gases: w^2 = k^2 c^2 (1 + M^2 - sqrt(1 + 4 M^2)), M = U / c, for streams +U and -U.
    const double mach = 0.6;
    const ShearLayer layer{1, 1, 1, mach, -mach, 1, 1};
    const double expected = std::sqrt(std::sqrt(1 + 4 * mach * mach) - 1 - mach * mach);
    EXPECT_NEAR(layer.growth(), expected, 1e-10);
}

} // namespace
} // namespace fx::sim
