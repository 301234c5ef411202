#include "tests/simulation/stage.h"

#include <gtest/gtest.h>

#include <new>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

/// Records what it is told, so that tests can ask what the world asks of solvers.
struct Recording
{
    std::vector<sim::StepContext> steps;
};

class RecordingSolver final : public sim::Solver
{
public:
    explicit RecordingSolver(Recording* recording) : recording_(recording) {}
    void step(const sim::StepContext& context) override { recording_->steps.push_back(context); }
    void publish(const base::GroupInfo&, base::FrameSnapshot&) const override {}
    bool finished(base::Ticks tick) const override { return tick >= kStep; }
    uint32_t elementCount() const override { return 3; }
    void save(sim::StateWriter&) const override {}
    void restore(sim::StateReader&) override {}

private:
    Recording* recording_;
};

struct RecordingDef final : sim::SolverDef
{
    explicit RecordingDef(Recording* target) : recording(target) {}
    std::unique_ptr<sim::Solver> create(const base::SnapshotSchema&, const sim::Quality&,
                                        std::pmr::memory_resource*) const override
    {
        return std::make_unique<RecordingSolver>(recording);
    }
    uint32_t capacity() const override { return 3; }
    bool publishes(const base::KindDesc&) const override { return false; }
    Recording* recording;
};

/// Fails when its solver is made.
struct FailingDef final : sim::SolverDef
{
    std::unique_ptr<sim::Solver> create(const base::SnapshotSchema&, const sim::Quality&,
                                        std::pmr::memory_resource*) const override
    {
        throw std::bad_alloc();
    }
    uint32_t capacity() const override { return 0; }
    bool publishes(const base::KindDesc&) const override { return false; }
};

std::shared_ptr<sim::EffectDef> recordingEffect(Recording& recording)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(std::make_unique<RecordingDef>(&recording));
    return effect;
}

} // namespace

TEST(World, stepsOnlyWhatItIsGiven)
{
    Recording asked;
    Recording left;
    Stage stage;
    const sim::Slot slot = stage.world().add(recordingEffect(asked), {});
    stage.world().add(recordingEffect(left), {});
    stage.world().step({&slot, 1}, 0, kStep);
    EXPECT_EQ(asked.steps.size(), 1u);
    EXPECT_TRUE(left.steps.empty());
}

TEST(World, subStepsTileTheStepExactly)
{
    Recording recording;
    Stage stage;
    auto effect = recordingEffect(recording);
    effect->subSteps = 11; // does not divide the ticks of a step
    stage.add({}, effect);
    stage.play(3);
    ASSERT_EQ(recording.steps.size(), 33u);
    base::Ticks tick = 0;
    for (const sim::StepContext& step : recording.steps) {
        EXPECT_EQ(step.tick, tick);
        tick += step.stepTicks;
    }
    EXPECT_EQ(tick, 3 * kStep);
}

TEST(World, anInstanceBeginsAtItsOwnStartWithinAStep)
{
    Recording recording;
    Stage stage;
    sim::InstanceStart start;
    start.startTick = kStep + kStep / 4;
    const sim::Slot slot = stage.add(start, recordingEffect(recording));
    stage.step();
    EXPECT_TRUE(recording.steps.empty());
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.step();
    ASSERT_EQ(recording.steps.size(), 1u);
    EXPECT_EQ(recording.steps[0].tick, 0);
    EXPECT_EQ(recording.steps[0].stepTicks, kStep - kStep / 4);
    stage.step();
    EXPECT_EQ(recording.steps[1].tick, kStep - kStep / 4);
    EXPECT_EQ(recording.steps[1].stepTicks, kStep);
}

TEST(World, anEmptyStepDoesNothing)
{
    Recording recording;
    Stage stage;
    stage.add({}, recordingEffect(recording));
    stage.step(0);
    stage.step(-kStep);
    EXPECT_TRUE(recording.steps.empty());
}

