// Where voxels lie: fixed in the world, fine enough, within the budget, and complete.
#include "rendering/stage/stage_camera.h"
#include "tests/rendering/field/field_scenes.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>

using namespace fx;
using namespace fx::render;
using namespace fx::test;

namespace {

constexpr int kWidth = 640, kHeight = 360;

CameraView cameraAt(const glm::dvec3& position, const glm::dvec3& target)
{
    return perspectiveView({position, target}, 0.8f, float(kWidth) / float(kHeight), 0.1f);
}

FieldPlan planOf(const FieldScene& scene, int resolution, uint32_t mostBricks = 0)
{
    FieldPlan plan(std::pmr::new_delete_resource());
    FieldPlanInputs in = scene.inputs(kWidth, kHeight, resolution);
    in.mostBricks = mostBricks;
    plan.build(in);
    return plan;
}

} // namespace

TEST(FieldPlan, noBallsMakeNoField)
{
    const FieldScene scene({}, cameraAt({0, 0, 8}, {0, 0, 0}));
    const FieldPlan plan = planOf(scene, 64);
    EXPECT_TRUE(plan.isEmpty());
    EXPECT_TRUE(plan.tiles().empty());
    EXPECT_TRUE(plan.fields().empty());
}

TEST(FieldPlan, bricksHoldAllMediumThatTheViewSees)
{
    const FieldScene scene(randomBalls(150, 5, glm::dvec3(0.0)), cameraAt({0, 0, 9}, {0, 0, 0}));
    const FieldPlan plan = planOf(scene, 64);
    ASSERT_EQ(plan.fields().size(), 1u);
    const FieldBlock& field = plan.fields()[0];
    size_t withMedium = 0, empty = 0;
    const glm::ivec3 cells = glm::ivec3(field.bricks) * kBrickCells;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const glm::ivec3 b = glm::ivec3(x, y, z) / kBrickCells;
                const uint32_t number = plan.table()[size_t(field.bricks.w + b.x +
                                                            field.bricks.x * (b.y + field.bricks.y * b.z))];
                const glm::dvec3 place =
                    glm::dvec3(field.corner) + double(field.corner.w) * glm::dvec3(x, y, z);
                const double all = sampleAt(scene, 0, place, field);
                if (number == 0) {
                    EXPECT_EQ(all, 0.0);
                    ++empty;
                    continue;
                }
                const FieldBrickBlock& brick = plan.bricks()[number - 1];
                FieldScene of = scene;
                of.balls.clear();
                of.effects[0].end = brick.count;
                for (uint32_t k = 0; k < brick.count; ++k)
                    of.balls.push_back(scene.balls[plan.balls()[brick.first + k]]);
                EXPECT_EQ(sampleAt(of, 0, place, field), all) << "same balls, same order";
                withMedium += all > 0.0;
                EXPECT_LE(all, double(field.limits.y) * 1.0001);
                if (HasFailure())
                    return;
            }
    EXPECT_GT(withMedium, 1000u);
    EXPECT_GT(empty, 1000u);
}

TEST(FieldPlan, voxelsKeepTheirPlacesInTheWorldWhenTheEyeMovesAndTurns)
{
    const std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(2000.0, 10.0, -3000.0));
    const glm::dvec3 eyes[] = {{2000.0, 10.0, -2991.0}, {2000.03, 10.02, -2991.1}, {2000.7, 9.2, -2990.4}};
    const glm::dvec3 targets[] = {{2000.0, 10.0, -3000.0}, {2001.0, 10.4, -3000.0}, {1999.0, 9.0, -3000.0}};
    float voxel = 0.0f;
    for (int i = 0; i < 3; ++i) {
        const FieldScene scene(balls, cameraAt(eyes[i], targets[i]));
        const FieldPlan plan = planOf(scene, 96);
        ASSERT_FALSE(plan.isEmpty());
        const FieldBlock& field = plan.fields()[0];
        voxel = i == 0 ? field.corner.w : voxel;
        EXPECT_EQ(field.corner.w, voxel);
        for (int a = 0; a < 3; ++a) {
            const double place = (scene.camera.eye[a] + double(field.corner[a])) / (8.0 * double(voxel));
            EXPECT_NEAR(place, std::round(place), 1e-4) << "corner of a brick of the world's lattice";
        }
    }
}

