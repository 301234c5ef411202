// Blocks of an effect: levels, types in use, phases, emitters, states and threads.
#include "block_fixture.h"

#include <algorithm>
#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

namespace block = base::block_column;
namespace blob = base::blob_column;

std::shared_ptr<const sim::BlockLoop> loopOf(uint64_t seed = 1)
{
    sim::BlockLoop::Settings settings;
    settings.period = 2.0f;
    settings.frames = 20;
    settings.seed = seed;
    return *sim::BlockLoop::record(*boiling(), settings);
}

/// Two types of balls, one of them in a loop of four phases, and a type of blocks.
sim::BlocksDef threeTypes()
{
    sim::BlocksDef def;
    def.types.push_back(typeOf("still", sim::BallList{ballAt({0, 1, 0})}));
    sim::BlockType boil;
    boil.name = "boil";
    boil.loop = loopOf();
    boil.phases = 4;
    def.types.push_back(boil);
    def.types.push_back(
        typeOf("pair", std::vector{placedAt({-3, 0, 0}, 1), placedAt({3, 0, 0}, 1, 1.0f, 1)}));
    EXPECT_TRUE(sim::completeTypes(def.types).ok());
    return def;
}

/// Blocks that an emitter gives birth to.
sim::BlocksDef emitted()
{
    sim::BlocksDef def = threeTypes();
    const auto emitter = boiling(20.0f);
    emitter->radius = {2.0f, 4.0f};
    def.emitter = emitter;
    def.emitted = {0, 1, 2};
    def.turn = sim::BlockTurn::Free;
    return def;
}

size_t contentGroups(const base::FrameSnapshot& snapshot)
{
    size_t count = 0;
    for (size_t g = 0; g < snapshot.addedCount(); ++g) {
        const auto& kind = blockSchema().kind(snapshot.added(g).info().kind);
        count += kind == base::kBlockBallKind || (kind == base::kBlockKind && g > 0) ? 1 : 0;
    }
    return count;
}

} // namespace

TEST(BlockTypes, fourLevelsAreTheMost)
{
    std::vector<sim::BlockType> types{typeOf("level 1", sim::BallList{ballAt({0, 0, 0})})};
    for (uint32_t level = 2; level <= 4; ++level)
        types.push_back(typeOf("level", std::vector(2, placedAt({1, 0, 0}, level - 2))));
    ASSERT_TRUE(sim::completeTypes(types).ok());
    EXPECT_EQ(types[3].levels, 4u);
    EXPECT_EQ(types[3].ballCount, 8u);
    EXPECT_EQ(types[3].blockCount, 2u + 4u + 8u);
    types.push_back(typeOf("deepest", std::vector{placedAt({0, 0, 0}, 3)}));
    const base::Status status = sim::completeTypes(types);
    EXPECT_EQ(status.code(), base::Code::InvalidArgument);
    EXPECT_NE(status.message().find("\"deepest\" has 5 levels of blocks; allowed are 4"), std::string::npos)
        << status.message();
}

TEST(BlockTypes, aBlockOfTooManyBlocksIsRefused)
{
    std::vector<sim::BlockType> types{typeOf("puff", sim::BallList{ballAt({0, 0, 0})})};
    types.push_back(typeOf("cloud", std::vector(2048, placedAt({1, 0, 0}, 0))));
    ASSERT_TRUE(sim::completeTypes(types).ok());
    types.push_back(typeOf("sky", std::vector(2048, placedAt({1, 0, 0}, 1))));
    EXPECT_EQ(sim::completeTypes(types).code(), base::Code::TooLarge);
}

TEST(BlockTypes, fourLevelsAreExpanded)
{
    sim::BlocksDef def;
    def.types.push_back(typeOf("level 1", sim::BallList{ballAt({0, 0, 0})}));
    for (uint32_t level = 2; level <= 4; ++level)
        def.types.push_back(typeOf("level", std::vector{placedAt({-1, 0, 0}, level - 2, 0.5f),
                                                        placedAt({1, 0, 0}, level - 2, 0.5f)}));
    ASSERT_TRUE(sim::completeTypes(def.types).ok());
    def.blocks = {placedAt({0, 0, 0}, 3)};
    BlockBench bench(def);
    const base::SnapshotGroup& balls = bench.balls();
    ASSERT_EQ(balls.count(), 8u);
    for (uint32_t i = 0; i < 8; ++i) { // the places of a Cantor set
        const float x =
            ((i & 4) != 0 ? 1.0f : -1.0f) + ((i & 2) != 0 ? 0.5f : -0.5f) + ((i & 1) != 0 ? 0.25f : -0.25f);
        EXPECT_FLOAT_EQ(balls.column(blob::PositionX)[i], x);
    }
}

