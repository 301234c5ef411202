/// The tree over balls: what single rays find in it, and that building it is repeatable.

#include "rendering/reference/trace/ball_tree.h"

#include "rendering/reference/trace/ray_query.h"
#include "tests/foundation/every_set.h"
#include "tests/rendering/reference/trace/ball_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace fx::render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

BallTree treeOf(const test::Balls& balls, const glm::dvec3& origin = glm::dvec3(0.0))
{
    BallTree tree;
    tree.build(balls, origin, *base::makeSerialRunner());
    return tree;
}

/// Indices of the balls that a ray meets, found by looking at all.
std::vector<uint32_t> allHits(const test::Balls& balls, const TraceRay& ray, double begin, double end)
{
    std::vector<uint32_t> found;
    for (uint32_t i = 0; i < balls.size(); ++i)
        if (test::meets(ray, balls[i], begin, end))
            found.push_back(i);
    return found;
}

std::vector<uint32_t> foundHits(const BallTree& tree, const TraceRay& ray, double begin, double end)
{
    RayHits hits;
    findHits(tree, ray, begin, end, hits);
    std::vector<uint32_t> found;
    for (size_t i = 0; i < hits.size(); ++i)
        found.push_back(tree.ballAt(hits.place[i]));
    std::sort(found.begin(), found.end());
    return found;
}

/// Rays from outside and inside, along axes, in coordinate planes, and towards the rims of balls.
std::vector<TraceRay> raysFor(const test::Balls& balls)
{
    test::Chance chance(11);
    std::vector<TraceRay> rays;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 direction = chance.direction();
        rays.push_back({2.0 * chance.inCube() - 3.0 * direction, direction});
        rays.push_back({chance.inCube(), direction}); // from inside
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            glm::dvec3 direction(0.0);
            direction[axis] = sign;
            rays.push_back({chance.inCube(), direction});
            rays.push_back({glm::dvec3(0.0), direction});
        }
    rays.push_back({{0.0, 0.0, 5.0}, glm::normalize(glm::dvec3(0.1, 0.0, -1.0))});
    for (size_t i = 0; i < balls.size(); i += balls.size() / 40 + 1) { // just inside and outside a rim
        const glm::dvec3 direction = chance.direction();
        const glm::dvec3 side = glm::normalize(glm::cross(direction, chance.direction()));
        for (const double part : {1.0 - 1e-9, 1.0 + 1e-9})
            rays.push_back({balls[i].center + side * (balls[i].radius * part) - 2.0 * direction, direction});
    }
    return rays;
}

TEST(BallTree, raysFindExactlyTheBallsThatLookingAtAllFinds)
{
    for (const test::BallScene& scene : test::ballScenes()) {
        const BallTree tree = treeOf(scene.balls);
        size_t met = 0;
        for (const TraceRay& ray : raysFor(scene.balls))
            for (const auto& [begin, end] :
                 {std::pair(0.0, kInf), std::pair(0.5, 2.5), std::pair(-kInf, kInf)}) {
                const auto expected = allHits(scene.balls, ray, begin, end);
                met += expected.size();
                ASSERT_EQ(foundHits(tree, ray, begin, end), expected) << scene.name;
            }
        EXPECT_TRUE(met > 0 || scene.balls.empty()) << scene.name;
    }
}

TEST(BallTree, everyInstructionSetFindsTheSameBits)
{
    const test::Balls balls = test::randomBalls(2000, 0.01, 0.3, 21);
    const BallTree tree = treeOf(balls);
    const auto rays = raysFor(balls);
    std::vector<double> expected;
    test::everySet([&](base::InstructionSet) {
        std::vector<double> numbers;
        RayHits hits;
        for (const TraceRay& ray : rays) {
            findHits(tree, ray, 0.0, kInf, hits);
            for (size_t i = 0; i < hits.size(); ++i)
                numbers.insert(numbers.end(),
                               {hits.enter[i], hits.nearest[i], hits.chordSquare[i], double(hits.place[i])});
        }
        if (expected.empty())
            expected = numbers;
        ASSERT_EQ(numbers.size(), expected.size());
        EXPECT_EQ(std::memcmp(numbers.data(), expected.data(), numbers.size() * sizeof(double)), 0);
    });
}