TEST(FieldPlan, sidesOfVoxelsDependOnTheWholeEffectNotOnWhatIsInView)
{
    const std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const FieldScene all(balls, cameraAt({0, 0, 9}, {0, 0, 0}));
    FieldScene half = all;
    half.balls.resize(75);
    half.effects[0].end = 75;
    float smallest[2] = {1e9f, 1e9f};
    for (size_t i = 0; i < all.balls.size(); ++i)
        for (size_t k = i < 75 ? 0 : 1; k < 2; ++k)
            smallest[k] = std::min(smallest[k], all.balls[i].centerRadius.w);
    ASSERT_LT(smallest[0], 0.5f); // small balls in both
    EXPECT_EQ(planOf(all, 64).fields()[0].corner.w, planOf(half, 64).fields()[0].corner.w);
}

TEST(FieldPlan, farAndSmallEffectsHaveFewerVoxels)
{
    const std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    size_t before = ~size_t(0);
    for (const double distance : {30.0, 60.0, 120.0, 240.0}) {
        const FieldScene scene(balls, cameraAt({0, 0, distance}, {0, 0, 0}));
        const size_t bricks = planOf(scene, 128).bricks().size();
        EXPECT_LT(bricks, before) << distance;
        before = bricks;
    }
}

TEST(FieldPlan, manyEffectsStayWithinTheBudget)
{
    std::vector<FieldBall> balls;
    for (uint32_t e = 0; e < 12; ++e)
        for (const FieldBall& ball :
             randomBalls(60, 10 + e, glm::dvec3(6.0 * (e % 4), 0.0, -5.0 * (e / 4)), e))
            balls.push_back(ball);
    const FieldScene scene(balls, cameraAt({9, 2, 12}, {9, 0, 0}));
    for (const uint32_t most : {200u, 1000u, 4000u}) {
        const FieldPlan plan = planOf(scene, 128, most);
        EXPECT_EQ(plan.fields().size(), 12u);
        EXPECT_LE(plan.bricks().size(), most);
        EXPECT_GT(plan.bricks().size(), most / 4);
    }
}

TEST(FieldPlan, ballsFarApartHaveNoVoxelsBetweenThem)
{
    std::vector<FieldBall> balls(2);
    balls[0].center = {-40.0, 0.0, 0.0};
    balls[1].center = {40.0, 0.0, 0.0};
    const FieldScene scene(balls, cameraAt({0, 0, 120}, {0, 0, 0}));
    const FieldPlan plan = planOf(scene, 128);
    const glm::ivec3 size(plan.fields()[0].bricks);
    EXPECT_GE(size.x, 8);
    EXPECT_LE(plan.bricks().size(), size_t(2 * 27)); // widened balls at most
}

TEST(FieldPlan, ballsMuchSmallerThanTheOthersStayBalls)
{
    std::vector<FieldBall> balls = randomBalls(100, 5, glm::dvec3(0.0));
    balls[7].radius = 0.02f;
    balls[7].crossSection = 1e-4f;
    const FieldScene scene(balls, cameraAt({0, 0, 9}, {0, 0, 0}));
    const FieldPlan plan = planOf(scene, 64);
    ASSERT_EQ(plan.loose().size(), 1u);
    EXPECT_EQ(plan.loose()[0], 7u);
    EXPECT_EQ(std::count(plan.balls().begin(), plan.balls().end(), 7u), 0);
}

