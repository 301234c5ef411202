// What comes back into sight is what it would have been.
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using scene::InstanceState;
using scene::Reason;
using sim::CatchUp;

namespace {

/// Two scenes with the same calls; only one of them uses its cameras.
class VisibilityScript
{
public:
    VisibilityScript(uint64_t seed, const scene::SceneOptions& options)
        : random_(seed), culled_(options), always_(neverCulled())
    {}

    void add(const Effect& effect)
    {
        const glm::dvec3 at{30 * std::sin(double(ids_.size())), 0, 30 * std::cos(double(ids_.size()))};
        const base::Ticks start = base::Ticks(next(40)) * kStep + 11;
        ids_.push_back(culled_.add(effect, at, ids_.size() / 2, start)); // some share
        always_.add(effect, at, (ids_.size() - 1) / 2, start);
    }

    /// Something happens, then time passes.
    void act()
    {
        const scene::LocalId id = ids_[next(ids_.size())];
        switch (next(6)) {
        case 0:
            culled_.scene().setHints(id, {1, 0, next(2) == 0});
            break;
        case 1:
            both([&, intensity = float(next(5))](scene::Scene& s) { s.setParameters(id, {intensity}); });
            break;
        case 2: {
            base::Placement placement;
            placement.position = {double(next(60)) - 30, 0, double(next(60)) - 30};
            placement.rotation = glm::angleAxis(float(next(7)), glm::vec3(1, 0, 0));
            both([&](scene::Scene& s) { s.setPlacement(id, placement); });
            break;
        }
        default:
            culled_.look(0.01 * double(next(628)));
        }
        const int steps = int(next(25));
        culled_.play(steps);
        always_.play(steps);
    }
    /// Steps until everything that can be seen is at the present.
    void lookEverywhere()
    {
        for (const scene::LocalId id : ids_)
            culled_.scene().setHints(id, {});
        culled_.lookThrough({});
        for (int i = 0; i < 2000 && (i == 0 || culled_.scene().counters().waking > 0); ++i) {
            culled_.play(1);
            always_.play(1);
        }
        EXPECT_EQ(culled_.scene().counters().hidden + culled_.scene().counters().waking, 0u);
    }
    bool areEqual() { return culled_.scene().simulationHash() == always_.scene().simulationHash(); }
    bool lookEqual() { return culled_.scene().stateHash() == always_.scene().stateHash(); }
    scene::Scene& culled() { return culled_.scene(); }
    scene::Scene& always() { return always_.scene(); }

private:
    uint64_t next(uint64_t below) { return (random_ = base::hashWord(random_, 1)) % below; }
    template <class F>
    void both(F&& f)
    {
        f(culled_.scene());
        f(always_.scene());
    }

    uint64_t random_;
    SightStage culled_, always_;
    std::vector<scene::LocalId> ids_;
};

Effect withPolicy(Effect effect, CatchUp policy)
{
    effect->offscreen = policy;
    return effect;
}

scene::SceneOptions shortBudget()
{
    scene::SceneOptions options;
    options.catchUpSteps = 300;
    options.releaseAfter = 15 * kStep;
    options.maxCatchUp = 3600 * base::kTicksPerSecond;
    return options;
}

} // namespace

TEST(CatchUp, twoHundredRandomScriptsLeaveNoTraceInAnalyticReplayedAndAuthoritativeEffects)
{
    uint64_t hidden = 0, replayed = 0;
    const Effect jumping = toyEffect({true}), chained = toyEffect({false}), fountain = fountainEffect(),
                 curling = fountainEffect(true);
    const Effect kept = withPolicy(toyEffect({false, 3}), CatchUp::Authoritative);
    const Effect wished = withPolicy(toyEffect({false, 2}), CatchUp::Analytic); // cannot: it is replayed
    for (uint64_t seed = 0; seed < 200; ++seed) {
        VisibilityScript script(seed, shortBudget());
        for (int i = 0; i < 2; ++i)
            for (const Effect& effect : {jumping, jumping, chained, chained, fountain, curling, kept, wished})
                script.add(effect);
        for (int k = 0; k < 14; ++k) {
            script.act();
            hidden += script.culled().counters().hidden;
            if (seed % 4 == 0) { // half of the time while some are out of sight
                ASSERT_TRUE(script.areEqual()) << "seed " << seed << ", act " << k;
            }
        }
        script.lookEverywhere();
        ASSERT_TRUE(script.areEqual()) << "seed " << seed;
        ASSERT_TRUE(script.lookEqual()) << "seed " << seed;
        replayed += script.culled().counters().work.particleSteps;
        ASSERT_EQ(script.culled().counters().catchUpsSkipped, 0u);
    }
    EXPECT_GT(hidden, 200u * 14u); // more than one of them at any time
    EXPECT_GT(replayed, 0u);
}

