// What is out of sight keeps and replays no more than what can still be seen of it.
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using scene::InstanceState;
using sim::CatchUp;

namespace {

constexpr int kManyInstances = 100;
const glm::dvec3 kFar{0, 0, -200}; // farther than they fly
constexpr int kSecond = 60;        ///< [step]

scene::SceneOptions releasedAfter(int steps)
{
    scene::SceneOptions options;
    options.releaseAfter = steps * kStep;
    return options;
}

/// [byte] that each of many hidden instances, of simulations of their own, keeps. One is seen at a time.
double bytesEach(const Effect& effect)
{
    uint64_t bytes[2];
    for (const int count : {1, kManyInstances}) {
        SightStage stage(releasedAfter(5 * kSecond));
        stage.look(0);
        for (int i = 0; i < count; ++i) {
            const scene::LocalId id = stage.add(effect, kFar, uint64_t(i));
            stage.play(kSecond / 2);
            stage.scene().setHints(id, {1, 0, true}); // occluded
        }
        stage.play(20 * kSecond);
        EXPECT_EQ(stage.scene().counters().hidden, uint32_t(count));
        bytes[count == 1 ? 0 : 1] = stage.memory().bytesInUse();
    }
    return double(bytes[1] - bytes[0]) / (kManyInstances - 1);
}

} // namespace

TEST(Forgetting, hiddenInstancesKeepNoParticlesThatWillBeDeadWhenTheyReturn)
{
    for (const bool curls : {false, true})
        EXPECT_LT(bytesEach(fountainEffect(curls, 2.0f)), 700.0) << curls;
}

TEST(Forgetting, whatIsNotCaughtUpWithoutATraceKeepsEverything) // the control of the test above
{
    Effect effect = fountainEffect(true, 2.0f);
    effect->offscreen = CatchUp::Skip;
    EXPECT_GT(bytesEach(effect), 1500.0);
}

TEST(Forgetting, thoseOfLongLivesAreGivenBackWhenTheirTimeIsOver)
{
    for (const bool curls : {false, true}) {
        SightStage stage(releasedAfter(kSecond));
        for (int i = 0; i < kManyInstances; ++i)
            stage.add(fountainEffect(curls, 4.0f), kFar, uint64_t(i));
        stage.play(3 * kSecond);
        stage.look(kBehind);
        stage.play(3 * kSecond + 5); // solvers are released, their particles may yet be seen
        const uint64_t before = stage.memory().bytesInUse();
        stage.play(4 * kSecond);
        EXPECT_LT(stage.memory().bytesInUse() + kManyInstances * 5000u, before) << curls;
    }
}

TEST(Forgetting, aReplayTakesALifetimeHoweverLongTheAbsence)
{
    for (const int away : {90, 20 * kSecond, 100 * kSecond}) { // the last is longer than what is replayed
        SightStage stage, always(neverCulled());
        const Effect effect = fountainEffect(true);
        const auto id = stage.add(effect, kFar);
        always.add(effect, kFar);
        stage.play(40);
        stage.look(kBehind);
        stage.play(away);
        stage.look(0);
        stage.play(1);
        always.play(41 + away);
        EXPECT_EQ(stage.state(id), InstanceState::Active);
        EXPECT_EQ(stage.scene().counters().catchUpsSkipped, 0u);
        EXPECT_LE(stage.scene().lastUpdate().catchUpParticleSteps, 92u * 31u); // 1.5 s, 30 particles at once
        EXPECT_GT(stage.scene().lastUpdate().catchUpParticleSteps, 60u);
        EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash()) << away;
        EXPECT_EQ(stage.scene().stateHash(), always.scene().stateHash()) << away;
    }
}

TEST(Forgetting, changesOfWhileItIsAwayLeaveNoTrace)
{
    for (const bool curls : {false, true})
        for (const int told : {1, 30, 200, 700}) {
            SightStage stage(releasedAfter(2 * kSecond)), always(neverCulled());
            const Effect effect = fountainEffect(curls, 1.0f);
            std::vector<scene::LocalId> ids;
            for (SightStage* each : {&stage, &always})
                ids.push_back(each->add(effect, kFar));
            const auto tell = [&](float intensity, const glm::vec3& wind) {
                stage.scene().setParameters(ids[0], {intensity, wind});
                always.scene().setParameters(ids[1], {intensity, wind});
            };
            const auto play = [&](int steps) {
                stage.play(steps);
                always.play(steps);
            };
            tell(5.0f, {}); // some are dropped
            play(100);
            tell(1.0f, {});
            play(7);
            stage.look(kBehind);
            play(told);
            tell(told % 2 ? 0.5f : 1.0f, {0, 0, 1});
            play(800 - told);
            stage.look(0);
            play(1);
            EXPECT_EQ(stage.state(ids[0]), InstanceState::Active);
            EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash()) << curls << told;
        }
}

TEST(Forgetting, aSeekOfWhatIsAwayGivesWhatItGivesAnywhere)
{
    for (const bool curls : {false, true}) {
        SightStage stage, always(neverCulled());
        const Effect effect = fountainEffect(curls, 1.0f);
        const auto id = stage.add(effect, kFar), other = always.add(effect, kFar);
        stage.play(60);
        stage.look(kBehind);
        stage.play(900);
        always.play(960);
        ASSERT_TRUE(stage.scene().seek(id, 1000 * kStep).ok());
        ASSERT_TRUE(always.scene().seek(other, 1000 * kStep).ok());
        EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash()) << curls;
    }
}