TEST(FieldPlan, farBallsAreWidenedToWhatVoxelsHold)
{
    std::vector<FieldBall> balls(1);
    const FieldScene scene(balls, cameraAt({0, 0, 600}, {0, 0, 0}));
    const FieldPlan plan = planOf(scene, 96);
    const FieldBlock& field = plan.fields()[0];
    ASSERT_GT(field.limits.x, 1.5f) << "the control: voxels are nearly as large as the ball";
    double sum = 0.0; // the cross section is kept by the sum over the lattice
    for (const FieldBrickBlock& brick : plan.bricks())
        for (int i = 0; i < 512; ++i)
            sum += sampleAt(scene, 0, placeOfSample(plan, brick, {i % 8, i / 8 % 8, i / 64}), field);
    EXPECT_NEAR(sum * std::pow(double(field.corner.w), 3.0), 1.0, 0.05);
}

TEST(FieldPlan, eachPartOfTheWindowListsTheFieldsThatAreSeenThere)
{
    std::vector<FieldBall> balls(2);
    balls[0].center = {-5.0, 0.0, 0.0};
    balls[1].center = {5.0, 0.0, 0.0};
    balls[1].effect = 1;
    const FieldScene scene(balls, cameraAt({0, 0, 20}, {0, 0, 0}));
    const FieldPlan plan = planOf(scene, 64);
    ASSERT_EQ(plan.fields().size(), 2u);
    size_t left = 0, right = 0;
    ASSERT_EQ(plan.tiles().size(), size_t(kFieldTiles));
    for (size_t i = 0; i < plan.tiles().size(); ++i) {
        const FieldTileBlock& tile = plan.tiles()[i];
        if (tile.count == 0)
            continue;
        ASSERT_EQ(tile.count, 1u);
        const bool isLeft = i % kFieldTileColumns < kFieldTileColumns / 2;
        (isLeft ? left : right) += 1;
        EXPECT_EQ(plan.tileFields()[tile.first], isLeft ? 0u : 1u);
    }
    EXPECT_GT(left, 4u);
    EXPECT_EQ(left, right);
    EXPECT_LT(left + right, size_t(kFieldTiles) / 2);
}

TEST(FieldPlan, withTheEyeInsideAllOfTheWindowIsListed)
{
    std::vector<FieldBall> balls(1);
    balls[0].radius = 5.0f;
    const FieldScene scene(balls, cameraAt({0.1, 0.2, 0.3}, {0, 0, -1}));
    const FieldPlan plan = planOf(scene, 64);
    ASSERT_EQ(plan.tiles().size(), size_t(kFieldTiles));
    for (const FieldTileBlock& tile : plan.tiles())
        EXPECT_EQ(tile.count, 1u);
}

TEST(FieldPlan, sharesOfBallsNearTheEyeAreContinuousAndFew)
{
    // a thousand balls that overlap, more than may be near
    const std::vector<FieldBall> balls = randomBalls(1000, 5, glm::dvec3(0.0));
    std::vector<float> before;
    size_t most = 0;
    float jump = 0.0f, change = 0.0f;
    constexpr double kStep = 0.004; // [m]
    for (int frame = 0; frame < 300; ++frame) {
        const double x = kStep * frame;
        const FieldScene scene(balls, cameraAt({x, 0.2, 0.1}, {x + 1.0, 0.2, 0.1}));
        const FieldPlan plan = planOf(scene, 16);
        most = std::max(most, plan.near().balls().size());
        std::vector<float> shares(scene.balls.size(), 0.0f);
        for (const NearBall& ball : plan.near().balls()) {
            EXPECT_GT(ball.share, 0.0f);
            EXPECT_LE(ball.share, 1.0f);
            shares[ball.number] = ball.share;
        }
        for (size_t i = 0; frame > 0 && i < shares.size(); ++i) {
            jump = std::max(jump, std::abs(shares[i] - before[i]));
            change += std::abs(shares[i] - before[i]);
        }
        before = shares;
    }
    EXPECT_EQ(most, FieldNearPlan::kMost);
    EXPECT_GT(change, 10.0f) << "balls come near and leave";
    EXPECT_LT(jump, 0.1f);
}

