#include "simulation/particles/birth_kernel.h"
#include "tests/foundation/real_threads.h"
#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

constexpr uint32_t kEach = 40;

/// Small effects of several kinds: other columns, media, integrated motion, two emitters, a host's ground.
std::vector<std::shared_ptr<const sim::EffectDef>> smallEffects()
{
    std::vector<std::unique_ptr<sim::EmitterDef>> defs;
    for (int i = 0; i < 6; ++i) {
        defs.push_back(spriteEmitter(7.0f, {0.8f, 2.4f}));
        defs.back()->maxParticles = 20;
    }
    defs[1]->shape = sim::EmitterShape::Point; // no places, one lifetime: the fused kernel
    defs[1]->lifetime = {2.0f, 2.0f};
    defs[1]->appearance.spin = {0.0f, 0.0f};
    defs[2]->appearance.kind = sim::AppearanceKind::Mesh;
    defs[2]->lifetime = {0.5f, 5.0f};
    defs[2]->emission.bursts = {{0.3f, 8, 5, 0.7f, 0.6f}};
    defs[2]->maxParticles = 9; // some find no row
    defs[3]->forces.curlStrength = 1.0f;
    defs[4]->appearance.kind = sim::AppearanceKind::Medium;
    defs[5]->appearance.alignment = base::SpriteAlignment::Velocity;
    std::vector<std::shared_ptr<const sim::EffectDef>> effects;
    for (auto& def : defs) {
        auto effect = std::make_shared<sim::EffectDef>();
        effect->solvers.push_back(std::move(def));
        effects.push_back(std::move(effect));
    }
    auto both = std::make_shared<sim::EffectDef>();
    both->subSteps = 2;
    both->solvers.push_back(spriteEmitter(5.0f, {1.0f, 1.0f}));
    both->solvers.push_back(spriteEmitter(30.0f, {0.2f, 2.0f}));
    effects.push_back(std::move(both));
    return effects;
}

sim::InstanceStart startOf(uint32_t i)
{
    sim::InstanceStart start;
    start.instance = i + 1;
    start.seed = 1000 + i;
    start.startTick = base::Ticks(i % 5) * kStep * 3 / 2;
    start.placement.position = {double(i), 0.0, 0.0};
    start.parameters.intensity = i % 7 == 3 ? 2.0f : 1.0f;
    return start;
}

/// What all see together: a hash of each frame's groups in their order.
struct Seen
{
    std::vector<uint64_t> frames;
    uint64_t state = 0;
    uint64_t born = 0, dropped = 0, steps = 0;

    bool operator==(const Seen&) const = default;
};

uint64_t hashOf(const base::SnapshotGroup& group, const base::SnapshotSchema& schema)
{
    uint64_t h = base::hashWord(group.info().instance, group.info().solver);
    h = base::hashBytes(h, group.constants().data(), group.constants().size_bytes());
    h = base::hashBytes(h, &group.info().bounds, sizeof(base::Bounds));
    const auto columns = schema.kind(group.info().kind).columns;
    for (size_t c = 0; c < columns.size(); ++c)
        h = base::hashBytes(h, group.column(c).data(),
                            group.column(c).size() * base::columnElementSize(columns[c].type));
    return h;
}

void see(Stage& stage, Seen& seen, std::vector<uint64_t>& outGroups)
{
    const base::FrameSnapshot& snapshot = stage.look();
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        outGroups.push_back(hashOf(snapshot.group(g), snapshot.schema()));
    seen.born += stage.counters().born;
    seen.dropped += stage.counters().dropped;
    seen.steps += stage.counters().particleSteps;
}

/// Changes that end what has been foreseen.
void disturb(Stage& stage, sim::Slot slot, uint32_t i, int step)
{
    sim::InstanceParameters parameters = startOf(i).parameters;
    if (step == 60 && i % 6 == 1)
        parameters.intensity = 3.0f;
    else if (step == 75 && i % 6 == 2)
        parameters.emitting = false;
    else if (step == 90 && i % 6 == 4)
        parameters.wind = {3.0f, 0.0f, 0.0f};
    else
        return;
    stage.world().setParameters(slot, parameters);
}

/// All in one world, or each in a world of its own.
Seen play(bool together, bool mayPass, std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner())
{
    const auto effects = smallEffects();
    const uint32_t count = uint32_t(effects.size()) * kEach;
    std::vector<std::unique_ptr<Stage>> stages;
    std::vector<std::pair<Stage*, sim::Slot>> slots;
    for (uint32_t i = 0; i < count; ++i) {
        if (stages.empty() || !together) {
            stages.push_back(
                std::make_unique<Stage>(stages.empty() ? std::move(tasks) : base::makeSerialRunner()));
            stages.back()->world().allowRest(mayPass);
        }
        slots.emplace_back(stages.back().get(), stages.back()->add(startOf(i), effects[i % effects.size()]));
    }
    Seen seen;
    for (int step = 0; step < 150; ++step) {
        std::vector<uint64_t> groups;
        for (uint32_t i = 0; i < count; ++i)
            disturb(*slots[i].first, slots[i].second, i, step);
        for (const auto& stage : stages) {
            stage->step(step % 11 == 5 ? kStep / 3 : kStep);
            if (step == 149)
                see(*stage, seen, groups);
            else if (step % 10 == 9) {
                Seen ignored;
                see(*stage, ignored, groups);
            }
        }
        seen.frames.push_back(base::hashBytes(0, groups.data(), groups.size() * sizeof(uint64_t)));
    }
    for (const auto& [stage, slot] : slots)
        seen.state = base::hashWord(seen.state, stage->world().hash(std::array{slot}));
    return seen;
}

} // namespace