TEST(World, gravityAndWindTurnWithTheInstanceAndTheGroundIsOptional)
{
    Recording recording;
    Stage stage;
    sim::InstanceStart start;
    start.placement.rotation = glm::angleAxis(1.5707963f, glm::vec3(0, 0, 1)); // local +X is world +Y
    start.placement.scale = 2.0f;
    start.parameters.wind = {0, 4, 0};
    auto effect = recordingEffect(recording);
    effect->hasGround = false;
    effect->wind = {0, 0, 1};
    stage.add(start, effect);
    stage.step();
    const sim::StepContext& step = recording.steps.at(0);
    EXPECT_NEAR(step.gravity.x, -9.80665f, 1e-5f);
    EXPECT_NEAR(step.gravity.y, 0.0f, 1e-5f);
    EXPECT_NEAR(step.wind.x, 2.0f, 1e-5f);
    EXPECT_EQ(step.wind.z, 1.0f);
    EXPECT_EQ(step.groundHeight, -std::numeric_limits<float>::infinity());
}

TEST(World, durationEndsWhatNeverEndsByItself)
{
    Stage stage;
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(rateEmitter(10.0f));
    effect->duration = 2 * kStep;
    const sim::Slot slot = stage.add({}, effect);
    stage.step();
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.step();
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
}

TEST(World, aRemovedSlotIsUsedAgainAndItsMemoryReturned)
{
    Stage stage;
    const uint64_t before = stage.memory().bytesInUse();
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(burstEmitter(10));
    const sim::Slot a = stage.world().add(effect, {});
    const sim::Slot b = stage.world().add(effect, {});
    EXPECT_NE(a, b);
    stage.world().remove(a);
    EXPECT_EQ(stage.world().elementCount(a), 0u);
    EXPECT_EQ(stage.world().add(effect, {}), a);
    stage.world().remove(a);
    stage.world().remove(b);
    EXPECT_EQ(stage.memory().bytesInUse(), before);
}

TEST(World, anInstanceThatCannotBeMadeChangesNothing)
{
    Stage stage;
    const uint64_t before = stage.memory().bytesInUse();
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(burstEmitter(10));
    effect->solvers.push_back(std::make_unique<FailingDef>());
    EXPECT_THROW(stage.world().add(effect, {}), std::bad_alloc);
    EXPECT_EQ(stage.memory().bytesInUse(), before);
    auto good = std::make_shared<sim::EffectDef>();
    EXPECT_EQ(stage.world().add(good, {}), 0u);
}

TEST(World, groupsCarryInstanceSolverAndPlacement)
{
    Stage stage;
    sim::InstanceStart start;
    start.instance = 77;
    const sim::Slot slot = stage.add(start, burstEmitter(2), burstEmitter(3));
    stage.step();
    base::Placement placement;
    placement.position = {1e5, 2, 3};
    stage.world().setPlacement(slot, placement);
    const base::FrameSnapshot& snapshot = stage.look();
    ASSERT_EQ(snapshot.groupCount(), 2u);
    EXPECT_EQ(snapshot.group(1).info().instance, 77u);
    EXPECT_EQ(snapshot.group(1).info().solver, 1u);
    EXPECT_EQ(snapshot.group(1).info().count, 3u);
    EXPECT_EQ(snapshot.group(1).info().placement.position.x, 1e5);
}

TEST(World, placementDoesNotChangeTheLocalState)
{
    const auto heights = [](const glm::dvec3& position) {
        Stage stage;
        sim::InstanceStart start;
        start.placement.position = position;
        stage.add(start, burstEmitter(1));
        stage.play(30);
        return stage.look().group(0).column(blob::PositionY)[0];
    };
    EXPECT_EQ(heights({0, 0, 0}), heights({1e7, -1e6, 3}));
}

TEST(World, hasTheGravityAndTheGroundOfItsEnvironment)
{
    Recording recording;
    base::SnapshotSchema schema;
    base::HostMemory memory;
    const auto tasks = base::makeSerialRunner();
    sim::World world(&schema, tasks.get(), &memory, {{0.0f, -1.62f, 0.0f}, false});
    const sim::Slot slot = world.add(recordingEffect(recording), {});
    world.step({&slot, 1}, 0, kStep);
    EXPECT_EQ(recording.steps.at(0).gravity, glm::vec3(0.0f, -1.62f, 0.0f));
    EXPECT_EQ(recording.steps.at(0).groundHeight, -std::numeric_limits<float>::infinity());
}
