/// Tiles of rays against looking at every ball.

#include "rendering/reference/trace/tile_candidates.h"

#include "rendering/reference/trace/ray_query.h"
#include "tests/foundation/every_set.h"
#include "tests/rendering/reference/trace/ball_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace fx::render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kTile = 16;

RayGrid perspectiveGrid(double distance)
{
    RayGrid grid;
    grid.origin = {0.1, 0.2, distance};
    grid.direction = {-0.5, 0.4, -1.0};
    grid.directionX = {1.0 / 48, 0.0, 0.0};
    grid.directionY = {0.0, -0.8 / 32, 0.0};
    return grid;
}

RayGrid parallelGrid()
{
    RayGrid grid;
    grid.origin = {-1.2, 1.0, 3.0};
    grid.originX = {2.4 / 48, 0.0, 0.0};
    grid.originY = {0.0, -2.0 / 32, 0.0};
    grid.direction = {0.0, 0.0, -1.0};
    return grid;
}

/// Compares all rays of a picture of 48 x 32 with single-ray queries, which other tests compare with brute
/// force. @return hits in all
size_t compareWithQueries(const BallTree& tree, const RayGrid& grid, double farthest, const std::string& name)
{
    TileCandidates tile;
    TileCandidates part;
    RayHits hits;
    RayHits expected;
    size_t total = 0;
    for (int ty = 0; ty < 32; ty += kTile)
        for (int tx = 0; tx < 48; tx += kTile) {
            const PixelRect whole{double(tx), double(ty), double(tx + kTile), double(ty + kTile)};
            tile.collect(tree, frustumOf(grid, whole, farthest));
            for (int y = ty; y < ty + kTile; ++y)
                for (int x = tx; x < tx + kTile; ++x) {
                    if (x % 4 == 0)
                        part.narrow(
                            tile,
                            frustumOf(grid, {double(x), double(y), double(x + 4), double(y + 1)}, farthest));
                    const TraceRay ray = grid.ray(x + 0.5, y + 0.5);
                    part.hits(ray, 0.01, farthest, hits);
                    findHits(tree, ray, 0.01, farthest, expected);
                    EXPECT_EQ(hits.size(), expected.size()) << name << " at " << x << " " << y;
                    for (size_t i = 0; i < std::min(hits.size(), expected.size()); ++i) {
                        EXPECT_EQ(hits.place[i], expected.place[i]) << name;
                        EXPECT_EQ(hits.chordSquare[i], expected.chordSquare[i]) << name;
                    }
                    total += hits.size();
                }
        }
    return total;
}

TEST(TileCandidates, everyRayOfATileFindsWhatItWouldFindAlone)
{
    for (const test::BallScene& scene : test::ballScenes()) {
        BallTree tree;
        tree.build(scene.balls, glm::dvec3(0.0), *base::makeSerialRunner());
        size_t total = 0;
        for (const RayGrid& grid : {perspectiveGrid(4.0), perspectiveGrid(0.0), parallelGrid()})
            for (const double farthest : {kInf, 2.0})
                total += compareWithQueries(tree, grid, farthest, scene.name);
        EXPECT_TRUE(total > 0 || scene.balls.size() < 9 || scene.name == "clustered") << scene.name;
    }
}

TEST(TileCandidates, theInstructionSetDoesNotMatter)
{
    const test::Balls balls = test::randomBalls(800, 0.02, 0.3, 31);
    BallTree tree;
    tree.build(balls, glm::dvec3(0.0), *base::makeSerialRunner());
    test::everySet([&](base::InstructionSet) {
        EXPECT_GT(compareWithQueries(tree, perspectiveGrid(4.0), kInf, "random"), 1000u);
    });
}

TEST(TileCandidates, listOfATileFarFromAllIsEmpty)
{
    BallTree tree;
    tree.build(test::randomBalls(800, 0.02, 0.3, 32), glm::dvec3(0.0), *base::makeSerialRunner());
    const RayGrid grid = perspectiveGrid(4.0);
    TileCandidates tile;
    tile.collect(tree, frustumOf(grid, {-800, -800, -784, -784}, kInf));
    EXPECT_EQ(tile.size(), 0u);
    RayHits hits;
    tile.hits(grid.ray(0, 0), 0.0, kInf, hits);
    EXPECT_EQ(hits.size(), 0u);
}

TEST(TileCandidates, aTileKeepsFewBallsThatNoneOfItsRaysMeets)
{
    BallTree tree;
    tree.build(test::randomBalls(20'000, 0.02, 0.02, 33), glm::dvec3(0.0), *base::makeSerialRunner());
    const RayGrid grid = perspectiveGrid(4.0);
    TileCandidates tile;
    tile.collect(tree, frustumOf(grid, {16, 16, 24, 24}, kInf));
    size_t met = 0;
    for (size_t i = 0; i < tile.size(); ++i) {
        const TraceBall ball{{tile.column(TileCandidates::X)[i], tile.column(TileCandidates::Y)[i],
                              tile.column(TileCandidates::Z)[i]},
                             tile.column(TileCandidates::Radius)[i]};
        bool isMet = false;
        for (int k = 0; k < 64 * 64 && !isMet; ++k)
            isMet = test::meets(grid.ray(16 + (k % 64) / 8.0, 16 + double(k / 64) / 8.0), ball, 0.0, kInf);
        met += isMet ? 1 : 0;
    }
    ASSERT_GT(met, 100u);
    EXPECT_LT(double(tile.size()), 1.1 * double(met));
}

} // namespace
} // namespace fx::render
