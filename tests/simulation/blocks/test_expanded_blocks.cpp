// Tests the balls of hierarchies of blocks: placements, ids, bounds, and that balls are computed only when
// they are read.
#include "block_fixture.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

using namespace fx;
using namespace fx::test;

namespace {

namespace blob = base::blob_column;

sim::BlocksDef defOf(std::vector<sim::BlockType> types, std::vector<sim::BlockPlacement> blocks)
{
    sim::BlocksDef def;
    def.types = std::move(types);
    EXPECT_TRUE(sim::completeTypes(def.types).ok());
    def.blocks = std::move(blocks);
    return def;
}

/// A pair of balls; a cross of two such pairs; two crosses.
sim::BlocksDef crosses()
{
    const glm::quat quarter(std::sqrt(0.5f), 0.0f, 0.0f, std::sqrt(0.5f)); // about z
    sim::BlockPlacement turned = placedAt({0, 0, 0}, 0, 2.0f);
    turned.rotation = quarter;
    turned.density = 3.0f;
    return defOf({typeOf("pair", sim::BallList{ballAt({1, 0, 0}), ballAt({-1, 0, 0}, 0.5f, 4.0f)}),
                  typeOf("cross", std::vector{placedAt({0, 0, 0}, 0), turned})},
                 {placedAt({10, 0, 0}, 1), placedAt({0, 20, 0}, 1, 0.5f)});
}

} // namespace

TEST(ExpandedBlocks, placesTurnsAndScalesTheBallsOfAllLevels)
{
    BlockBench bench(crosses());
    const base::SnapshotGroup& balls = bench.balls();
    ASSERT_EQ(balls.count(), 8u);
    const glm::vec3 expected[] = {{11, 0, 0},    {9, 0, 0},      {10, 2, 0}, {10, -2, 0},
                                  {0.5f, 20, 0}, {-0.5f, 20, 0}, {0, 21, 0}, {0, 19, 0}};
    for (size_t i = 0; i < 8; ++i)
        EXPECT_LE(glm::length(positionOf(balls, i) - expected[i]), 1e-5f) << i;
    // radius: scale; cross section: density times the square of the scale, so that optical depths are
    // density times as large
    EXPECT_FLOAT_EQ(balls.column(blob::Radius)[3], 2.0f * 0.5f);
    EXPECT_FLOAT_EQ(balls.column(blob::CrossSection)[3], 4.0f * 3.0f * 4.0f);
    EXPECT_FLOAT_EQ(balls.column(blob::Radius)[7], 0.5f * 2.0f * 0.5f);
    EXPECT_FLOAT_EQ(balls.column(blob::CrossSection)[7], 0.25f * 4.0f * 3.0f * 4.0f);
}

TEST(ExpandedBlocks, areInTheOrderOfUniqueIdsWithinTheirBounds)
{
    BlockBench bench(crosses());
    const base::SnapshotGroup& balls = bench.balls();
    const auto ids = balls.ids();
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
    EXPECT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end());
    const base::Bounds& bounds = balls.info().bounds;
    for (size_t i = 0; i < balls.count(); ++i)
        for (int k = 0; k < 3; ++k) {
            EXPECT_GE(positionOf(balls, i)[k] - balls.column(blob::Radius)[i], bounds.min[k]);
            EXPECT_LE(positionOf(balls, i)[k] + balls.column(blob::Radius)[i], bounds.max[k]);
        }
}

TEST(ExpandedBlocks, thousandBlocksOfOneBallAreTheSameAsOneBlockOfThousand)
{
    sim::BallList all;
    std::vector<sim::BlockPlacement> placed;
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 place(float(i % 10), float(i / 10 % 10), float(i / 100));
        all.push_back(ballAt(place));
        placed.push_back(placedAt(place, 0));
    }
    BlockBench many(defOf({typeOf("ball", sim::BallList{ballAt({0, 0, 0})})}, placed));
    BlockBench one(defOf({typeOf("all", all)}, {placedAt({0, 0, 0}, 0)}));
    const base::SnapshotGroup &a = many.balls(), &b = one.balls();
    ASSERT_EQ(a.count(), 1000u);
    ASSERT_EQ(b.count(), 1000u);
    for (size_t column = 0; column < blob::Count; ++column)
        EXPECT_TRUE(std::ranges::equal(a.column(column), b.column(column))) << column;
}

TEST(ExpandedBlocks, emptyBlocksAreNothing)
{
    BlockBench nothing(defOf({typeOf("nothing", sim::BallList{})}, {placedAt({0, 0, 0}, 0)}));
    const base::FrameSnapshot& snapshot = nothing.look();
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        EXPECT_NE(blockSchema().kind(snapshot.name(g).kind), base::kBlobKind);
}

TEST(ExpandedBlocks, beyondTheBoundAreMissingAndCounted)
{
    sim::BlocksDef def = crosses();
    def.maxParticles = 5;
    BlockBench bench(def);
    const base::FrameSnapshot& snapshot = bench.look();
    EXPECT_EQ(snapshot.group(0).constants()[base::block_constant::Refused], 3.0f);
    EXPECT_EQ(snapshot.group(0).constants()[base::block_constant::Blocks], 6.0f);
    EXPECT_EQ(bench.balls().count(), 5u);
}

TEST(ExpandedBlocks, areNoPartOfTheHashOfASnapshotAndDoNotChangeIt)
{
    BlockBench bench(crosses());
    const base::FrameSnapshot& snapshot = bench.look();
    const uint64_t before = snapshot.hash();
    EXPECT_EQ(snapshot.group(snapshot.groupCount() - 1).count(), 8u);
    EXPECT_EQ(snapshot.hash(), before);
    sim::BlocksDef other = crosses();
    other.blocks[1].density = 2.0f;
    EXPECT_NE(BlockBench(other).look().hash(), before);
    sim::BlocksDef content = crosses();
    content.types[0].balls[0].temperature = 900.0f;
    EXPECT_NE(BlockBench(content).look().hash(), before);
}

TEST(ExpandedBlocks, areTheSameForAllThreadsThatReadThemFirst)
{
    BlockBench bench(crosses());
    for (int round = 0; round < 50; ++round) {
        const base::FrameSnapshot& snapshot = bench.look();
        std::vector<std::thread> readers;
        std::array<float, 4> sums{};
        for (size_t t = 0; t < sums.size(); ++t)
            readers.emplace_back([&, t] {
                for (const float x : snapshot.group(snapshot.groupCount() - 1).column(blob::PositionX))
                    sums[t] += x;
            });
        for (std::thread& reader : readers)
            reader.join();
        EXPECT_EQ(sums, (std::array{sums[0], sums[0], sums[0], sums[0]}));
        EXPECT_NEAR(sums[0], 40.0f, 1e-4f);
    }
}

TEST(ExpandedBlocks, contentDoesNotDependOnWhereItsBlocksAre)
{
    BlockBench near(
        defOf({typeOf("ball", sim::BallList{ballAt({0.1f, 0.2f, 0.3f})})}, {placedAt({0, 0, 0}, 0)}));
    BlockBench far(
        defOf({typeOf("ball", sim::BallList{ballAt({0.1f, 0.2f, 0.3f})})}, {placedAt({1e5f, 0, 0}, 0)}));
    const base::SnapshotGroup &a = near.look().group(1), &b = far.look().group(1);
    EXPECT_EQ(blockSchema().kind(a.info().kind), base::kBlockBallKind);
    for (size_t column = 0; column < blob::Count; ++column)
        EXPECT_TRUE(std::ranges::equal(a.column(column), b.column(column))) << column;
}