TEST(SpawnBatch, manySmallEmittersComeOutAsEachByItself)
{
    const Seen alone = play(false, true);
    EXPECT_GT(alone.dropped, 0u);
    EXPECT_EQ(play(true, true), alone);
}

TEST(SpawnBatch, whatItDoesIsWhatASolverDoesWithoutIt)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    schema.add(base::kParticleKind);
    const auto tasks = base::makeSerialRunner();
    for (const std::shared_ptr<const sim::EffectDef>& effect : smallEffects()) {
        if (effect->solvers.size() > 1)
            continue; // in steps of their own
        Stage stage;
        sim::InstanceStart start;
        start.instance = 5;
        start.seed = 77;
        stage.add(start, effect);
        base::HostMemory memory;
        base::Arena scratch(&memory);
        const auto solver = effect->solvers[0]->create(schema, sim::qualityOf(start.quality), &memory);
        sim::StepCounters counters;
        for (int i = 0; i < 200; ++i) {
            sim::StepContext context{};
            context.tick = i * kStep;
            context.stepTicks = kStep;
            context.seed = 77;
            context.gravity = sim::Environment{}.gravity;
            context.parameters = &start.parameters;
            context.tasks = tasks.get();
            context.scratch = &scratch;
            context.counters = &counters;
            solver->step(context);
            scratch.reset();
        }
        stage.play(200);
        base::FrameSnapshot snapshot(&schema, &memory);
        snapshot.begin(200 * kStep, 1);
        base::GroupInfo info;
        info.instance = 5;
        solver->publish(info, snapshot);
        const base::FrameSnapshot& seen = stage.look();
        EXPECT_EQ(hashOf(seen.group(0), schema), hashOf(snapshot.group(0), schema));
        EXPECT_EQ(stage.counters().born, counters.born);
        EXPECT_EQ(stage.counters().dropped, counters.dropped);
        EXPECT_EQ(stage.counters().particleSteps, counters.particleSteps);
    }
}

TEST(SpawnBatch, stepsThatAreNotTakenLeaveNoTrace)
{
    EXPECT_EQ(play(true, true), play(true, false));
}

TEST(SpawnBatch, everyNumberOfWorkersGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(7);
    const Seen want = play(true, true);
    for (const uint32_t threads : {2u, 7u})
        EXPECT_EQ(play(true, true, base::makeTbbRunner(threads)), want) << threads;
}

TEST(SpawnBatch, scatteredBirthsAreThoseOfEachEmitter)
{
    const auto def = spriteEmitter(10.0f, {0.5f, 3.0f});
    def->maxParticles = 12;
    base::HostMemory memory;
    const sim::ParticleProgram program(*def);
    std::vector<std::unique_ptr<sim::ParticleStore>> alone, together;
    std::vector<sim::ScatteredBirth> scattered;
    for (uint64_t s = 0; s < 50; ++s) {
        alone.push_back(std::make_unique<sim::ParticleStore>(program, &memory));
        together.push_back(std::make_unique<sim::ParticleStore>(program, &memory));
        std::vector<sim::Birth> births;
        for (uint64_t i = 0; i < s % 13; ++i)
            births.push_back({s * 3 + i, base::Ticks(1000 * i)});
        const uint32_t stored =
            births.empty() ? 0 : sim::storeBirths(program, {~s, 3}, births, *alone.back());
        EXPECT_EQ(stored, births.size());
        for (const sim::Birth& birth : births)
            scattered.push_back(
                {together.back().get(), ~s, birth, together.back()->rowOf(birth.index), false});
    }
    sim::storeScattered(program, 3, scattered);
    for (const sim::ScatteredBirth& birth : scattered)
        EXPECT_TRUE(birth.isStored);
    for (size_t s = 0; s < alone.size(); ++s)
        for (uint32_t row = 0; row < 12; ++row) {
            ASSERT_EQ(alone[s]->index[row], together[s]->index[row]);
            ASSERT_EQ(alone[s]->born[row], together[s]->born[row]);
            for (size_t c = 0; c < sim::stored::Count; ++c)
                ASSERT_EQ(alone[s]->value(c, row), together[s]->value(c, row)) << s << ' ' << c;
        }
}