TEST(CatchUp, skippedTimeIsSeenByTheHash) // the control of the test above
{
    int different = 0;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        VisibilityScript script(seed, shortBudget());
        for (int i = 0; i < 6; ++i)
            script.add(withPolicy(toyEffect({false}), CatchUp::Skip));
        for (int k = 0; k < 14; ++k)
            script.act();
        script.lookEverywhere();
        different += script.areEqual() ? 0 : 1;
    }
    EXPECT_GE(different, 18);
}

TEST(CatchUp, aHiddenAnalyticEffectIsNotSimulatedAndReturnsInOneUpdate)
{
    SightStage stage, always(neverCulled());
    const Effect effect = toyEffect({true});
    const auto id = stage.add(effect, kAhead);
    always.add(effect, kAhead);
    stage.play(5);
    stage.look(kBehind);
    stage.play(1);
    const uint64_t before = stage.scene().counters().work.particleSteps;
    stage.play(1000);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, before);
    EXPECT_EQ(stage.scene().activity(id).lag, 1001 * kStep);
    stage.look(0);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
    EXPECT_EQ(stage.scene().lastUpdate().catchUpParticleSteps, 0u);
    EXPECT_EQ(stage.scene().lastUpdate().catchUpTicks, 1001 * kStep);
    always.play(1007);
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
}

TEST(CatchUp, aReplayNeverTakesMoreThanItsBudgetAndAStep)
{
    scene::SceneOptions options;
    options.catchUpSteps = 100;
    SightStage stage(options), always(neverCulled());
    std::vector<scene::LocalId> ids;
    for (uint64_t i = 0; i < 4; ++i) {
        const Effect effect = toyEffect({false, 9});
        ids.push_back(stage.add(effect, kAhead, i));
        always.add(effect, kAhead, i);
    }
    stage.look(kBehind);
    stage.play(200);
    stage.look(0);
    int updates = 0;
    for (; updates < 1000 && stage.scene().counters().active < 4; ++updates) {
        stage.play(1);
        ASSERT_LE(stage.scene().lastUpdate().catchUpParticleSteps, 100u + 9u);
    }
    EXPECT_GE(updates, 4 * 200 * 10 / 100); // 4 effects, 200 steps, 9 particles and one
    EXPECT_LE(updates, 110);
    always.play(200 + updates);
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
}

TEST(CatchUp, whileItReplaysTheEffectIsWakingAndNotShown)
{
    scene::SceneOptions options;
    options.catchUpSteps = 10;
    SightStage stage(options);
    const auto id = stage.add(toyEffect({false}), kAhead);
    stage.look(kBehind);
    stage.play(50);
    stage.look(0);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Waking);
    EXPECT_EQ(stage.reason(id), Reason::CatchingUp);
    stage.look(kBehind); // and away again
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Hidden);
}

TEST(CatchUp, anAbsenceThatIsTooLongIsLeftOutAndCountedButNeverInLockStep)
{
    scene::SceneOptions options;
    options.maxCatchUp = 30 * kStep;
    scene::SceneOptions lockStep = options;
    lockStep.lockStep = true;
    SightStage stage(options), strict(lockStep), always(neverCulled());
    const Effect effect = toyEffect({false});
    for (SightStage* each : {&stage, &strict, &always}) {
        each->add(effect, kAhead);
        each->play(2);
        each->look(kBehind);
        each->play(100);
        each->look(0);
        each->play(2);
    }
    EXPECT_EQ(stage.scene().counters().catchUpsSkipped, 1u);
    EXPECT_EQ(strict.scene().counters().catchUpsSkipped, 0u);
    EXPECT_NE(stage.scene().simulationHash(), always.scene().simulationHash());
    EXPECT_EQ(strict.scene().simulationHash(), always.scene().simulationHash());
}

TEST(CatchUp, inLockStepWhatCannotBeCaughtUpExactlyIsAlwaysSimulated)
{
    scene::SceneOptions options;
    options.lockStep = true;
    SightStage stage(options);
    const auto skipped = stage.add(withPolicy(toyEffect({false}), CatchUp::Skip), kAhead);
    const auto coarse = stage.add(withPolicy(toyEffect({false}), CatchUp::Coarse), kAhead);
    const auto exact = stage.add(toyEffect({false}), kAhead);
    stage.look(kBehind);
    stage.play(3);
    EXPECT_EQ(stage.state(skipped), InstanceState::Active);
    EXPECT_EQ(stage.state(coarse), InstanceState::Active);
    EXPECT_EQ(stage.state(exact), InstanceState::Hidden);
}

