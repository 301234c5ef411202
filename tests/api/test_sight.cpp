// Which instances are in sight, and that no other instance costs anything.
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using scene::InstanceState;
using scene::Reason;

TEST(Sight, whatNoCameraSeesIsHiddenAndTakesNoStep)
{
    SightStage stage;
    const auto ahead = stage.add(toyEffect({true}), kAhead);
    const auto behind = stage.add(toyEffect({true}), -kAhead);
    stage.look(0);
    stage.play(3);
    EXPECT_EQ(stage.state(ahead), InstanceState::Active);
    EXPECT_EQ(stage.state(behind), InstanceState::Hidden);
    EXPECT_EQ(stage.reason(behind), Reason::Outside);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, 3u * 4u); // of the other one
}

TEST(Sight, withoutCamerasOrWithCullingDisabledEverythingIsStepped)
{
    SightStage blind, all(neverCulled());
    blind.add(toyEffect({true}), -kAhead);
    all.add(toyEffect({true}), -kAhead);
    all.look(0);
    blind.play(5);
    all.play(5);
    EXPECT_EQ(blind.scene().counters().work.particleSteps, 20u);
    EXPECT_EQ(all.scene().counters().work.particleSteps, 20u);
}

TEST(Sight, oneOfSeveralCamerasIsEnough)
{
    SightStage stage;
    const auto behind = stage.add(toyEffect({true}), -kAhead);
    stage.lookThrough({lookAt(0), lookAt(kBehind)});
    stage.play(2);
    EXPECT_EQ(stage.state(behind), InstanceState::Active);
}

TEST(Sight, eachReasonIsNamed)
{
    SightStage stage;
    const auto far = stage.add(toyEffect({true}), {0, 0, -500});
    const auto small = stage.add(toyEffect({true}), {0, 0, -90});
    const auto occluded = stage.add(toyEffect({true}), {0, 0, -10});
    const auto near = stage.add(toyEffect({true}), {0, 0, -11});
    const auto shortSight = stage.add(toyEffect({true}), {0, 0, -12});
    const auto later = stage.add(toyEffect({true}), kAhead, 1, 1000 * kStep);
    stage.scene().setHints(occluded, {1, 0, true});
    stage.scene().setHints(shortSight, {1, 5, false});
    stage.lookThrough({lookAt(0, {100, 0, 15, 1000})});
    stage.play(2);
    EXPECT_EQ(stage.reason(far), Reason::TooFar);
    EXPECT_EQ(stage.reason(small), Reason::TooSmall); // 1 m at 89 m: 866 / 89 pixels
    EXPECT_EQ(stage.reason(occluded), Reason::Occluded);
    EXPECT_EQ(stage.reason(near), Reason::None);
    EXPECT_EQ(stage.reason(shortSight), Reason::TooFar);
    EXPECT_EQ(stage.reason(later), Reason::NotStarted);
    stage.scene().setHints(occluded, {});
    stage.play(1);
    EXPECT_EQ(stage.state(occluded), InstanceState::Active);
}