TEST(FieldPlan, nothingIsTakenOutOfFieldsFarFromTheEyeOfLargeBallsOrInParallelViews)
{
    const std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
    const CameraView within = cameraAt({0, 0, 0}, {0, 0, -1});
    EXPECT_FALSE(planOf(FieldScene(balls, within), 32).near().bricks().empty());
    EXPECT_TRUE(planOf(FieldScene(balls, cameraAt({0, 0, 9}, {0, 0, 0})), 32).near().balls().empty());
    std::vector<FieldBall> large(3);
    EXPECT_TRUE(planOf(FieldScene(large, within), 128).near().balls().empty()) << "8 voxels of radius";
    const CameraView parallel = orthographicView({{0, 0, 0}, {0, 0, -1}}, 4.0f, 1.5f, 0.0f, 10.0f);
    EXPECT_TRUE(planOf(FieldScene(balls, parallel), 32).near().balls().empty());
}

TEST(FieldPlan, gridsOfNetworksFollowTheirMediaInCubicCells)
{
    constexpr int kCells = 32;
    const glm::dvec3 spreads[3] = {{1.0, 1.0, 1.0}, {0.25, 2.5, 0.25}, {3.0, 0.2, 1.0}};
    for (size_t i = 0; i < 3; ++i) {
        std::vector<FieldBall> balls = randomBalls(150, 5, glm::dvec3(0.0));
        for (FieldBall& ball : balls) {
            ball.center *= spreads[i];
            ball.radius *= 0.5f;
        }
        FieldScene scene(balls, cameraAt({0, 0, 20}, {0, 0, 0}));
        FieldPlan plan(std::pmr::new_delete_resource());
        FieldPlanInputs in = scene.inputs(kWidth, kHeight, 64);
        in.networkCells = kCells;
        plan.build(in);
        ASSERT_EQ(plan.glows().size(), 1u);
        const FieldGlowBlock& grid = plan.glows()[0];
        const glm::vec3 low(grid.corner), high = low + grid.corner.w * glm::vec3(grid.cells);
        EXPECT_LE(grid.cells.x * grid.cells.y * grid.cells.z, kCells * kCells * kCells);
        glm::vec3 widest(0.0f);
        for (const FieldBlock& field : plan.fields()) {
            const glm::vec3 corner(field.corner);
            const glm::vec3 size = field.corner.w * float(kBrickCells) * glm::vec3(field.bricks);
            widest = glm::max(widest, size);
            for (int a = 0; a < 3; ++a) {
                EXPECT_LE(low[a], corner[a]) << i;
                EXPECT_GE(high[a], corner[a] + size[a]) << i;
            }
        }
        for (int a = 0; a < 3; ++a) {
            EXPECT_EQ(grid.cells[a] % kNetworkRound, 0);
            EXPECT_GE(grid.cells[a], kMinNetworkSide);
            EXPECT_LE(grid.cells[a], kMaxNetworkSide);
            EXPECT_TRUE(grid.cells[a] == kMinNetworkSide ||
                        float(grid.cells[a] - kSpareGlowCells - kNetworkRound) * grid.corner.w < widest[a])
                << "no layers of cells without medium";
        }
        if (i > 0) {
            const float cube =
                *std::max_element(&widest[0], &widest[0] + 3) / float(kCells - kSpareGlowCells);
            EXPECT_LT(grid.corner.w, cube) << "smaller cells than in a cube: " << i;
        }
    }
}