TEST(CatchUp, coarseEffectsTakeAQuarterOfTheStepsOnTheScheduleOfTicks)
{
    SightStage stage;
    const Effect effect = withPolicy(toyEffect({true}), CatchUp::Coarse);
    const auto id = stage.add(effect, kAhead);
    stage.look(kBehind);
    stage.play(41);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, 4u * 10u);
    EXPECT_EQ(stage.scene().activity(id).lag, kStep);
    SightStage always(neverCulled());
    always.add(effect, kAhead);
    always.play(42);
    stage.look(0);
    stage.play(1);
    EXPECT_EQ(stage.scene().simulationHash(),
              always.scene().simulationHash()); // a sum over time does not mind
}

TEST(CatchUp, afterALongAbsenceThereIsNoBurst)
{
    for (const CatchUp policy : {CatchUp::Replay, CatchUp::Skip, CatchUp::Coarse}) {
        SightStage stage;
        const auto id = stage.add(withPolicy(fountainEffect(), policy), kAhead);
        stage.play(120);
        const uint32_t steady = stage.scene().particles(id);
        const uint64_t bornBefore = stage.scene().counters().work.born;
        stage.look(kBehind);
        stage.play(60 * 20);
        stage.look(0);
        stage.play(1);
        ASSERT_EQ(stage.state(id), InstanceState::Active) << int(policy);
        EXPECT_LE(stage.scene().particles(id), steady + 2) << int(policy);
        EXPECT_EQ(stage.scene().counters().work.dropped, 0u) << int(policy);
        const uint64_t born = stage.scene().counters().work.born - bornBefore;
        EXPECT_LE(born, policy == CatchUp::Skip ? 2u : 20u * 60u + 3u) << int(policy);
    }
}

TEST(CatchUp, camerasNeverChangeWhatIsSimulated)
{
    std::vector<uint64_t> hashes;
    std::vector<Effect> effects;
    for (uint64_t i = 0; i < 6; ++i)
        effects.push_back(i % 2 ? fountainEffect() : toyEffect({i % 4 == 0}));
    for (int cameras = 0; cameras < 4; ++cameras) {
        SightStage stage;
        for (uint64_t i = 0; i < 6; ++i)
            stage.add(effects[i], {0, 0, i % 3 ? -20.0 : 20.0}, i);
        for (int k = 0; k < 40; ++k) {
            std::vector<activation::Frustum> views;
            for (int c = 0; c < cameras; ++c)
                views.push_back(lookAt(0.3 * k * (c + 1)));
            stage.lookThrough(views);
            stage.play(3);
        }
        hashes.push_back(stage.scene().simulationHash());
    }
    for (const uint64_t hash : hashes)
        EXPECT_EQ(hash, hashes[0]);
}

TEST(CatchUp, onlyWithPoliciesThatLeaveTimeOutDoCamerasChangeIt) // the control of the test above
{
    uint64_t hashes[2];
    const Effect effect = withPolicy(toyEffect({false}), CatchUp::Skip);
    for (const int away : {0, 1}) {
        SightStage stage;
        stage.add(effect, kAhead);
        stage.look(away ? kBehind : 0);
        stage.play(10);
        stage.look(0);
        stage.play(10);
        hashes[away] = stage.scene().simulationHash();
    }
    EXPECT_NE(hashes[0], hashes[1]);
}

TEST(CatchUp, withoutABudgetAReplayIsDoneInOneUpdate) // the control of its budget
{
    scene::SceneOptions options;
    options.catchUpSteps = UINT64_MAX;
    SightStage stage(options);
    const auto id = stage.add(toyEffect({false, 9}), kAhead);
    stage.look(kBehind);
    stage.play(200);
    stage.look(0);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
    EXPECT_GT(stage.scene().lastUpdate().catchUpParticleSteps, 100u + 9u);
}

TEST(CatchUp, aStateSavedWhileSomeAreHiddenIsThatOfASceneThatHidesNothing)
{
    VisibilityScript script(5, shortBudget());
    for (int i = 0; i < 8; ++i)
        script.add(i % 2 ? fountainEffect() : toyEffect({i % 4 == 0}));
    for (int k = 0; k < 9; ++k)
        script.act();
    ASSERT_GT(script.culled().counters().hidden, 0u);
    base::HostMemory memory;
    sim::StateBuffer state(&memory);
    script.culled().save(state);
    const auto none = [](uint64_t) { return std::shared_ptr<const sim::EffectDef>(); };
    const base::Status restored = script.culled().restore(state.bytes(), none);
    ASSERT_TRUE(restored.ok()) << restored.message();
    EXPECT_TRUE(script.areEqual());
    script.act();
    script.lookEverywhere();
    EXPECT_TRUE(script.areEqual());
}