TEST(Sight, hiddenInstancesAreNotVisitedHoweverManyThereAre)
{
    uint32_t judged[2];
    uint64_t steps[2];
    const int counts[2] = {1000, 20'000};
    for (int k = 0; k < 2; ++k) {
        SightStage stage;
        const Effect effect = toyEffect({true});
        stage.look(0);
        for (int i = 0; i < counts[k]; ++i)
            stage.add(effect, {i % 100, i / 100 % 100, 50 + i / 10'000});
        stage.play(2);
        judged[k] = stage.scene().lastUpdate().judged;
        stage.look(0.01); // the camera moves: the whole crowd is turned down at once
        stage.play(1);
        EXPECT_EQ(judged[k], 0u);
        judged[k] = stage.scene().lastUpdate().judged;
        steps[k] = stage.scene().counters().work.particleSteps;
        EXPECT_EQ(stage.scene().counters().hidden, uint32_t(counts[k]));
    }
    EXPECT_LE(judged[0], 50u);
    EXPECT_LE(judged[1], 100u); // of 20,000: the rim of the view
    EXPECT_EQ(steps[0], 0u);
    EXPECT_EQ(steps[1], 0u);
}

TEST(Sight, aCameraThatTurnsFindsExactlyWhatAVisitToAllWouldFind)
{
    SightStage stage;
    const Effect effect = toyEffect({true});
    std::vector<std::pair<scene::LocalId, glm::dvec3>> all;
    for (uint64_t i = 0; i < 500; ++i) {
        const uint64_t random = base::hashWord(7, i);
        const glm::dvec3 at{double(random % 200) - 100, double(random / 200 % 40) - 20,
                            double(random / 8000 % 200) - 100};
        all.push_back({stage.add(effect, at, i), at});
    }
    for (int turn = 0; turn < 60; ++turn) {
        const activation::Frustum camera = lookAt(0.37 * turn);
        stage.lookThrough({camera});
        stage.play(1);
        for (const auto& [id, at] : all) {
            const bool isSeen = camera.judge({at, 1}, 1e9) == activation::Sight::Seen;
            const bool isNearly = camera.judgeWithHysteresis({at, 1}, 1e9) == activation::Sight::Seen;
            const bool isActive = stage.state(id) == InstanceState::Active;
            ASSERT_TRUE(isActive ? isNearly : !isSeen) << "turn " << turn;
        }
    }
}

TEST(Sight, whatMovesIntoSightIsFound)
{
    SightStage stage;
    const auto id = stage.add(toyEffect({true}), -kAhead);
    stage.look(0);
    stage.play(2);
    ASSERT_EQ(stage.state(id), InstanceState::Hidden);
    base::Placement placement;
    placement.position = kAhead;
    stage.scene().setPlacement(id, placement);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
}

TEST(Sight, anEffectOfUnknownExtentIsNeverHiddenForItsPlace)
{
    SightStage stage;
    auto effect = toyEffect({true});
    effect->bound = std::numeric_limits<float>::infinity();
    const auto id = stage.add(effect, -kAhead);
    stage.look(0);
    stage.play(2);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
}

TEST(Sight, authoritativeEffectsAreNeverHidden)
{
    SightStage stage;
    auto effect = toyEffect({true});
    effect->offscreen = sim::CatchUp::Authoritative;
    const auto id = stage.add(effect, -kAhead);
    stage.look(0);
    stage.play(4);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, 16u);
}

TEST(Sight, whatBeginsOutOfSightHasNoSolversBeforeSomebodyLooks)
{
    int made = 0;
    SightStage stage;
    stage.look(0);
    const auto id = stage.add(toyEffect({false, 4, 0, INT64_MAX, &made}), -kAhead, 1, 5 * kStep);
    stage.play(30);
    EXPECT_EQ(stage.state(id), InstanceState::Hidden);
    EXPECT_EQ(made, 0);
    stage.look(kBehind);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
    EXPECT_EQ(made, 1);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, 26u * 4u);
}

TEST(Sight, memoryIsReleasedAfterAWhileAndTakenBackFromWhatWasPutAside)
{
    int made = 0;
    scene::SceneOptions options;
    options.releaseAfter = 20 * kStep;
    SightStage stage(options), always(neverCulled());
    const Effect effect = toyEffect({false, 4, 0, INT64_MAX, &made});
    const auto id = stage.add(effect, -kAhead);
    stage.play(2);
    ASSERT_EQ(made, 1);
    stage.look(0);
    stage.play(30); // released after 20, put aside for 20 more
    stage.look(kBehind);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
    EXPECT_EQ(made, 1) << "the solvers that were put aside are taken back";
    stage.look(0);
    stage.play(60);
    stage.look(kBehind);
    stage.play(1);
    EXPECT_EQ(made, 2) << "after twice that time they are gone";
    always.add(effect, -kAhead);
    always.play(2 + 30 + 1 + 60 + 1);
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
}

TEST(Sight, aHiddenInstanceEndsOnTime)
{
    SightStage stage;
    auto effect = toyEffect({true});
    effect->duration = 10 * kStep;
    stage.look(0);
    const auto id = stage.add(effect, -kAhead);
    stage.play(9);
    EXPECT_EQ(stage.state(id), InstanceState::Hidden);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Finished);
    stage.look(kBehind);
    stage.play(2);
    EXPECT_EQ(stage.state(id), InstanceState::Finished);
}

TEST(Sight, aReturnThatPassesTheEndOfTheEffectEndsIt)
{
    SightStage stage;
    stage.look(0);
    const auto id = stage.add(toyEffect({false, 4, 0, 10 * kStep}), -kAhead);
    stage.play(50);
    EXPECT_EQ(stage.state(id), InstanceState::Hidden); // not known yet
    stage.look(kBehind);
    stage.play(1);
    EXPECT_EQ(stage.state(id), InstanceState::Finished);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, 40u);
}

TEST(Sight, whatHasNothingToDoRestsUntilItHasAndComesOutTheSame)
{
    SightStage stage, always(neverCulled());
    const Effect effect = toyEffect({false, 4, 40 * kStep + 17});
    const auto id = stage.add(effect, kAhead);
    always.add(effect, kAhead);
    stage.play(10);
    always.play(10);
    EXPECT_EQ(stage.state(id), InstanceState::Resting);
    EXPECT_EQ(stage.reason(id), Reason::NothingMoves);
    EXPECT_EQ(stage.scene().counters().active, 0u);
    EXPECT_EQ(stage.scene().counters().resting, 1u);
    stage.play(50);
    always.play(50);
    EXPECT_EQ(stage.state(id), InstanceState::Active);
    EXPECT_EQ(stage.scene().counters().work.particleSteps, always.scene().counters().work.particleSteps);
    EXPECT_EQ(stage.scene().simulationHash(), always.scene().simulationHash());
}

TEST(Sight, tenThousandFramesOfComingAndGoingNeedNoMoreMemory)
{
    SightStage stage;
    for (uint64_t i = 0; i < 24; ++i)
        stage.add(i % 2 ? toyEffect({i % 4 == 1}) : fountainEffect(),
                  {20 * std::sin(0.26 * double(i)), 0, 20 * std::cos(0.26 * double(i))}, i);
    const auto turn = [&stage](int frames) {
        for (int k = 0; k < frames; ++k) {
            stage.look(0.05 * k);
            stage.play(1);
        }
    };
    turn(1000);
    const uint64_t bytes = stage.memory().bytesInUse();
    turn(9000);
    EXPECT_LE(stage.memory().bytesInUse(), bytes + bytes / 20); // who is in sight differs a little
}

TEST(Sight, afterALongTimeWithoutAnythingToSeeViewsStillInterpolateFromTheStepBefore)
{
    SightStage stage;
    stage.play(50);
    stage.add(fountainEffect(), kAhead);
    stage.play(1);
    const scene::Presentation shown = stage.scene().acquire();
    EXPECT_EQ(shown.snapshots.newer->tick(), 51 * kStep);
    EXPECT_EQ(shown.snapshots.older->tick(), 50 * kStep);
    EXPECT_EQ(shown.snapshots.older->groupCount(), 0u);
    stage.scene().release(shown.snapshots);
}
