#include "rendering/voxelization/medium_fit.h"
#include "rendering/voxelization/opacity_view.h"
#include "tests/rendering/voxelization/voxel_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace fx::render {
namespace {

constexpr double kVoxel = 0.1; // [m]

MediumGrid gridOf(const std::vector<VoxelBall>& balls)
{
    MediumGrid grid;
    grid.axes = glm::dmat3(kVoxel);
    for (const VoxelBlock& block : voxelize(balls, kVoxel)) {
        grid.blocks.push_back(block.origin);
        grid.density.insert(grid.density.end(), block.density.begin(), block.density.end());
        grid.temperature.insert(grid.temperature.end(), block.temperature.begin(), block.temperature.end());
        grid.flame.insert(grid.flame.end(), block.flame.begin(), block.flame.end());
        grid.velocity.insert(grid.velocity.end(), block.velocity.begin(), block.velocity.end());
    }
    return grid;
}

/// Lumps of several sizes along a spiral.
std::vector<VoxelBall> lumps()
{
    std::vector<VoxelBall> balls(40);
    for (size_t i = 0; i < balls.size(); ++i) {
        const double t = double(i);
        balls[i].center = {1.5 * std::cos(0.7 * t), 0.08 * t, 1.5 * std::sin(0.7 * t)};
        balls[i].radius = 0.4 + 0.3 * std::sin(3.0 * t);
        balls[i].crossSection = balls[i].radius * balls[i].radius;
        balls[i].temperature = 600.0 + 20.0 * t;
        balls[i].luminance = 5.0 * t;
    }
    return balls;
}

double massOf(const std::vector<FitBall>& balls)
{
    return std::accumulate(balls.begin(), balls.end(), 0.0,
                           [](double sum, const FitBall& ball) { return sum + ball.crossSection; });
}

std::vector<FitBall> fit(const MediumGrid& grid, uint32_t count, FitForm form, uint32_t threads = 1)
{
    const auto tasks = base::makeTbbRunner(threads);
    return fitBalls(grid, {.count = count, .form = form}, *tasks);
}

double worstView(const MediumGrid& grid, const std::vector<FitBall>& balls)
{
    const auto tasks = base::makeSerialRunner();
    return std::ranges::max(viewErrors(grid, balls, 96, *tasks));
}

TEST(MediumFit, keepsMassAndBudgetInEveryForm)
{
    const MediumGrid grid = gridOf(lumps());
    const double mass = sumsOf(grid).crossSection;
    for (const FitForm form : {FitForm::Uniform, FitForm::Adaptive, FitForm::Optimized})
        for (const uint32_t count : {1u, 7u, 300u}) {
            const auto balls = fit(grid, count, form);
            EXPECT_LE(balls.size(), count);
            ASSERT_FALSE(balls.empty());
            EXPECT_NEAR(massOf(balls), mass, 1e-9 * mass);
        }
}

TEST(MediumFit, keepsLightAndMeanTemperature)
{
    const MediumGrid grid = gridOf(lumps());
    const MediumGridSums sums = sumsOf(grid);
    double light = 0.0, heat = 0.0;
    for (const FitBall& ball : fit(grid, 300, FitForm::Optimized)) {
        light += ball.luminance * ball.crossSection;
        heat += ball.temperature * ball.crossSection;
    }
    EXPECT_NEAR(light, sums.luminousVolume, 0.01 * sums.luminousVolume);
    EXPECT_NEAR(heat / sums.crossSection, sums.temperature, 0.002 * sums.temperature);
}

TEST(MediumFit, picturesConvergeWithTheNumberOfBallsAndWithTheForm)
{
    const MediumGrid grid = gridOf(lumps());
    const double coarse = worstView(grid, fit(grid, 30, FitForm::Optimized));
    const double fine = worstView(grid, fit(grid, 300, FitForm::Optimized));
    EXPECT_LT(fine, 0.06);
    EXPECT_LT(fine, 0.5 * coarse);
    const double uniform = worstView(grid, fit(grid, 300, FitForm::Uniform));
    const double adaptive = worstView(grid, fit(grid, 300, FitForm::Adaptive));
    EXPECT_LT(adaptive, uniform);
    EXPECT_LT(fine, adaptive);
}

TEST(MediumFit, oneBallIsFoundAgain)
{
    VoxelBall ball;
    ball.center = {0.33, -0.71, 2.04};
    ball.radius = 1.0;
    ball.crossSection = 2.0;
    const auto balls = fit(gridOf({ball}), 1, FitForm::Optimized);
    ASSERT_EQ(balls.size(), 1u);
    EXPECT_LT(glm::length(balls[0].center - ball.center), 1e-3);
    EXPECT_NEAR(balls[0].radius, 1.0, 0.03); // voxels widen it
    EXPECT_NEAR(balls[0].crossSection, 2.0, 1e-5);
}

TEST(MediumFit, isTheSameOnAnyNumberOfThreads)
{
    const MediumGrid grid = gridOf(lumps());
    const auto one = fit(grid, 200, FitForm::Optimized, 1), four = fit(grid, 200, FitForm::Optimized, 4);
    ASSERT_EQ(one.size(), four.size());
    EXPECT_EQ(std::memcmp(one.data(), four.data(), one.size() * sizeof(FitBall)), 0);
}

TEST(MediumFit, aTurnedLatticeGivesTurnedBalls)
{
    const MediumGrid grid = gridOf(lumps());
    MediumGrid turned = grid; // a quarter about y, and away
    turned.axes = glm::dmat3(glm::dvec3(0, 0, -kVoxel), glm::dvec3(0, kVoxel, 0), glm::dvec3(kVoxel, 0, 0));
    turned.origin = {10.0, 20.0, 30.0};
    const auto a = fit(grid, 50, FitForm::Optimized), b = fit(turned, 50, FitForm::Optimized);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 expected = turned.origin + glm::dvec3(a[i].center.z, a[i].center.y, -a[i].center.x);
        EXPECT_LT(glm::length(b[i].center - expected), 1e-6);
        EXPECT_NEAR(b[i].radius, a[i].radius, 1e-6);
    }
}

TEST(OpacityView, ofAGridIsThatOfTheBallThatItIsMadeFrom)
{
    VoxelBall ball;
    ball.center = {0.3, 0.2, -0.1};
    ball.radius = 1.5;
    ball.crossSection = 4.0;
    const MediumGrid grid = gridOf({ball});
    FitBall same;
    same.center = ball.center;
    same.radius = ball.radius;
    same.crossSection = ball.crossSection;
    EXPECT_LT(worstView(grid, {same}), 0.01);
    same.center.x += 0.1;
    EXPECT_GT(worstView(grid, {same}), 0.03);
}

} // namespace
} // namespace fx::render
