// Emitters out of sight and at rest: what their own preset does not say is chosen for them, and leaves no
// trace.
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using scene::InstanceState;
using scene::Reason;
using sim::CatchUp;

namespace {

std::unique_ptr<sim::EmitterDef> emitterOf(std::vector<sim::Burst> bursts, float rate = 0)
{
    auto emitter = std::make_unique<sim::EmitterDef>();
    emitter->maxParticles = 64;
    emitter->emission.rate = rate;
    emitter->emission.bursts = std::move(bursts);
    emitter->emission.duration = std::numeric_limits<float>::infinity();
    emitter->lifetime = {0.3f, 0.4f};
    emitter->speed = {1.0f, 2.0f};
    emitter->radius = {0.1f, 0.1f};
    return emitter;
}

Effect effectOf(std::unique_ptr<sim::EmitterDef> emitter)
{
    Effect effect = emptyEffect();
    effect->solvers.push_back(std::move(emitter));
    return effect;
}

Effect turbulentFountain()
{
    auto emitter = emitterOf({}, 60);
    emitter->forces.curlStrength = 0.5f;
    return effectOf(std::move(emitter));
}

/// A rocket a second and a half whose end gives birth to stars.
Effect rockets()
{
    Effect effect = emptyEffect();
    auto rocket = emitterOf({{0.0f, 1, 0, 1.5f}});
    rocket->lifetime = {0.2f, 0.2f};
    sim::EventRule rule;
    rule.target = 1;
    rule.fewest = rule.most = 8;
    rocket->events.push_back(rule);
    auto stars = emitterOf({});
    stars->fed = true;
    stars->emission.duration = 0;
    effect->solvers.push_back(std::move(rocket));
    effect->solvers.push_back(std::move(stars));
    effect->order = {0, 1};
    return effect;
}

struct Outcome
{
    bool isEqual;                 ///< to a scene that hides nothing
    uint64_t stepsOfReturn;       ///< particle steps taken on return
    uint64_t stepsOfTheOther = 0; ///< that the scene that hides nothing took altogether
};

/// Out of sight for 400 steps and back.
Outcome hideAndReturn(const Effect& effect)
{
    SightStage stage, always(neverCulled());
    stage.add(effect, kAhead);
    always.add(effect, kAhead);
    stage.play(50);
    stage.look(kBehind);
    stage.play(400);
    stage.look(0);
    const uint64_t before = stage.scene().counters().work.particleSteps;
    stage.play(1);
    always.play(451);
    const uint64_t ofLastStep = stage.scene().lastUpdate().work.particleSteps;
    const uint64_t took = stage.scene().counters().work.particleSteps - before - ofLastStep;
    EXPECT_EQ(took, stage.scene().lastUpdate().catchUpParticleSteps);
    return {stage.scene().simulationHash() == always.scene().simulationHash() &&
                stage.scene().stateHash() == always.scene().stateHash(),
            took, always.scene().counters().work.particleSteps};
}

} // namespace

TEST(EmitterSight, byDefaultWhatHasAClosedFormIsAnalyticAndEverythingElseReplayed)
{
    EXPECT_EQ(fountainEffect()->catchUp(), CatchUp::Analytic);
    EXPECT_EQ(effectOf(emitterOf({{0.0f, 5}}))->catchUp(), CatchUp::Analytic);
    EXPECT_EQ(turbulentFountain()->catchUp(), CatchUp::Replay);
    EXPECT_EQ(rockets()->catchUp(), CatchUp::Replay);
    auto trailed = emitterOf({}, 60);
    trailed->trail.lifetime = 1;
    EXPECT_EQ(trailed->catchUp(), CatchUp::Replay);
    auto bouncing = emitterOf({}, 60);
    bouncing->forces.bounce = 0.5f;
    EXPECT_EQ(bouncing->catchUp(), CatchUp::Replay);
    Effect both = fountainEffect(); // one that cannot jump holds up the other
    both->solvers.push_back(emitterOf({}, 60));
    EXPECT_EQ(both->catchUp(), CatchUp::Analytic);
    auto gusty = emitterOf({}, 60);
    gusty->forces.curlStrength = 1;
    both->solvers.push_back(std::move(gusty));
    EXPECT_EQ(both->catchUp(), CatchUp::Replay);
}

TEST(EmitterSight, aBallisticEmitterReturnsAsIfNeverHiddenWithoutASingleStepOfReplay)
{
    auto crowded = emitterOf({{0.1f, 50, 0, 0.15f}}, 200); // the ring is full: births are dropped
    for (const Effect& effect : {fountainEffect(), effectOf(std::move(crowded))}) {
        const Outcome outcome = hideAndReturn(effect);
        EXPECT_TRUE(outcome.isEqual);
        EXPECT_EQ(outcome.stepsOfReturn, 0u);
        EXPECT_GT(outcome.stepsOfTheOther, 400u * 20u); // what was not simulated
    }
}

TEST(EmitterSight,
     aTurbulentEmitterReturnsAsIfNeverHiddenByTakingTheStepsOfALifetime) // and the counter counts
{
    const Outcome outcome = hideAndReturn(turbulentFountain());
    EXPECT_TRUE(outcome.isEqual);
    EXPECT_GT(outcome.stepsOfReturn, 90u * 10u);
    EXPECT_LT(outcome.stepsOfReturn, 92u * 31u); // 1.5 s of the 400 steps, 30 particles at once
}

TEST(EmitterSight, timeThatIsLeftOutIsSeenByTheHash) // the control of the hash
{
    Effect effect = fountainEffect();
    effect->offscreen = CatchUp::Skip;
    EXPECT_FALSE(hideAndReturn(effect).isEqual);
}