TEST(BlockTypes, aTypeConsistsOfTypesBeforeItOnly)
{
    std::vector<sim::BlockType> types{typeOf("itself", std::vector{placedAt({0, 0, 0}, 0)})};
    EXPECT_EQ(sim::completeTypes(types).code(), base::Code::InvalidArgument);
}

TEST(BlocksSolver, publishesTheTypesAndPhasesInUseOnce)
{
    sim::BlocksDef def = threeTypes();
    def.blocks = {placedAt({0, 0, 0}, 0), placedAt({9, 0, 0}, 0)};
    EXPECT_EQ(contentGroups(BlockBench(def).look()), 1u);
    def.blocks = {placedAt({0, 0, 0}, 1, 1.0f, 2), placedAt({9, 0, 0}, 1, 1.0f, 2)};
    EXPECT_EQ(contentGroups(BlockBench(def).look()), 1u);
    def.blocks = {placedAt({0, 0, 0}, 1, 1.0f, 2), placedAt({9, 0, 0}, 1, 1.0f, 3)};
    EXPECT_EQ(contentGroups(BlockBench(def).look()), 2u);
    def.blocks = {placedAt({0, 0, 0}, 2)}; // itself, and two phases of what it consists of
    EXPECT_EQ(contentGroups(BlockBench(def).look()), 3u);
    def.blocks = {placedAt({0, 0, 0}, 2, 1.0f, 1), placedAt({9, 0, 0}, 2)};
    EXPECT_EQ(contentGroups(BlockBench(def).look()), 5u);
}

TEST(BlocksSolver, aPhaseIsAheadByItsShareOfThePeriod)
{
    sim::BlocksDef ahead = threeTypes(), late = threeTypes();
    ahead.blocks = {placedAt({0, 0, 0}, 1, 1.0f, 1)};
    late.blocks = {placedAt({0, 0, 0}, 1)};
    BlockBench a(ahead), b(late);
    b.play(30); // a quarter of the period of 2 s
    const base::SnapshotGroup &first = a.balls(), &second = b.balls();
    ASSERT_EQ(first.count(), second.count());
    for (size_t i = 0; i < first.count(); ++i)
        EXPECT_LE(glm::length(positionOf(first, i) - positionOf(second, i)), 1e-4f);
}

TEST(BlocksSolver, contentIsAFunctionOfTimeHoweverItIsReached)
{
    sim::BlocksDef def = threeTypes();
    def.blocks = {placedAt({0, 0, 0}, 2)};
    BlockBench stepped(def), jumped(def);
    stepped.play(77);
    ASSERT_TRUE(jumped.restore(stepped.state(), stepped.tick()));
    EXPECT_EQ(stepped.look().hash(), jumped.look().hash());
}

TEST(BlocksSolver, particlesOfItsEmitterAreBlocksOfTheirSizeAndDepth)
{
    const sim::BlocksDef def = emitted();
    BlockBench bench(def);
    bench.play(120);
    const base::SnapshotGroup& blocks = bench.look().group(0);
    ASSERT_GT(blocks.count(), 20u);
    bool differ = false;
    for (size_t i = 0; i < blocks.count(); ++i) {
        const auto variant = uint32_t(blocks.column(block::Variant)[i]);
        const sim::BlockType& type = def.types[variant / base::kMaxBlockPhases];
        const float radius = blocks.column(block::Scale)[i] * type.radius;
        EXPECT_GE(radius, 2.0f * 0.999f);
        EXPECT_LE(radius, 4.0f * 1.001f);
        EXPECT_NEAR(blocks.column(block::Density)[i], 1.0f, 1e-4f); // the emitter's optical depth
        float norm = 0.0f;
        for (size_t k = 0; k < 4; ++k)
            norm += blocks.column(block::RotationX + k)[i] * blocks.column(block::RotationX + k)[i];
        EXPECT_NEAR(norm, 1.0f, 1e-5f);
        differ = differ || variant != uint32_t(blocks.column(block::Variant)[0]);
    }
    EXPECT_TRUE(differ);
}

