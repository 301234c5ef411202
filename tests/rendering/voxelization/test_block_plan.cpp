#include "foundation/snapshot/streak.h"
#include "rendering/voxelization/block_plan.h"
#include "rendering/voxelization/small_balls.h"
#include "tests/rendering/voxelization/voxel_sums.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace fx::render {
namespace {

VoxelBall ballOf(const glm::dvec3& center, double radius)
{
    VoxelBall ball;
    ball.center = center;
    ball.radius = radius;
    ball.crossSection = 1.0;
    return ball;
}

TEST(SmallBalls, piecesOfAStreakAreTheBallThatTheyWere)
{
    const glm::dvec3 way(3.0, -4.0, 0.0);
    VoxelBall moving = ballOf({1.0, 2.0, 3.0}, 0.5), still = ballOf({-1.0, 0.0, 0.0}, 2.0);
    moving.id = 7;
    still.id = 8;
    const base::Streak<double> streak = base::streakOf(glm::length(way), moving.radius);
    ASSERT_GT(streak.count, 3);
    std::vector<VoxelBall> pieces;
    for (int k = 0; k < streak.count; ++k) {
        pieces.push_back(moving);
        pieces.back().radius = streak.radius;
        pieces.back().crossSection *= streak.shareOf(k);
        pieces.back().center -= way * (double(k) / streak.count);
    }
    pieces.push_back(still);
    moving.instance = still.instance = 2; // the same id in another instance is another ball
    pieces.push_back(still);
    const std::vector<VoxelBall> joined = joinStreaks(pieces);
    ASSERT_EQ(joined.size(), 3u);
    EXPECT_LT(glm::length(joined[0].streak - way), 1e-12);
    EXPECT_LT(glm::length(joined[0].center - moving.center), 1e-12);
    EXPECT_NEAR(joined[0].crossSection, moving.crossSection, 1e-12);
    EXPECT_EQ(joined[1].streak, glm::dvec3(0.0));
    EXPECT_EQ(joined[1].crossSection, still.crossSection);
}

TEST(BlockPlan, aBallInTheMiddleOfABlockTakesOneBlock)
{
    const VoxelBall ball = ballOf(glm::dvec3(3.5), 1.0);
    const auto plan = BlockPlan::create({&ball, 1}, 1.0, kManyVoxels);
    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->blocks().size(), 1u);
    EXPECT_EQ(plan->blocks()[0].origin, glm::ivec3(0));
    EXPECT_EQ(plan->voxels(), 512u);
}

TEST(BlockPlan, everyBlockIsListedOnceWithItsBallsInOrder)
{
    std::vector<VoxelBall> balls;
    for (int i = 0; i < 50; ++i)
        balls.push_back(ballOf({0.7 * i, -0.3 * i, 5.0 * std::sin(0.4 * i)}, 1.0 + 0.1 * i));
    const auto plan = BlockPlan::create(balls, 0.5, kManyVoxels);
    ASSERT_TRUE(plan);
    size_t next = 0;
    for (size_t b = 0; b < plan->blocks().size(); ++b) {
        const auto& block = plan->blocks()[b];
        EXPECT_EQ(block.first, next);
        EXPECT_GT(block.count, 0u);
        next += block.count;
        for (size_t i = block.first + 1; i < block.first + block.count; ++i)
            EXPECT_LT(plan->balls()[i - 1], plan->balls()[i]);
        if (b > 0) {
            const glm::ivec3 &o = block.origin, &p = plan->blocks()[b - 1].origin;
            EXPECT_TRUE(o.x != p.x ? o.x > p.x : o.y != p.y ? o.y > p.y : o.z > p.z);
        }
    }
    EXPECT_EQ(next, plan->balls().size());
}

TEST(BlockPlan, moreVoxelsThanAllowedAreRefusedAndSoAreBallsTooFarAway)
{
    const VoxelBall ball = ballOf(glm::dvec3(0.0), 10.0);
    EXPECT_TRUE(BlockPlan::create({&ball, 1}, 0.5, kManyVoxels));
    EXPECT_FALSE(BlockPlan::create({&ball, 1}, 0.5, 4096));
    EXPECT_FALSE(BlockPlan::create({&ball, 1}, 1e-6, kManyVoxels));
    const VoxelBall far = ballOf({1e7, 0.0, 0.0}, 10.0);
    EXPECT_TRUE(BlockPlan::create({&far, 1}, 0.5, kManyVoxels));
    EXPECT_FALSE(BlockPlan::create({&far, 1}, 1e-3, kManyVoxels));
}

TEST(BlockPlan, theVoxelSizeOfABudgetFitsAndATwentiethLessDoesNot)
{
    std::vector<VoxelBall> balls;
    for (int i = 0; i < 40; ++i)
        balls.push_back(ballOf({0.7 * i, -0.3 * i, 5.0 * std::sin(0.4 * i)}, 1.0 + 0.1 * i));
    for (const uint64_t budget : {kLeastVoxels, uint64_t(300'000), uint64_t(3'000'000)}) {
        const double size = voxelSizeFor(balls, budget);
        EXPECT_TRUE(BlockPlan::create(balls, size, budget)) << budget;
        EXPECT_FALSE(BlockPlan::create(balls, size / 1.05, budget)) << budget;
    }
}

TEST(BlockPlan, theVoxelSizeIsNotBelowTheLeast)
{
    const VoxelBall ball = ballOf(glm::dvec3(0.0), 1.0);
    EXPECT_GE(voxelSizeFor({&ball, 1}, kManyVoxels, 0.25), 0.25);
    EXPECT_EQ(voxelSizeFor({}, kManyVoxels, 0.25), 0.25);
}

} // namespace
} // namespace fx::render
