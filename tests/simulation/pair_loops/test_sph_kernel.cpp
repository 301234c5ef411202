#include "simulation/sph/pair_loops/sph_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace {

using namespace fx::sim;

constexpr double kPi = std::numbers::pi;

class EachKernel : public testing::TestWithParam<SphKernel>
{};

INSTANTIATE_TEST_SUITE_P(SphKernel, EachKernel, testing::ValuesIn(kSphKernels), [](const auto& kernel) {
    std::string name(kernelFacts(kernel.param).name);
    std::erase(name, '-');
    return name;
});

TEST_P(EachKernel, integratesToOneOverItsSupport)
{
    const double H = 0.7;
    const int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double r = (i + 0.5) * H / steps;
        sum += 4 * kPi * r * r * kernelValue(GetParam(), r, H) * H / steps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-8);
}

TEST_P(EachKernel, endsAtItsSupport)
{
    for (const double r : {2.0, 2.5, 1e6}) {
        EXPECT_EQ(kernelValue(GetParam(), r, 2.0), 0.0);
        EXPECT_EQ(kernelSlope(GetParam(), r, 2.0), 0.0);
        EXPECT_EQ(kernelSupportSlope(GetParam(), r, 2.0), 0.0);
    }
    EXPECT_GT(kernelValue(GetParam(), 1.99, 2.0), 0.0);
}

TEST_P(EachKernel, hasTheSlopeOfItsValue)
{
    const double H = 1.3, e = 1e-5;
    for (double r = 0.01; r < 1.28; r += 0.0317) {
        const double slope =
            (kernelValue(GetParam(), r + e, H) - kernelValue(GetParam(), r - e, H)) / (2 * e);
        EXPECT_NEAR(kernelSlope(GetParam(), r, H), slope, 2e-8) << "at r = " << r;
        const double supportSlope =
            (kernelValue(GetParam(), r, H + e) - kernelValue(GetParam(), r, H - e)) / (2 * e);
        EXPECT_NEAR(kernelSupportSlope(GetParam(), r, H), supportSlope, 2e-8) << "at r = " << r;
    }
}

TEST_P(EachKernel, fallsOutwardsFromItsCenter)
{
    const KernelFacts facts = kernelFacts(GetParam());
    EXPECT_NEAR(kernelValue(GetParam(), 0.0, 2.0), facts.norm * facts.center / 8.0, 1e-15);
    EXPECT_EQ(kernelSlope(GetParam(), 0.0, 2.0), 0.0);
    for (double r = 0.01; r < 2.0; r += 0.01)
        EXPECT_LT(kernelSlope(GetParam(), r, 2.0), 0.0) << "at r = " << r;
}

/// The smallest value of the Fourier transform, wave numbers in 1 / H.
double smallestTransform(SphKernel kernel)
{
    double smallest = 1;
    for (double k = 0.5; k < 60; k += 0.1) {
        double sum = 0;
        const int steps =
            2000; // Simpson: the transform of a smooth kernel falls far below the midpoint rule's error
        for (int i = 0; i <= steps; ++i) {
            const double q = double(i) / steps;
            const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
            sum += weight * q * kernelValue(kernel, q, 1.0) * std::sin(k * q);
        }
        smallest = std::min(smallest, 4 * kPi / k * sum / (3.0 * steps));
    }
    return smallest;
}

TEST_P(EachKernel, mayPushAnyNumberOfNeighborsOnlyIfItsTransformIsNowhereNegative)
{
    const double smallest = smallestTransform(GetParam());
    if (std::isinf(kernelFacts(GetParam()).largestNeighbors))
        EXPECT_GE(smallest, -1e-11);
    else
        EXPECT_LT(smallest, -1e-4);
}

TEST(SphKernel, transformsOfTheUnstableOnesHaveTheirKnownMinima)
{
    EXPECT_NEAR(smallestTransform(SphKernel::Quartic), -2.15e-2, 1e-3);
    EXPECT_NEAR(smallestTransform(SphKernel::Sextic), -1.2e-2, 1e-3);
    EXPECT_NEAR(smallestTransform(SphKernel::Octic), -6.9e-3, 5e-4);
}

TEST(SphKernel, statesHowManyNeighborsItsForcesBear)
{
    EXPECT_TRUE(std::isinf(kernelFacts(SphKernel::WendlandC2).largestNeighbors));
    EXPECT_TRUE(std::isinf(kernelFacts(SphKernel::WendlandC4).largestNeighbors));
    EXPECT_EQ(kernelFacts(SphKernel::CubicSpline).largestNeighbors, 50.0);
    EXPECT_EQ(kernelFacts(SphKernel::Quartic).largestNeighbors, 0.0);
}

TEST(SphKernel, namesAreUnique)
{
    std::set<std::string_view> names;
    for (const SphKernel kernel : kSphKernels)
        names.insert(kernelFacts(kernel).name);
    EXPECT_EQ(names.size(), kSphKernels.size());
}

TEST(SphKernel, selfBiasFollowsItsPowerLaw)
{
    EXPECT_NEAR(selfBias(SphKernel::WendlandC2, 100), 0.0294, 1e-12);
    EXPECT_NEAR(selfBias(SphKernel::WendlandC2, 58), 0.0294 * std::pow(0.58, -0.977), 1e-12);
    EXPECT_NEAR(selfBias(SphKernel::WendlandC4, 200), 0.01342 * std::pow(2.0, -1.579), 1e-12);
    EXPECT_EQ(selfBias(SphKernel::CubicSpline, 50), 0.0);
    EXPECT_EQ(selfBias(SphKernel::Quartic, 50), 0.0);
    EXPECT_LE(selfBias(SphKernel::WendlandC2, 0.0), 0.5);
}

} // namespace
