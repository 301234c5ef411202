#include "tests/simulation/particles/events/linked.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

/// Ballistic and integrated emitters, events and trails.
std::shared_ptr<EffectDef> mixed(bool withEvents)
{
    auto rocket = spriteEmitter(30.0f, {0.3f, 0.9f});
    rocket->maxParticles = 64;
    auto leaf = spriteEmitter(20.0f, {0.5f, 1.0f});
    leaf->maxParticles = 64;
    if (!withEvents)
        return linkedEffect(std::move(rocket));
    rocket->events = {ruleOf(EventKind::Death, 1, 3)};
    rocket->trail.lifetime = 0.3f;
    rocket->trail.maxPoints = 8;
    leaf->modules = {std::make_shared<Idle>()};
    auto piece = fedEmitter(0.4f);
    piece->speed = {1, 2};
    piece->maxParticles = 128;
    return linkedEffect(std::move(rocket), std::move(piece), std::move(leaf));
}

/// The hash of the state after each number of steps.
std::vector<uint64_t> playedHashes(const std::shared_ptr<EffectDef>& effect, int steps)
{
    Stage stage;
    const Slot slot = stage.add({}, effect);
    std::vector<uint64_t> hashes{0};
    for (int i = 0; i < steps; ++i) {
        stage.step();
        hashes.push_back(stage.world().hash(std::array{slot}));
    }
    return hashes;
}

} // namespace

TEST(InstanceTime, aThousandRandomSeeksEqualPlaying)
{
    constexpr int kSteps = 120;
    for (const bool withEvents : {false, true}) {
        const auto effect = mixed(withEvents);
        const auto want = playedHashes(effect, kSteps);
        Stage stage;
        const Slot slot = stage.add({}, effect);
        stage.step();
        uint32_t random = 12345;
        StepCounters counters;
        for (int i = 0; i < 500; ++i) {
            random = random * 1664525u + 1013904223u;
            const uint32_t step = 1 + (random >> 16) % kSteps;
            stage.world().seekTo(slot, base::Ticks(step) * kStep, kStep, counters);
            ASSERT_EQ(stage.world().hash(std::array{slot}), want[step]) << step << " after " << i;
        }
    }
}

TEST(InstanceTime, afterASeekPlayingGoesOnAsIfItHadBeenPlayed)
{
    const auto effect = mixed(true);
    const auto want = playedHashes(effect, 100);
    Stage stage;
    const Slot slot = stage.add({}, effect);
    stage.play(90);
    StepCounters counters;
    stage.world().seekTo(slot, 20 * kStep, kStep, counters);
    stage.play(30);
    EXPECT_EQ(stage.world().hash(std::array{slot}), want[50]);
    EXPECT_EQ(stage.world().localTime(slot), 50 * kStep);
}

TEST(InstanceTime, prewarmIsHavingRunForThatTime)
{
    for (const bool withEvents : {false, true}) {
        const auto want = playedHashes(mixed(withEvents), 100);
        auto effect = mixed(withEvents);
        effect->prewarm = 60 * kStep;
        Stage stage;
        const Slot slot = stage.add({}, effect);
        stage.play(40);
        EXPECT_EQ(stage.world().hash(std::array{slot}), want[100]);
    }
}

TEST(InstanceTime, twiceTheSpeedTakesTheSameSteps)
{
    const auto effect = mixed(true);
    const auto want = playedHashes(effect, 100);
    Stage stage;
    InstanceStart start;
    start.rate = 2 * kNormalRate;
    const Slot slot = stage.add(start, effect);
    stage.play(30);
    EXPECT_EQ(stage.world().hash(std::array{slot}), want[60]);
    stage.world().setRate(slot, 0);
    stage.play(30);
    EXPECT_EQ(stage.world().hash(std::array{slot}), want[60]);
    stage.world().setRate(slot, kNormalRate);
    stage.play(40);
    EXPECT_EQ(stage.world().hash(std::array{slot}), want[100]);
}

TEST(InstanceTime, aSpeedOfAThirdReachesAClosedFormExactlyAtItsOwnTicks)
{
    const InstanceClock clock{5, 7, kNormalRate / 3};
    for (base::Ticks tick = 5; tick < 400; ++tick) {
        EXPECT_EQ(clock.toLocal(tick), 7 + (tick - 5) * (kNormalRate / 3) / kNormalRate);
        EXPECT_LE(clock.toLocal(clock.toScene(clock.toLocal(tick))), clock.toLocal(tick));
        EXPECT_GT(clock.toLocal(clock.toScene(clock.toLocal(tick)) + 1), clock.toLocal(tick));
    }
}

TEST(InstanceTime, oneOfTwoThatShareIsTakenElsewhereAlone)
{
    const auto effect = mixed(true);
    const auto want = playedHashes(effect, 60);
    Stage stage;
    const Slot a = stage.add({}, effect);
    InstanceStart second;
    second.instance = 2;
    const Slot b = stage.add(second, effect);
    stage.play(30);
    EXPECT_EQ(stage.world().simulations(), 1u);
    StepCounters counters;
    stage.world().seekTo(b, 10 * kStep, kStep, counters);
    EXPECT_EQ(stage.world().simulations(), 2u);
    stage.play(30);
    EXPECT_EQ(stage.world().hash(std::array{a}), want[60]);
    EXPECT_EQ(stage.world().hash(std::array{b}), want[40]);
}

TEST(InstanceTime, whatTheHostSaysIsHeardWithTheNextStep)
{
    auto parent = burstEmitter(1);
    parent->position = {0, 2, 0};
    parent->events = {ruleOf(EventKind::Host, 1, 4)};
    auto effect = linkedEffect(std::move(parent), fedEmitter());
    effect->hostEvents = {"hit"};
    Stage stage;
    const Slot slot = stage.add({}, effect);
    stage.play(10);
    EXPECT_TRUE(particlesOf(stage.look(), 1).empty());
    stage.world().postEvent(slot, {0, 3});
    StateBuffer before(&stage.memory());
    stage.world().save(std::array{slot}, before); // what is not heard yet is part of the state
    stage.step();
    const auto seen = particlesOf(stage.look(), 1);
    ASSERT_EQ(seen.size(), 12u);
    EXPECT_NEAR(seen[0].age, 1.0 / 60.0, 1e-6);
    EXPECT_EQ(seen[0].position, glm::vec3(0, 2, 0));
    stage.step();
    EXPECT_EQ(particlesOf(stage.look(), 1).size(), 12u);
}
