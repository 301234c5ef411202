#include "simulation/verification/flow_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fx::sim {
namespace {

TEST(FlowErrors, aParticleCountsByItsVolume)
{
    // 3 m3 with an error of 1 and 1 m3 with an error of 5.
    const std::vector<ProfilePoint> points = {{0, 6, {2, 1, 4}}, {0, 8, {8, 1, 4}}};
    CaseMeasures measures;
    storeErrors(
        points, 1, {1, 2, 4},
        [](double) {
            return FlowState{3, 0, 4};
        },
        measures);
    EXPECT_DOUBLE_EQ(measures.l1Density, (3 * 1 + 1 * 5) / 4.0);
    EXPECT_DOUBLE_EQ(measures.l1Velocity, 0.5);
    EXPECT_DOUBLE_EQ(measures.l1Pressure, 0);
    ASSERT_EQ(measures.densityErrors.size(), 2u);
    EXPECT_DOUBLE_EQ(measures.densityErrors[0].error, -1);
    EXPECT_DOUBLE_EQ(measures.densityErrors[0].volume, 3);
}

TEST(FlowErrors, whatIsFartherThanTheRadiusDoesNotCount)
{
    const std::vector<ProfilePoint> points = {{0.5, 1, {1, 0, 1}}, {2, 1, {100, 0, 1}}};
    CaseMeasures measures;
    storeErrors(
        points, 1, {1, 1, 1},
        [](double) {
            return FlowState{1, 0, 1};
        },
        measures);
    EXPECT_EQ(measures.l1Density, 0);
}

std::vector<ProfilePoint> pointsOn(double length, double (*density)(double))
{
    std::vector<ProfilePoint> points;
    for (int i = 0; i < 10'000; ++i) {
        const double x = length * (i + 0.5) / 10'000;
        points.push_back({x, 1, {density(x), 0, 0}});
    }
    return points;
}

TEST(FlowErrors, aSmearedJumpKeepsItsPlace)
{
    const auto jump = [](double x) { return 1 + 3 / (1 + std::exp((x - 0.6) / 0.02)); };
    EXPECT_NEAR(shockRadius(shellsOf(pointsOn(1, jump), 0.01), 1), 0.6, 0.002);
}

TEST(FlowErrors, aPeakIsFoundBetweenShells)
{
    const auto peak = [](double x) { return 2 - 40 * (x - 0.4321) * (x - 0.4321); };
    EXPECT_NEAR(densestRadius(shellsOf(pointsOn(0.6, peak), 0.02)), 0.4321, 1e-3);
}

TEST(FlowErrors, shellsHoldTheMeansOfTheirParticles)
{
    const std::vector<ProfilePoint> points = {{0.1, 1, {1, 2, 3}}, {0.15, 1, {3, 4, 5}}, {0.5, 1, {7, 8, 9}}};
    const std::vector<Shell> shells = shellsOf(points, 0.2);
    ASSERT_EQ(shells.size(), 3u);
    EXPECT_EQ(shells[0].count, 2u);
    EXPECT_DOUBLE_EQ(shells[0].state.density, 2);
    EXPECT_DOUBLE_EQ(shells[0].state.velocity, 3);
    EXPECT_EQ(shells[1].count, 0u);
    EXPECT_DOUBLE_EQ(shells[2].state.pressure, 9);
    EXPECT_DOUBLE_EQ(shells[2].place, 0.5);
}

TEST(FlowErrors, gasWithoutAShockHasNone)
{
    const auto even = [](double) { return 1.0; };
    EXPECT_EQ(shockRadius(shellsOf(pointsOn(1, even), 0.1), 1), 0);
    EXPECT_EQ(shockRadius({}, 1), 0);
    EXPECT_EQ(densestRadius({}), 0);
}

} // namespace
} // namespace fx::sim