TEST(BlocksSolver, ballsMoveWithTheirBlock)
{
    const sim::BlocksDef def = emitted();
    BlockBench bench(def);
    bench.play(100);
    std::vector<std::pair<uint64_t, glm::vec3>> before;
    const base::SnapshotGroup& first = bench.balls();
    for (size_t i = 0; i < first.count(); ++i)
        before.emplace_back(first.ids()[i], positionOf(first, i));
    bench.play(1);
    const base::SnapshotGroup& second = bench.balls();
    size_t found = 0, k = 0;
    for (size_t i = 0; i < second.count(); ++i) {
        while (k < before.size() && before[k].first < second.ids()[i])
            ++k;
        if (k == before.size() || before[k].first != second.ids()[i])
            continue;
        ++found;
        const glm::vec3 velocity(second.column(blob::VelocityX)[i], second.column(blob::VelocityY)[i],
                                 second.column(blob::VelocityZ)[i]);
        const glm::vec3 way = (positionOf(second, i) - before[k].second) * 60.0f;
        EXPECT_LE(glm::length(way - velocity), 0.15f * glm::length(velocity) + 0.5f);
    }
    EXPECT_GT(found, 100u);
}

TEST(BlocksSolver, hasTheSameStateForAnyNumberOfThreads)
{
    const sim::BlocksDef def = emitted();
    BlockBench serial(def);
    serial.play(150);
    for (const uint32_t threads : {1u, 2u, 16u}) {
        BlockBench parallel(def, base::makeTbbRunner(threads));
        parallel.play(150);
        EXPECT_EQ(parallel.state(), serial.state()) << threads;
        EXPECT_EQ(parallel.look().hash(), serial.look().hash()) << threads;
    }
}

TEST(BlocksSolver, continuesFromASavedState)
{
    const sim::BlocksDef def = emitted();
    BlockBench whole(def);
    whole.play(60);
    const std::vector<std::byte> saved = whole.state();
    BlockBench restored(def);
    ASSERT_TRUE(restored.restore(saved, whole.tick()));
    EXPECT_EQ(restored.look().hash(), whole.look().hash());
    whole.play(60);
    restored.play(60);
    EXPECT_EQ(restored.state(), whole.state());
    EXPECT_EQ(restored.look().hash(), whole.look().hash());
}

TEST(BlocksSolver, refusesStatesThatAreCutOrOfOtherBlocks)
{
    const sim::BlocksDef def = emitted();
    BlockBench bench(def);
    bench.play(30);
    const std::vector<std::byte> saved = bench.state();
    for (size_t size = 0; size < saved.size(); size += 7)
        EXPECT_FALSE(BlockBench(def).restore(std::span(saved).first(size), bench.tick())) << size;
    sim::BlocksDef other = emitted();
    other.types[0].balls[0].radius = 2.0f;
    EXPECT_FALSE(BlockBench(other).restore(saved, bench.tick()));
}

TEST(BlocksSolver, stepsAndPublishesWithoutAllocations)
{
    const sim::BlocksDef def = emitted();
    BlockBench bench(def);
    uint32_t most = 0;
    for (int i = 0; i < 300; ++i) { // until the snapshot has room for the most balls
        bench.play(1);
        most = std::max(most, bench.balls().count());
    }
    const uint64_t before = bench.allocations();
    for (int i = 0; i < 60; ++i) {
        bench.play(1);
        if (bench.balls().count() > most)
            GTEST_SKIP() << "there are more balls than ever before";
    }
    EXPECT_EQ(bench.allocations(), before);
}

TEST(BlocksSolver, allBallsAreWithinReach)
{
    sim::BlocksDef def = threeTypes();
    def.blocks = {placedAt({5, 0, 0}, 2, 2.0f), placedAt({0, 30, 0}, 0, 3.0f)};
    BlockBench bench(def);
    const float reach = def.reach(9.8f, 0.0f, 10.0f);
    for (int i = 0; i < 20; ++i) {
        bench.play(7);
        const base::SnapshotGroup& balls = bench.balls();
        for (size_t k = 0; k < balls.count(); ++k)
            EXPECT_LE(glm::length(positionOf(balls, k)) + balls.column(blob::Radius)[k], reach);
    }
}
