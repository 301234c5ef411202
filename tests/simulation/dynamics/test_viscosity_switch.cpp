#include "simulation/sph/dynamics/viscosity_switch.h"

#include <gtest/gtest.h>

using namespace fx::sim;

namespace {
const SwitchRules<double> kRules{0.05, 2.0, 0.1};
}

TEST(ViscositySwitch, jumpsToTheLargestWhereConvergenceGrowsFast)
{
    EXPECT_EQ(switchedViscosity(kRules, {-10.0, -1e6, 0.0, 0.1, 1.0}, 0.05, 1e-3), 2.0);
}

TEST(ViscositySwitch, followsTheGrowthOfConvergenceInBetween)
{
    // 10 h^2 times the growth over c^2 = 10 * 0.01 * 4 / 1
    EXPECT_NEAR(switchedViscosity(kRules, {-1.0, -4.0, 0.0, 0.1, 1.0}, 0.05, 1e-3), 0.4, 1e-12);
    // the same with as much shear as compression: half
    EXPECT_NEAR(switchedViscosity(kRules, {-1.0, -4.0, 1.0, 0.1, 1.0}, 0.05, 1e-3), 0.2, 1e-12);
}

TEST(ViscositySwitch, staysDownInShearAndExpansion)
{
    EXPECT_EQ(switchedViscosity(kRules, {0.0, -1e6, 50.0, 0.1, 1.0}, 0.05, 1e-3), 0.05);
    EXPECT_EQ(switchedViscosity(kRules, {10.0, -1e6, 0.0, 0.1, 1.0}, 0.05, 1e-3), 0.05);
    EXPECT_EQ(switchedViscosity(kRules, {-10.0, 1e6, 0.0, 0.1, 1.0}, 0.05, 1e-3), 0.05);
}

TEST(ViscositySwitch, decaysWithinTheTimeItIsGiven)
{
    double alpha = 2.0;
    const double tau = 0.1 / (0.1 * 3.0); // h / (l c)
    for (int i = 0; i < 10000; ++i)
        alpha = switchedViscosity(kRules, {0.0, 0.0, 0.0, 0.1, 3.0}, alpha, tau / 10000);
    EXPECT_NEAR(alpha, 0.05 + 1.95 * std::exp(-1.0), 1e-4);
}

TEST(ViscositySwitch, isBoundedWithoutSound)
{
    EXPECT_EQ(switchedViscosity(kRules, {-1.0, -1.0, 0.0, 0.1, 0.0}, 0.05, 1.0), 2.0);
    EXPECT_EQ(firstViscosity(kRules, {-1.0, 0.0, 0.0, 0.1, 0.0}), 2.0);
    EXPECT_EQ(firstViscosity(kRules, {1.0, 0.0, 0.0, 0.1, 0.0}), 0.05);
}

TEST(ShearLimiter, isOneInCompressionAndNothingInShear)
{
    EXPECT_NEAR(shearLimiter(FlowGradient<double>{-5.0, 0.0, 0.0, 1.0, 1.0}), 1.0, 1e-4);
    EXPECT_EQ(shearLimiter(FlowGradient<double>{0.0, 0.0, 5.0, 1.0, 1.0}), 0.0);
    EXPECT_EQ(shearLimiter(FlowGradient<double>{5.0, 0.0, 5.0, 1.0, 1.0}), 1.0); // disorder
    EXPECT_NEAR(shearLimiter(FlowGradient<double>{1.0, 0.0, 99.0, 1.0, 1.0}), 0.1, 1e-4);
    EXPECT_EQ(shearLimiter(FlowGradient<double>{0.0, 0.0, 0.0, 1.0, 0.0}), 1.0);
}
