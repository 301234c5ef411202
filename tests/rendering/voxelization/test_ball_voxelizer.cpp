#include "rendering/optics/color_temperature.h"
#include "rendering/volumes/block_table.h"
#include "rendering/volumes/escape_depth.h"
#include "rendering/voxelization/ball_voxelizer.h"
#include "tests/foundation/real_threads.h"
#include "tests/rendering/voxelization/voxel_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kVoxel = 0.1; // [m]

VoxelBall ballOf(const glm::dvec3& center, double radius)
{
    VoxelBall ball;
    ball.center = center;
    ball.radius = radius;
    ball.crossSection = 2.5;
    ball.temperature = 900.0;
    ball.luminance = 40.0;
    ball.velocity = {3.0, -2.0, 0.5};
    return ball;
}

/// From a thousandth of a voxel to 25 voxels, some just on either side of a change of the sampling.
constexpr double kRadii[] = {1e-4, 0.01, 0.05, 0.0999, 0.1, 0.13, 0.1999, 0.2, 0.37, 0.9, 1.59, 1.61, 2.5};

constexpr glm::dvec3 kCenters[] = {
    {0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {-0.731, 2.417, -0.0333}, {12.34, -5.67, 8.91}};

TEST(BallVoxelizer, theSumOfDensityTimesVolumeIsTheCrossSectionForAnyRadius)
{
    for (const double radius : kRadii)
        for (const glm::dvec3& center : kCenters) {
            const VoxelBall ball = ballOf(center, radius);
            EXPECT_NEAR(sumsOf(voxelize({&ball, 1}, kVoxel), kVoxel).mass / ball.crossSection, 1.0, 2e-6)
                << radius << " at " << center.x;
        }
}

TEST(BallVoxelizer, theCenterOfMassIsTheCenterOfTheBallForAnyRadius)
{
    for (const double radius : kRadii)
        for (const glm::dvec3& center : kCenters) {
            const VoxelBall ball = ballOf(center, radius);
            const glm::dvec3 away = sumsOf(voxelize({&ball, 1}, kVoxel), kVoxel).center() - center;
            EXPECT_LT(glm::length(away), 1e-5 * kVoxel + 1e-7 * glm::length(center))
                << radius << " at " << center.x;
        }
}

TEST(BallVoxelizer, mediumLiesInVoxelsLessThanOneVoxelFromTheBallAndFillsTheBall)
{
    for (const double radius : kRadii)
        for (const glm::dvec3& center : kCenters) {
            const VoxelBall ball = ballOf(center, radius);
            const VoxelSums sums = sumsOf(voxelize({&ball, 1}, kVoxel), kVoxel);
            for (int a = 0; a < 3; ++a) {
                EXPECT_GT(sums.low[a] * kVoxel, center[a] - radius - kVoxel * (1.0 + 1e-9));
                EXPECT_LT(sums.high[a] * kVoxel, center[a] + radius + kVoxel * (1.0 + 1e-9));
                EXPECT_LE(sums.low[a] * kVoxel, center[a] - radius + 1.5 * kVoxel);
                EXPECT_GE(sums.high[a] * kVoxel, center[a] + radius - 1.5 * kVoxel);
            }
        }
}

TEST(BallVoxelizer, theSecondMomentIsThatOfTheKernelAndOfTheTent)
{
    // The kernel's mean square distance is r^2 / 3, and a tent of two voxels adds h^2 / 6 along each axis.
    for (const double radius : {0.2, 0.37, 0.9, 2.5}) {
        const VoxelBall ball = ballOf(glm::dvec3(0.0137, 0.0411, -0.0222), radius);
        const VoxelSums sums = sumsOf(voxelize({&ball, 1}, kVoxel), kVoxel);
        const double spread = sums.squares / sums.mass - glm::dot(ball.center, ball.center);
        EXPECT_NEAR(spread, radius * radius / 3.0 + kVoxel * kVoxel / 2.0, 0.02 * spread) << radius;
    }
}

TEST(BallVoxelizer, aVoxelOfALargeBallHasTheExtinctionOfTheKernel)
{
    const VoxelBall ball = ballOf({0.03, -0.02, 0.01}, 3.0); // 30 voxels
    const double peak = 105.0 / (32.0 * std::numbers::pi) * ball.crossSection / std::pow(ball.radius, 3.0);
    for (const VoxelBlock& block : voxelize({&ball, 1}, kVoxel))
        for (int v = 0; v < kBlockVoxels; ++v) {
            const glm::dvec3 place = glm::dvec3(block.origin + glm::ivec3(v / 64, v / 8 % 8, v % 8)) * kVoxel;
            const double q =
                std::max(1.0 - std::pow(glm::distance(place, ball.center) / ball.radius, 2.0), 0.0);
            // The tent adds h^2/12 times the Laplacian of the kernel, which is at most 12/r^2 of the peak.
            EXPECT_NEAR(double(block.density[size_t(v)]), peak * q * q, 1.5e-3 * peak);
        }
}

TEST(BallVoxelizer, theOpticalDepthThroughAColumnOfVoxelsIsThatOfARay)
{
    // Of the formula kernel-optical-depth, (3): tau = 3.5/pi sigma/r^2 (1 - d^2/r^2)^(5/2) at the distance d.
    const VoxelBall ball = ballOf(glm::dvec3(0.0), 2.0); // 20 voxels
    const double peak = 3.5 / std::numbers::pi * ball.crossSection / (ball.radius * ball.radius);
    for (const int column : {0, 5, 10, 15, 19}) {
        double depth = 0.0;
        for (const VoxelBlock& block : voxelize({&ball, 1}, kVoxel))
            for (int v = 0; v < kBlockVoxels; ++v)
                if (block.origin.x + v / 64 == column && block.origin.y + v / 8 % 8 == 0)
                    depth += double(block.density[size_t(v)]) * kVoxel;
        const double d = column * kVoxel / ball.radius;
        EXPECT_NEAR(depth, peak * std::pow(1.0 - d * d, 2.5), 5e-3 * peak) << column;
    }
}

TEST(BallVoxelizer, meansOfTwoBallsAreWeightedWithTheirDensityAndLightIsAdded)
{
    VoxelBall balls[] = {ballOf({0.0, 0.0, 0.0}, 0.5), ballOf({0.3, 0.1, 0.0}, 0.04)};
    balls[1].crossSection = 0.5;
    balls[1].temperature = 2000.0;
    balls[1].luminance = 1e5;
    balls[0].luminanceRate = -3.0;
    balls[1].luminanceRate = 5.0;
    balls[1].velocity = {0.0, 9.0, 0.0};
    balls[0].albedo = {0.2, 0.4, 0.6};
    balls[1].albedo = {0.8, 0.4, 0.0};
    const auto blocks = voxelize(balls, kVoxel);
    const VoxelSums sums = sumsOf(blocks, kVoxel);
    EXPECT_NEAR(sums.mass, 3.0, 3e-6);
    EXPECT_NEAR(sums.light, 2.5 * 40.0 + 0.5 * 1e5, 0.2);
    EXPECT_NEAR(glm::distance(sums.momentum, 2.5 * balls[0].velocity + 0.5 * balls[1].velocity), 0.0, 1e-5);
    double change = 0.0; // [cd/s]
    for (const VoxelBlock& block : blocks)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            change += kVoxel * kVoxel * kVoxel * double(block.flame[v]) * double(block.flameRate[v]);
    EXPECT_NEAR(change, 2.5 * 40.0 * -3.0 + 0.5 * 1e5 * 5.0, 1.0);
    glm::dvec3 scattered(0.0); // [m2]
    for (const VoxelBlock& block : blocks)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            scattered += kVoxel * kVoxel * kVoxel * double(block.density[v]) * glm::dvec3(block.albedo[v]);
    EXPECT_NEAR(glm::distance(scattered, 2.5 * balls[0].albedo + 0.5 * balls[1].albedo), 0.0, 1e-5);
    for (const VoxelBlock& block : blocks)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            if (block.density[v] > 0.0f) {
                EXPECT_GE(block.temperature[v], 899.999f);
                EXPECT_LE(block.temperature[v], 2000.001f);
            } else {
                EXPECT_EQ(block.temperature[v], 0.0f);
                EXPECT_EQ(block.flame[v], 0.0f);
                EXPECT_EQ(block.flameRate[v], 0.0f);
            }
}

TEST(BallVoxelizer, theRateOfLightIsBounded)
{
    VoxelBall ball = ballOf({0.0, 0.0, 0.0}, 0.5);
    ball.luminanceRate = -VoxelBall::kMostRate;
    float least = 0.0f;
    for (const VoxelBlock& block : voxelize({&ball, 1}, kVoxel))
        for (const float rate : block.flameRate)
            least = std::min(least, rate);
    EXPECT_EQ(least, -base::kMostVolumeRate);
}

TEST(BallVoxelizer, aBallSmallerThanAVoxelMovesThroughTheLatticeWithoutJumps)
{
    glm::dvec3 last;
    for (int step = 0; step <= 40; ++step) {
        const VoxelBall ball = ballOf({0.01 * step, 0.0123, 0.0}, 0.01);
        const glm::dvec3 center = sumsOf(voxelize({&ball, 1}, kVoxel), kVoxel).center();
        if (step > 0) {
            EXPECT_NEAR(center.x - last.x, 0.01, 1e-6);
        }
        last = center;
    }
}

TEST(BallVoxelizer, theSumOfWeightsMeetsTheIntegralWhereTheFormulaChanges)
{
    const double below = sampleNormalization(15.9999), above = sampleNormalization(16.0001);
    EXPECT_NEAR(below / above, std::pow(16.0001 / 15.9999, 3.0), 2e-6);
}

TEST(BallVoxelizer, withoutLightTheTemperatureIsTheMeanWeightedWithTheDensity)
{
    VoxelBall balls[] = {ballOf({0.0, 0.0, 0.0}, 0.5), ballOf({0.3, 0.1, 0.0}, 0.04)};
    balls[0].luminance = balls[1].luminance = 0.0;
    balls[1].temperature = 2000.0;
    EXPECT_NEAR(sumsOf(voxelize(balls, kVoxel), kVoxel).heat, 2.5 * 900.0 + 2.5 * 2000.0, 0.03);
}

TEST(BallVoxelizer, theColorOfLightIsThatOfTheLightThatBallsEmit)
{
    VoxelBall balls[] = {ballOf({0.0, 0.0, 0.0}, 0.5), ballOf({0.0, 0.0, 0.0}, 0.5)};
    balls[0].temperature = 1100.0; // nine tenths of the medium, a tenth of the light
    balls[1].temperature = 2000.0;
    balls[0].crossSection = 0.9;
    balls[1].crossSection = 0.1;
    balls[0].luminance = 1e3;
    balls[1].luminance = 8.1e4;
    const glm::vec3 wanted = 0.1f * blackBodyColor(1100.0f) + 0.9f * blackBodyColor(2000.0f);
    for (const VoxelBlock& block : voxelize(balls, kVoxel))
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            if (block.density[v] > 0.0f) {
                const glm::vec3 found = blackBodyColor(block.temperature[v]);
                EXPECT_NEAR(found.x / wanted.x, 1.0f, 1e-3f);
                EXPECT_NEAR(found.y / wanted.y, 1.0f, 5e-3f);
            }
}

/// Blocks of balls of which voxels emit as they are seen from outside, and the light that leaves them [cd].
std::vector<VoxelBlock> voxelizeAsSeen(std::span<const VoxelBall> balls)
{
    const auto tasks = base::makeSerialRunner();
    const auto plan = BlockPlan::create(balls, kVoxel, kManyVoxels);
    std::vector<VoxelBlock> blocks;
    BallVoxelizer voxelizer(balls, *plan, *tasks);
    voxelizer.findEscapeDepths();
    voxelizer.fill(0, plan->blocks().size(), blocks);
    return blocks;
}

/// [cd/m2 m2] What leaves the blocks.
double leaving(const std::vector<VoxelBlock>& blocks)
{
    std::vector<glm::ivec3> places;
    std::vector<float> density;
    for (const VoxelBlock& block : blocks) {
        places.push_back(block.origin / kBlockSide);
        density.insert(density.end(), block.density.begin(), block.density.end());
    }
    const auto depths = escapeDepths({places, {64, 8, 1}, density, kVoxel});
    double sum = 0.0;
    for (size_t v = 0; v < density.size(); ++v)
        sum += double(blocks[v / 512].flame[v % 512]) * std::exp(-double(depths[v]));
    return sum;
}

/// [cd] Towards +X, by linear interpolation of voxels in y and z and their layers along x.
double intensity(const std::vector<VoxelBlock>& blocks)
{
    std::map<std::array<int, 3>, std::array<double, 2>> voxels; // y, z, -x
    for (const VoxelBlock& block : blocks)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            for (int k = 0; k < 9; ++k) { // and neighbors that it reaches
                const glm::ivec3 at = block.origin + placeInBlock(v) + glm::ivec3(0, k / 3 - 1, k % 3 - 1);
                auto& own = voxels[{at.y, at.z, -at.x}];
                if (k == 4)
                    own = {double(block.density[v]), double(block.flame[v])};
            }
    constexpr int kAlong = 4; // rays along a voxel
    double sum = 0.0;
    for (int ray = 0; ray < kAlong * kAlong; ++ray) {
        const double b = (ray / kAlong + 0.5) / kAlong, c = (ray % kAlong + 0.5) / kAlong;
        double through = 1.0;
        std::array<int, 3> last{};
        for (const auto& [at, own] : voxels) {
            through = at[0] == last[0] && at[1] == last[1] ? through : 1.0;
            last = at;
            std::array<double, 2> mean{};
            for (int k = 0; k < 4; ++k)
                if (const auto found = voxels.find({at[0] + k / 2, at[1] + k % 2, at[2]});
                    found != voxels.end())
                    for (size_t m = 0; m < 2; ++m)
                        mean[m] += (k / 2 == 1 ? b : 1.0 - b) * (k % 2 == 1 ? c : 1.0 - c) * found->second[m];
            if (mean[0] > 0.0) {
                const double opacity = -std::expm1(-mean[0] * kVoxel);
                sum += through * opacity * mean[1] / mean[0];
                through *= 1.0 - opacity;
            }
        }
    }
    return sum * kVoxel * kVoxel / (kAlong * kAlong);
}

TEST(BallVoxelizer, thinMediaEmitAllTheirLight)
{
    auto balls = std::vector{ballOf({0.0, 0.0, 0.0}, 0.5), ballOf({0.3, 0.1, 0.0}, 0.2)};
    balls[0].crossSection = balls[1].crossSection = 1e-4;
    balls[1].luminance = 1e5;
    EXPECT_NEAR(sumsOf(voxelizeAsSeen(balls), kVoxel).light / sumsOf(voxelize(balls, kVoxel), kVoxel).light,
                1.0, 2e-3);
}

TEST(BallVoxelizer, fireBehindACrustOfSootIsHiddenInVoxelsThatHaveBoth)
{
    // A hot ball of 4 voxels, and around it cold soot that is half a voxel thick, of an optical depth of 40.
    std::vector<VoxelBall> balls{ballOf({0.0, 0.0, 0.0}, 0.4)};
    balls[0].crossSection = 100.0;
    balls[0].luminance = 1e6;
    constexpr int kSoot = 4000;
    for (int i = 0; i < kSoot; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / kSoot, r = std::sqrt(1.0 - z * z), turn = 2.399963 * i;
        balls.push_back(ballOf(0.425 * glm::dvec3(r * std::cos(turn), r * std::sin(turn), z), 0.025));
        balls.back().crossSection = 40.0 * 4.0 * std::numbers::pi * 0.425 * 0.425 / kSoot;
        balls.back().luminance = 0.0;
    }
    const double mixed = leaving(voxelize(balls, kVoxel)), seen = leaving(voxelizeAsSeen(balls));
    EXPECT_LT(seen, 0.25 * mixed);
    for (VoxelBall& ball : balls)
        ball.luminance = 1e6; // all alike: the surface has their luminance in both ways
    EXPECT_NEAR(leaving(voxelizeAsSeen(balls)) / leaving(voxelize(balls, kVoxel)), 1.0, 0.05);
}

std::vector<VoxelBall> cloud()
{
    std::vector<VoxelBall> balls;
    for (int i = 0; i < 300; ++i) {
        const double t = 0.1 * i;
        balls.push_back(ballOf({std::sin(t) * 2.0, 0.03 * i, std::cos(1.7 * t)}, 0.02 + 0.003 * i));
        balls.back().temperature = 300.0 + i;
    }
    return balls;
}

TEST(BallVoxelizer, aSparkSmallerThanAVoxelGivesTheLightThatLeavesIt)
{
    // Opacity of the ball itself by the midpoint rule over the area of its disc.
    for (const double radius : {0.003, 0.03, 0.3})
        for (const double depth : {0.01, 5.0, 50.0})
            for (const glm::dvec3& center : {glm::dvec3(0.0), glm::dvec3(0.037, 0.0, -0.05)}) {
                VoxelBall ball = ballOf(center, radius);
                ball.luminance = 1e6;
                ball.crossSection = 2.0 / 7.0 * std::numbers::pi * radius * radius * depth;
                double opacity = 0.0;
                for (int i = 0; i < 1000; ++i)
                    opacity -= std::expm1(-depth * std::pow((i + 0.5) / 1000, 2.5)) / 1000;
                const double wanted = ball.luminance * opacity * std::numbers::pi * radius * radius;
                const double found = intensity(voxelizeAsSeen({&ball, 1}));
                EXPECT_NEAR(found / wanted, 1.0, 0.17) << radius << " " << depth << " " << center.x;
            }
    EXPECT_NEAR(spreadBall(1e-12, 0.01).share, 1.0, 1e-6);
    EXPECT_NEAR(spreadBall(1e6, 1e3).share, 1.0, 1e-5);
    EXPECT_GE(spreadBall(1e30, 1e-30).share, 0.0);
}

TEST(BallVoxelizer, theLightOfADenseBallDoesNotDependOnItsPlaceBetweenVoxels)
{
    // What is left is that voxels and their interpolation are seen from one side.
    const std::map<double, double> limits{{0.07, 1.4}, {0.14, 1.12}, {0.2, 1.2}};
    for (const auto& [radius, limit] : limits) {
        std::vector<double> found;
        for (const glm::dvec3& center : {glm::dvec3(0.0), glm::dvec3(0.05), glm::dvec3(0.05, 0.05, 0.025),
                                         glm::dvec3(0.025, 0.025, 0.075)})
        {
            VoxelBall ball = ballOf(center, radius);
            ball.luminance = 1e6;
            ball.crossSection = 2.0 / 7.0 * std::numbers::pi * radius * radius * 400.0;
            found.push_back(intensity(voxelizeAsSeen({&ball, 1})));
        }
        const auto [least, most] = std::ranges::minmax(found);
        EXPECT_LT(most / least, limit) << radius;
    }
}

/// Removes what is left of a plane, halves the rest, and doubles temperatures, of even balls.
class HalfDetail final : public VoxelDetail
{
public:
    size_t groups() const override { return 1; }
    int32_t groupOf(uint32_t ball) const override { return ball % 2 == 0 ? 0 : -1; }
    Values valuesOf(uint32_t ball) const override { return {double(ball), 0, 0, 0, 0, 0, 1.0}; }
    Factors at(size_t, double extinction, const Values& means, const glm::dvec3& place) const override
    {
        EXPECT_GT(extinction, 0.0);
        EXPECT_NEAR(means[6], 1.0, 1e-9);
        return {place.x < 0.0 ? 0.0f : float(0.5 + means[0]), 2.0f};
    }
    double luminance(uint32_t, float temperature) const override { return 10.0 * double(temperature); }
};

TEST(BallVoxelizer, detailMultipliesExtinctionTemperatureAndLightOfItsBallsAtTheVoxel)
{
    const std::vector<VoxelBall> balls{ballOf({0.0, 0.0, 0.0}, 0.5), ballOf({0.0, 4.0, 0.0}, 0.5)};
    const auto tasks = base::makeSerialRunner();
    const auto plan = BlockPlan::create(balls, kVoxel, kManyVoxels);
    const HalfDetail detail;
    BallVoxelizer plain(balls, *plan, *tasks), detailed(balls, *plan, *tasks);
    detailed.setDetail(&detail);
    std::vector<VoxelBlock> from, to;
    plain.fill(0, plan->blocks().size(), from);
    detailed.fill(0, plan->blocks().size(), to);
    for (size_t b = 0; b < from.size(); ++b)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v) {
            const glm::ivec3 at = from[b].origin + placeInBlock(v);
            const bool isDetailed = at.y < 20;
            const float share = !isDetailed ? 1.0f : at.x < 0 ? 0.0f : 0.5f;
            EXPECT_FLOAT_EQ(to[b].density[v], share * from[b].density[v]);
            if (to[b].density[v] == 0.0f)
                continue;
            // 20 instead of 40 cd/m2 where temperatures are doubled
            EXPECT_NEAR(to[b].flame[v] / from[b].flame[v], isDetailed ? 0.25f : 1.0f, 1e-5f);
            EXPECT_NEAR(to[b].temperature[v] / from[b].temperature[v], isDetailed ? 2.0f : 1.0f, 2e-3f);
        }
    detailed.findEscapeDepths(); // of the medium with detail
    detailed.fill(0, plan->blocks().size(), to);
    EXPECT_LT(leaving(to), leaving(voxelizeAsSeen(balls)));
    EXPECT_GT(leaving(to), 0.0);
}