TEST(EmitterSight, betweenTwoBurstsAnEmitterRestsAndComesOutTheSame)
{
    auto late = emitterOf({{0.0f, 5}}, 30);
    late->emission.start = 0.8f;
    late->emission.duration = 0.5f;
    auto turbulent = emitterOf({{0.0f, 5, 0, 2.0f}});
    turbulent->forces.curlStrength = 1;
    auto trailed = emitterOf({{0.0f, 5, 0, 2.0f}});
    trailed->trail.lifetime = 0.25f;
    std::vector<Effect> effects{effectOf(emitterOf({{0.0f, 5, 0, 2.0f}})), effectOf(std::move(late)),
                                effectOf(std::move(turbulent)), effectOf(std::move(trailed)), rockets()};
    for (const Effect& effect : effects) {
        SightStage stage, always(neverCulled());
        const auto id = stage.add(effect, kAhead);
        always.add(effect, kAhead);
        int resting = 0, active = 0;
        for (int i = 0; i < 500; ++i) {
            stage.play(1);
            always.play(1);
            const InstanceState state = stage.state(id);
            resting += state == InstanceState::Resting;
            active += state == InstanceState::Active;
            ASSERT_EQ(stage.scene().lastUpdate().catchUpParticleSteps, 0u);
            if (i % 7 == 0) {
                ASSERT_EQ(stage.scene().simulationHash(), always.scene().simulationHash()) << i;
            }
        }
        EXPECT_GT(resting, 40) << &effect - effects.data();
        EXPECT_GT(active, 20) << &effect - effects.data();
        EXPECT_EQ(stage.scene().counters().work.born, always.scene().counters().work.born);
    }
}

TEST(EmitterSight, whatIsBornAllTheTimeNeverRests) // the control of the test above
{
    SightStage stage;
    const auto id = stage.add(effectOf(emitterOf({}, 30)), kAhead);
    for (int i = 0; i < 300; ++i) {
        stage.play(1);
        ASSERT_EQ(stage.state(id), InstanceState::Active);
    }
}

TEST(EmitterSight, whatTheHostChangesEndsARest)
{
    SightStage stage, always(neverCulled());
    const Effect effect = effectOf(emitterOf({{0.0f, 5, 0, 10.0f}}, 0.1f));
    const auto id = stage.add(effect, kAhead);
    always.add(effect, kAhead);
    stage.play(100);
    ASSERT_EQ(stage.state(id), InstanceState::Resting);
    stage.scene().setParameters(id, {600.0f});
    stage.play(20);
    EXPECT_GT(stage.scene().particles(id), 3u);
    always.play(100);
    always.scene().setParameters(id, {600.0f});
    always.play(20);
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
    EXPECT_EQ(stage.scene().stateHash(), always.scene().stateHash());
}

TEST(EmitterSight, whatRestsAndIsMovedAllTheTimeIsToldBeforeTooMuchWaits)
{
    SightStage stage, always(neverCulled());
    auto emitter = emitterOf({{0.0f, 5, 0, 1000.0f}});
    emitter->inWorld = true; // what it is told is told to its particles
    emitter->emission.bursts[0].time = 10;
    const Effect effect = effectOf(std::move(emitter));
    const auto id = stage.add(effect, kAhead), other = always.add(effect, kAhead);
    int rested = 0, returned = 0;
    base::Placement placement;
    placement.position = kAhead;
    for (int i = 0; i < 300; ++i) {
        stage.play(1);
        always.play(1);
        const bool rests = stage.state(id) == InstanceState::Resting;
        placement.position.x = 0.01 * i;
        stage.scene().setPlacement(id, placement);
        always.scene().setPlacement(other, placement);
        rested += rests;
        returned += rests && stage.state(id) != InstanceState::Resting;
    }
    EXPECT_GT(rested, 200);
    EXPECT_GE(returned, 3); // after 64 moves each
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
}

TEST(EmitterSight, anEmitterThatHearsTheHostDoesNotRest)
{
    Effect effect = rockets();
    effect->hostEvents = {"now"};
    sim::EventRule rule;
    rule.on = sim::EventKind::Host;
    rule.target = 1;
    auto listening = emitterOf({});
    listening->events.push_back(rule);
    effect->solvers[0] = std::move(listening);
    SightStage stage;
    const auto id = stage.add(effect, kAhead);
    stage.play(60);
    ASSERT_EQ(stage.state(id), InstanceState::Active);
    ASSERT_TRUE(stage.scene().postEvent(id, "now", 3).ok());
    stage.play(1);
    EXPECT_EQ(stage.scene().particles(id), 3u);
}

TEST(EmitterSight, whatComesBackIsInBothSnapshotsThatViewsInterpolateBetween)
{
    for (const Effect& effect : {fountainEffect(), turbulentFountain()}) {
        SightStage stage, always(neverCulled());
        stage.add(effect, kAhead);
        always.add(effect, kAhead);
        stage.play(20);
        stage.look(kBehind);
        stage.play(30);
        stage.look(0);
        stage.play(1);
        always.play(51);
        const scene::Presentation shown = stage.scene().acquire(), other = always.scene().acquire();
        EXPECT_EQ(shown.snapshots.newer->tick(), 51 * kStep);
        EXPECT_EQ(shown.snapshots.newer->hash(), other.snapshots.newer->hash());
        EXPECT_EQ(shown.snapshots.older->tick(), 50 * kStep);
        EXPECT_EQ(shown.snapshots.older->hash(), other.snapshots.older->hash());
        EXPECT_GT(shown.snapshots.older->group(0).count(), 5u);
        stage.scene().release(shown.snapshots);
        always.scene().release(other.snapshots);
    }
}