TEST(BallTree, isTheSameForAnyNumberOfWorkers)
{
    const test::Balls balls = test::randomBalls(20'000, 1e-3, 1.0, 22);
    const BallTree one = treeOf(balls);
    for (const uint32_t threads : {2u, 3u, 7u}) {
        BallTree many;
        many.build(balls, glm::dvec3(0.0), *base::makeTbbRunner(threads));
        ASSERT_EQ(many.leaves().size(), one.leaves().size());
        EXPECT_EQ(std::memcmp(many.leaves().data(), one.leaves().data(), one.leaves().size_bytes()), 0);
        ASSERT_EQ(many.levels(), one.levels());
        for (uint32_t level = 0; level < one.levels(); ++level)
            EXPECT_EQ(std::memcmp(&many.node(level, 0), &one.node(level, 0), sizeof(BallTree::Node)), 0);
    }
}

TEST(BallTree, canBeBuiltAgainOverFewerOrNoBalls)
{
    BallTree tree;
    const auto tasks = base::makeSerialRunner();
    const TraceRay ray{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}};
    for (const size_t count : {size_t(5000), size_t(3), size_t(0), size_t(64)}) {
        const test::Balls balls = test::randomBalls(count, 0.1, 0.4, 23);
        tree.build(balls, glm::dvec3(0.0), *tasks);
        EXPECT_EQ(tree.count(), count);
        EXPECT_EQ(foundHits(tree, ray, 0.0, kInf), allHits(balls, ray, 0.0, kInf));
    }
}

TEST(BallTree, hitsAreOrderedByEntranceAndThenByPlace)
{
    test::Balls balls = test::randomBalls(400, 0.05, 0.5, 24);
    for (size_t i = 0; i < 400; ++i)
        balls.push_back(balls[i]); // enters at the same place
    const BallTree tree = treeOf(balls);
    RayHits hits;
    findHits(tree, {{0.1, 0.1, 5.0}, {0.0, 0.0, -1.0}}, 0.0, kInf, hits);
    hits.sort();
    ASSERT_GT(hits.size(), 12u);
    size_t equal = 0;
    for (size_t i = 1; i < hits.size(); ++i) {
        ASSERT_LE(hits.enter[i - 1], hits.enter[i]);
        if (hits.enter[i - 1] != hits.enter[i])
            continue;
        ASSERT_LT(hits.place[i - 1], hits.place[i]);
        ++equal;
    }
    EXPECT_GT(equal, 1u);
}

/// A grazing chord, against long double on the same numbers.
double chordError(double distance, double part)
{
    test::Chance chance(25);
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 direction = chance.direction();
        const glm::dvec3 side = glm::normalize(glm::cross(direction, chance.direction()));
        const TraceBall ball{direction * distance + side * part, 1.0};
        const BallTree tree = treeOf({ball});
        RayHits hits;
        findHits(tree, {glm::dvec3(0.0), direction}, 0.0, kInf, hits);
        long double t = 0;
        for (int axis = 0; axis < 3; ++axis)
            t += static_cast<long double>(ball.center[axis]) * direction[axis];
        long double across = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const long double p = ball.center[axis] - t * direction[axis];
            across += p * p;
        }
        const double expected = double(std::max(1.0L - across, 0.0L));
        worst = std::max(worst, std::abs((hits.size() > 0 ? hits.chordSquare[0] : 0.0) - expected));
    }
    return worst;
}

TEST(BallTree, chordsOfGrazingRaysKeepTheirDigitsFarAway)
{
    for (const double distance : {1.0, 1e2, 1e4, 1e5})
        for (const double part : {0.5, 0.999, 1.0 - 1e-7})
            EXPECT_LE(chordError(distance, part), 8 * 0x1.0p-53 * (distance + 1.0))
                << distance << " " << part;
}

TEST(BallTree, shiftingBallsAndOriginMovesHitsByTheRoundingOfTheShiftOnly)
{
    const test::Balls balls = test::randomBalls(500, 0.1, 0.4, 26);
    const BallTree here = treeOf(balls);
    const glm::dvec3 shift(1e5, -1e5, 0.5e5);
    test::Balls moved = balls;
    for (TraceBall& ball : moved)
        ball.center += shift;
    const BallTree there = treeOf(moved, shift);
    RayHits a;
    RayHits b;
    const TraceRay ray{{0.2, -0.1, 4.0}, glm::normalize(glm::dvec3(0.02, 0.01, -1.0))};
    findHits(here, ray, 0.0, kInf, a);
    findHits(there, ray, 0.0, kInf, b);
    ASSERT_GT(a.size(), 10u);
    ASSERT_EQ(a.size(), b.size());
    a.sort(); // rounding may have moved a ball to another place of the curve
    b.sort();
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(here.ballAt(a.place[i]), there.ballAt(b.place[i]));
        EXPECT_NEAR(a.chordSquare[i], b.chordSquare[i], 1e-10);
    }
}

} // namespace
} // namespace fx::render
