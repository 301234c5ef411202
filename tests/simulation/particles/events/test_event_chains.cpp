#include "tests/foundation/real_threads.h"
#include "tests/simulation/particles/events/linked.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

/// Rockets that leave a tail at two ages and burst; the pieces of the burst crackle when they die.
std::shared_ptr<EffectDef> fireworks(bool integrated)
{
    auto rocket = spriteEmitter(40.0f, {0.4f, 0.8f});
    rocket->events = {ruleOf(EventKind::Age, 1, 2), ruleOf(EventKind::Death, 1, 6)};
    rocket->events[0].age = kTicksPerSecond / 7;
    rocket->events[0].inheritVelocity = 0.25f;
    rocket->events[1].fewest = 2;
    auto piece = fedEmitter(0.3f);
    piece->speed = {1, 4};
    piece->forces.gravity = 1;
    piece->forces.drag = 0.5f;
    piece->emission.rate = 10; // also by itself
    piece->emission.duration = 1e6f;
    piece->events = {ruleOf(EventKind::Death, 2, 3), ruleOf(EventKind::Birth, 2)};
    piece->events[0].probability = 0.5f;
    auto crackle = fedEmitter(0.2f);
    crackle->speed = {0, 2};
    crackle->maxParticles = 4096;
    if (integrated) {
        rocket->modules = {std::make_shared<Idle>()};
        piece->modules = {std::make_shared<Idle>()};
    }
    return linkedEffect(std::move(rocket), std::move(piece), std::move(crackle));
}

uint64_t history(const std::shared_ptr<EffectDef>& effect, std::unique_ptr<base::TaskRunner> tasks)
{
    Stage stage(std::move(tasks));
    InstanceStart start;
    start.seed = 3;
    stage.add(start, effect);
    uint64_t hash = 0;
    for (int i = 0; i < 150; ++i) {
        stage.step();
        hash = base::hashWord(hash, stage.look().hash());
    }
    return hash;
}

} // namespace

TEST(EventChains, doNotDependOnHowTimeIsCut)
{
    const auto effect = fireworks(false);
    const auto playedBy = [&effect](std::initializer_list<base::Ticks> parts) {
        Stage stage;
        stage.add({}, effect);
        for (size_t i = 0; stage.now() < 2 * kTicksPerSecond; ++i) {
            const base::Ticks part = *(parts.begin() + ptrdiff_t(i % parts.size()));
            stage.step(std::min(part, 2 * kTicksPerSecond - stage.now()));
        }
        EXPECT_GT(particlesOf(stage.look(), 2).size(), 50u);
        return stage.look().hash();
    };
    const base::Ticks s = kTicksPerSecond;
    const uint64_t want = playedBy({s / 60});
    EXPECT_EQ(playedBy({s / 30}), want);
    EXPECT_EQ(playedBy({s / 144}), want);
    EXPECT_EQ(playedBy({s / 7 + 5, s / 1000, s / 90, s / 3}), want); // a chain of three within one step
}

TEST(EventChains, everyNumberOfWorkersGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(7);
    for (const bool integrated : {false, true}) {
        const auto effect = fireworks(integrated);
        const uint64_t want = history(effect, base::makeSerialRunner());
        for (const uint32_t threads : {2u, 3u, 7u})
            EXPECT_EQ(history(effect, base::makeTbbRunner(threads)), want) << threads;
    }
}

TEST(EventChains, integratedMotionHasTheSameBirthsForAnyStep)
{
    const auto effect = fireworks(true);
    const auto born = [&effect](base::Ticks part) {
        Stage stage;
        stage.add({}, effect);
        while (stage.now() < kTicksPerSecond * 2)
            stage.step(part);
        return stage.counters().born;
    };
    const uint64_t want = born(kTicksPerSecond / 60);
    EXPECT_EQ(born(kTicksPerSecond / 30), want);
    EXPECT_EQ(born(kTicksPerSecond / 144), want);
}

TEST(EventChains, aRestoredStateGoesOnWithTheSameBits)
{
    const auto effect = fireworks(true);
    Stage stage;
    const Slot slot = stage.add({}, effect);
    stage.play(40);
    StateBuffer state(&stage.memory());
    stage.world().save(std::array{slot}, state);
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    schema.add(base::kParticleKind);
    const auto tasks = base::makeSerialRunner();
    World other(&schema, tasks.get(), &stage.memory());
    StateReader reader(state.bytes());
    Slot copy = 0;
    other.restore(std::array{World::Entry{effect, {}}}, reader, std::span(&copy, 1));
    ASSERT_TRUE(reader.ok());
    for (int i = 0; i < 60; ++i) {
        other.step(std::array{copy}, stage.now(), kStep);
        stage.step();
    }
    EXPECT_EQ(other.hash(std::array{copy}), stage.world().hash(std::array{slot}));
}

TEST(EventChains, allocateNothingOnceTheyAreWarm)
{
    Stage stage;
    stage.add({}, fireworks(true));
    stage.play(120);
    const uint64_t before = stage.memory().allocationCount();
    stage.play(120);
    EXPECT_EQ(stage.memory().allocationCount(), before);
}
