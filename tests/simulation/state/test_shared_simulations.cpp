// Equal instances share a run in the world; the results are the same as without sharing.
#include "tests/simulation/busy_effect.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

struct Made
{
    std::vector<sim::QualityLevel> qualities;
};

/// Notes with which quality its solvers are made, and makes those of an emitter.
struct NotingDef final : sim::SolverDef
{
    explicit NotingDef(Made* target) : made(target) {}
    std::unique_ptr<sim::Solver> create(const base::SnapshotSchema& schema, const sim::Quality& quality,
                                        std::pmr::memory_resource* memory) const override
    {
        made->qualities.push_back(quality.level);
        return emitter->create(schema, quality, memory);
    }
    uint32_t capacity() const override { return 1; }
    bool publishes(const base::KindDesc&) const override { return false; }
    Made* made;
    std::unique_ptr<sim::EmitterDef> emitter = rateEmitter(60.0f);
};

std::shared_ptr<sim::EffectDef> notingEffect(Made& made)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(std::make_unique<NotingDef>(&made));
    return effect;
}

/// Hash of one instance alone after `steps` steps.
uint64_t aloneAfter(int steps)
{
    Stage stage;
    const sim::Slot slot = stage.add({}, busyEffect(100));
    stage.play(steps);
    return stage.world().hash({&slot, 1});
}

} // namespace

TEST(SharedRuns, aSlotLeftOutOfAStepStaysBehindWithItsOwnState)
{
    const auto effect = busyEffect(100);
    Stage stage;
    sim::World& world = stage.world();
    const std::vector<sim::Slot> slots{world.add(effect, {}), world.add(effect, {}), world.add(effect, {}),
                                       world.add(effect, {})};
    EXPECT_EQ(world.simulations(), 1u);
    for (int i = 0; i < 5; ++i)
        world.step(slots, i * kStep, kStep);
    EXPECT_EQ(world.simulations(), 1u);
    for (int i = 5; i < 9; ++i)
        world.step(std::span(slots).first(2), i * kStep, kStep);
    EXPECT_EQ(world.simulations(), 2u); // two and two
    const auto hashOf = [&](size_t i) { return world.hash({&slots[i], 1}); };
    EXPECT_EQ(hashOf(0), aloneAfter(9));
    EXPECT_EQ(hashOf(1), hashOf(0));
    EXPECT_EQ(hashOf(2), aloneAfter(5));
    EXPECT_EQ(hashOf(3), hashOf(2));
    for (const sim::Slot slot : slots)
        world.remove(slot);
    EXPECT_EQ(world.simulations(), 0u);
}

TEST(SharedRuns, nobodyJoinsARunThatHasBegun)
{
    const auto effect = busyEffect(50);
    Stage stage;
    stage.add({}, effect);
    stage.step();
    stage.add({}, effect);
    EXPECT_EQ(stage.world().simulations(), 2u);
}

TEST(SharedRuns, aRunThatOnlyWaitsForItsStartCanBeJoined)
{
    const auto effect = busyEffect(50);
    Stage stage;
    sim::InstanceStart start;
    start.startTick = 2 * kStep;
    stage.add(start, effect);
    stage.step();
    stage.add(start, effect);
    EXPECT_EQ(stage.world().simulations(), 1u);
    stage.play(2);
    stage.add(start, effect);
    EXPECT_EQ(stage.world().simulations(), 2u);
}

TEST(SharedRuns, aWorldThatDoesNotShareGivesTheSame)
{
    base::SnapshotSchema schema;
    base::HostMemory memory;
    const auto tasks = base::makeSerialRunner();
    sim::World world(&schema, tasks.get(), &memory, {}, false);
    const auto effect = busyEffect(100);
    const std::vector<sim::Slot> slots{world.add(effect, {}), world.add(effect, {})};
    EXPECT_EQ(world.simulations(), 2u);
    for (int i = 0; i < 9; ++i)
        world.step(slots, i * kStep, kStep);
    EXPECT_EQ(world.hash(std::span(slots).first(1)), aloneAfter(9));
    EXPECT_EQ(world.hash(std::span(slots).subspan(1)), aloneAfter(9));
}

TEST(SharedRuns, qualityReachesTheSolversAndOnlyEqualQualitiesShare)
{
    Made made;
    const auto effect = notingEffect(made);
    Stage stage;
    sim::InstanceStart start;
    stage.add(start, effect);
    start.quality = sim::QualityLevel::Low;
    const sim::Slot low = stage.add(start, effect);
    stage.add(start, effect);
    EXPECT_EQ(made.qualities, (std::vector{sim::QualityLevel::Medium, sim::QualityLevel::Low}));
    stage.play(3);
    stage.world().setParameters(low, {2.0f, {}, true});
    EXPECT_EQ(made.qualities.back(), sim::QualityLevel::Low); // a copy is of the same quality
    EXPECT_EQ(made.qualities.size(), 3u);
}

TEST(SharedRuns, aHigherQualityIsNeverCheaper)
{
    using Level = sim::QualityLevel;
    for (const Level level : {Level::Medium, Level::High, Level::Reference}) {
        const sim::Quality less = sim::qualityOf(Level(int(level) - 1));
        const sim::Quality more = sim::qualityOf(level);
        EXPECT_EQ(more.level, level);
        EXPECT_GT(more.particles, less.particles);
        EXPECT_GE(more.neighbors, less.neighbors);
        EXPECT_LT(more.radiusFloor, less.radiusFloor);
        EXPECT_LE(more.flowMach, less.flowMach);
    }
    EXPECT_EQ(sim::qualityOf(Level::Medium).particles, 1.0f); // presets are written for it
}

TEST(SharedRuns, manyDifferentRunsAreToldApart)
{
    const auto effect = busyEffect(4);
    Stage stage;
    std::vector<sim::Slot> slots;
    for (uint64_t i = 0; i < 3000; ++i) { // many to a chain
        sim::InstanceStart start;
        start.seed = i % 999;
        slots.push_back(stage.add(start, effect));
    }
    EXPECT_EQ(stage.world().simulations(), 999u);
    for (size_t i = 0; i < slots.size(); i += 2)
        stage.world().remove(slots[i]);
    EXPECT_EQ(stage.world().simulations(), 999u); // of three that share at least one is left
    for (size_t i = 1; i < slots.size(); i += 2)
        stage.world().remove(slots[i]);
    EXPECT_EQ(stage.world().simulations(), 0u);
}