TEST(FieldPlan, networksAreChosenForEachMediumThatTouchesNoOther)
{
    // Thin and dense media apart, and a thin one that touches a dense one, which shares its grid.
    const glm::dvec3 places[] = {{-9, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    const float crossSections[] = {0.001f, 0.5f, 0.001f};
    std::vector<FieldBall> balls;
    for (uint32_t e = 0; e < 3; ++e)
        for (FieldBall ball : randomBalls(60, 5 + e, places[e], e)) {
            ball.crossSection = crossSections[e];
            ball.albedo = glm::vec3(0.9f);
            balls.push_back(ball);
        }
    const FieldScene scene(balls, cameraAt({0, 0, 20}, {0, 0, 0}));
    FieldPlanInputs in = scene.inputs(kWidth, kHeight, 48);
    in.networkCells = 24;
    for (const bool chooses : {false, true}) {
        in.choosesNetworks = chooses;
        FieldPlan plan(std::pmr::new_delete_resource());
        plan.build(in);
        ASSERT_EQ(plan.fields().size(), 3u);
        EXPECT_TRUE(plan.hasNetworks());
        EXPECT_EQ(plan.glows().size(), chooses ? 1u : 2u);
        EXPECT_EQ(plan.fields()[0].limits.w > 0.0f, !chooses);
        EXPECT_GT(plan.fields()[1].limits.w, 0.0f);
        EXPECT_EQ(plan.fields()[2].limits.w, plan.fields()[1].limits.w);
    }
}

namespace {

/// Balls of a white medium within some 1.3 m of a place.
std::vector<FieldBall> whiteBalls(uint32_t effect, const glm::dvec3& place, float crossSection)
{
    std::vector<FieldBall> balls = randomBalls(60, 5, place, effect);
    for (FieldBall& ball : balls) {
        ball.center = place + 0.4 * (ball.center - place);
        ball.radius *= 0.4f;
        ball.crossSection = crossSection;
        ball.albedo = glm::vec3(0.9f);
    }
    return balls;
}

/// Cross section of whiteBalls() with a mean optical depth as large as the limit.
float limitingCrossSection()
{
    MediumMoments medium;
    for (const FieldBall& ball : whiteBalls(0, glm::dvec3(0.0), 1.0f))
        medium.add(ball.center, double(ball.radius), 1.0, glm::dvec3(0.9));
    return float(kLeastNetworkDepth / medium.opticalDepth());
}

} // namespace

TEST(FieldPlan, aMediumAtALimitDoesNotChangeToAndFro)
{
    const float limit = limitingCrossSection();
    FieldPlan plan(std::pmr::new_delete_resource());
    const auto hasNetwork = [&](float share, double moved) {
        const FieldScene scene(whiteBalls(0, {moved, 0, 0}, share * limit),
                               cameraAt({moved, 0, 20}, {0, 0, 0}));
        FieldPlanInputs in = scene.inputs(kWidth, kHeight, 48);
        in.networkCells = 24;
        in.choosesNetworks = true;
        plan.build(in);
        return plan.hasNetworks();
    };
    EXPECT_FALSE(hasNetwork(0.95f, 0.0));
    EXPECT_TRUE(hasNetwork(1.05f, 0.0));
    for (int frame = 0; frame < 20; ++frame) // it moves, and the eye with it
        EXPECT_TRUE(hasNetwork(frame % 2 == 0 ? 0.9f : 1.05f, 0.3 * frame)) << frame;
    EXPECT_FALSE(hasNetwork(0.7f, 6.0));
    for (int frame = 0; frame < 20; ++frame)
        EXPECT_FALSE(hasNetwork(frame % 2 == 0 ? 0.9f : 0.98f, 6.0)) << frame;
}

TEST(FieldPlan, amongMoreMediaThanNetworksOneThatComesNearIsPromotedOnce)
{
    // Five media around an eye; the nearest four have networks. One of them comes and goes.
    FieldPlan plan(std::pmr::new_delete_resource());
    const auto fifthHasNetwork = [&](double distance) {
        std::vector<FieldBall> balls;
        for (uint32_t e = 0; e < 5; ++e) {
            const double angle = 0.25 * (double(e) - 2.0), away = e == 4 ? distance : 30.0;
            for (const FieldBall& ball :
                 whiteBalls(e, {away * std::sin(angle), 0.0, -away * std::cos(angle)}, 0.5f))
                balls.push_back(ball);
        }
        const FieldScene scene(balls, cameraAt({0, 0, 0}, {0, 0, -1}));
        FieldPlanInputs in = scene.inputs(kWidth, kHeight, 128);
        in.networkCells = 24;
        plan.build(in);
        EXPECT_EQ(plan.fields().size(), 5u);
        EXPECT_EQ(plan.glows().size(), kMaxGlowGrids);
        return plan.fields()[4].limits.w > 0.0f;
    };
    EXPECT_FALSE(fifthHasNetwork(40.0));
    for (const double distance : {29.5, 30.5, 29.0, 31.0}) // nearly as large as the others
        EXPECT_FALSE(fifthHasNetwork(distance)) << distance;
    EXPECT_TRUE(fifthHasNetwork(20.0));
    for (const double distance : {29.5, 30.5, 29.0, 31.0})
        EXPECT_TRUE(fifthHasNetwork(distance)) << distance;
    EXPECT_FALSE(fifthHasNetwork(45.0));
}

TEST(FieldPlan, equalInputsGiveEqualPlans)
{
    const FieldScene scene(randomBalls(150, 5, glm::dvec3(0.0)), cameraAt({0, 0, 9}, {0, 0, 0}));
    const FieldPlan a = planOf(scene, 64), b = planOf(scene, 64);
    EXPECT_TRUE(std::equal(a.table().begin(), a.table().end(), b.table().begin(), b.table().end()));
    EXPECT_TRUE(std::equal(a.balls().begin(), a.balls().end(), b.balls().begin(), b.balls().end()));
}

namespace {

/// Balls in the middles of 4 x 3 x 2 bricks of voxels of `side` [m], whose lattice begins at `origin`.
std::vector<FieldBall> brickBalls(const glm::dvec3& origin, double side)
{
    std::vector<FieldBall> balls;
    for (int i = 0; i < 24; ++i)
        balls.push_back({.center = origin + 8.0 * side * (glm::dvec3(i % 4, i / 4 % 3, i / 12) + 0.5),
                         .radius = float(8.0 * side)});
    return balls;
}

FieldPlan planOfVolume(const glm::dvec3& eye, const FieldVolume& volume, uint32_t mostBricks)
{
    FieldScene scene(brickBalls(eye + volume.origin, volume.side), cameraAt(eye, eye - glm::dvec3(0, 0, 1)));
    scene.effects[0].volume = 0;
    FieldPlan plan(std::pmr::new_delete_resource());
    FieldPlanInputs in = scene.inputs(kWidth, kHeight, 64);
    in.mostBricks = mostBricks;
    in.volumes = {&volume, 1};
    plan.build(in);
    return plan;
}

} // namespace

TEST(FieldPlan, theFieldOfAVolumeHasItsLatticeAndItsBricksOnly)
{
    const FieldVolume volume{
        .origin = {-0.51, -0.37, -4.03}, .side = 0.037, .isAligned = true, .largest = 7.0f};
    const FieldPlan plan = planOfVolume({1e4, 0.3, -2.7}, volume, 0);
    ASSERT_EQ(plan.volumes().size(), 1u);
    EXPECT_EQ(plan.volumes()[0].level, 0);
    EXPECT_EQ(plan.volumes()[0].brickCount, 24u);
    EXPECT_EQ(plan.bricks().size(), 24u);
    EXPECT_TRUE(plan.loose().empty());
    const FieldBlock& field = plan.fields()[0];
    EXPECT_FLOAT_EQ(field.corner.w, 0.037f);
    EXPECT_EQ(glm::ivec3(field.bricks), glm::ivec3(4, 3, 2));
    for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(field.corner[a], volume.origin[a], 1e-5);
    EXPECT_LT(field.limits.x, 0.0f);
    EXPECT_EQ(field.limits.y, 7.0f);
}

TEST(FieldPlan, aVolumeBeyondItsBudgetHasVoxelsOfAPowerOfTwo)
{
    const FieldVolume volume{
        .origin = {-0.51, -0.37, -4.03}, .side = 0.037, .isAligned = true, .largest = 7.0f};
    const FieldPlan plan = planOfVolume({0, 0, 0}, volume, 1); // 8 bricks of volumes
    ASSERT_EQ(plan.volumes().size(), 1u);
    EXPECT_GT(plan.volumes()[0].level, 0);
    EXPECT_LE(plan.bricks().size(), 8u);
    EXPECT_FLOAT_EQ(plan.fields()[0].corner.w, std::ldexp(0.037f, plan.volumes()[0].level));
}