TEST(BallVoxelizer, anyNumberOfThreadsGivesTheSameBits)
{
    const test::RealThreads threadsOfAnyMachine(5);
    auto balls = cloud();
    for (size_t i = 0; i < balls.size(); ++i)
        balls[i].luminance = double(i % 3);
    const HalfDetail detail;
    const auto filled = [&](base::TaskRunner& tasks) {
        const auto plan = BlockPlan::create(balls, kVoxel, kManyVoxels);
        std::vector<VoxelBlock> blocks;
        BallVoxelizer voxelizer(balls, *plan, tasks);
        voxelizer.setDetail(&detail);
        voxelizer.findEscapeDepths();
        voxelizer.fill(0, plan->blocks().size(), blocks);
        return blocks;
    };
    const auto serial = filled(*base::makeSerialRunner());
    for (const uint32_t threads : {2u, 5u}) {
        const auto tasks = base::makeTbbRunner(threads);
        const auto parallel = filled(*tasks);
        ASSERT_EQ(parallel.size(), serial.size());
        for (size_t b = 0; b < serial.size(); ++b) {
            EXPECT_EQ(parallel[b].origin, serial[b].origin);
            EXPECT_EQ(parallel[b].density, serial[b].density);
            EXPECT_EQ(parallel[b].temperature, serial[b].temperature);
            EXPECT_EQ(parallel[b].flame, serial[b].flame);
            EXPECT_EQ(parallel[b].velocity, serial[b].velocity);
        }
    }
}

TEST(BallVoxelizer, blocksFilledInPartsAreThoseFilledAtOnce)
{
    const auto balls = cloud();
    const auto tasks = base::makeSerialRunner();
    const auto plan = BlockPlan::create(balls, kVoxel, kManyVoxels);
    ASSERT_TRUE(plan);
    const auto whole = voxelize(balls, kVoxel);
    const BallVoxelizer voxelizer(balls, *plan, *tasks);
    std::vector<VoxelBlock> part;
    for (size_t first = 0; first < whole.size(); first += part.size()) {
        voxelizer.fill(first, std::min<size_t>(7, whole.size() - first), part);
        for (size_t b = 0; b < part.size(); ++b)
            EXPECT_EQ(part[b].density, whole[first + b].density);
    }
}

} // namespace
} // namespace fx::render
