#include "tests/api/api_fixture.h"

#include <algorithm>
#include <limits>

using namespace fx::test;

namespace {

class InstanceTimeApi : public ApiTest
{
protected:
    FxInstanceId add(const std::string& text)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context_, text);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        return id;
    }
    uint32_t particlesOf(FxInstanceId id) const
    {
        uint32_t particles = 0;
        EXPECT_EQ(fxScene_GetInstanceState(scene_, id, nullptr, &particles), FX_OK);
        return particles;
    }
};

/// What views get to see: living particles of the newest step, their greatest age, and groups of the step
/// before.
struct Shown
{
    uint32_t particles = 0;
    float oldest = 0; ///< [s]
    uint32_t groupsBefore = 0;
};

Shown shownOf(FxScene* scene)
{
    Shown shown;
    FxSnapshotId snapshot{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, snapshot, &info), FX_OK);
    shown.groupsBefore = info.groupsOlder;
    for (uint32_t g = 0; g < info.groupsNewer; ++g) {
        FxSnapshotColumn age{}, radius{};
        age.structSize = radius.structSize = sizeof age;
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, g, "age", &age), FX_OK);
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, g, "radius", &radius),
                  FX_OK);
        for (uint32_t i = 0; i < age.count; ++i)
            if (radius.values[i] > 0) {
                ++shown.particles;
                shown.oldest = std::max(shown.oldest, age.values[i]);
            }
    }
    fxScene_ReleaseSnapshot(scene, snapshot);
    return shown;
}

const std::string kBell = R"({"version":1,"emitters":[
    {"name":"bell","emission":{},"position":[0,1,0],"events":[{"on":"host","name":"ring","emit":"waves","count":5}]},
    {"name":"waves","lifetime":100}]})";

} // namespace

TEST_F(InstanceTimeApi, anEventGivesBirthWithTheNextStep)
{
    const FxInstanceId bell = add(kBell);
    play(3);
    EXPECT_EQ(particlesOf(bell), 0u);
    EXPECT_EQ(fxScene_TriggerEvent(scene_, bell, "ring", 2), FX_OK);
    EXPECT_EQ(particlesOf(bell), 0u);
    play(1);
    EXPECT_EQ(particlesOf(bell), 10u);
    play(5);
    EXPECT_EQ(particlesOf(bell), 10u);
}

TEST_F(InstanceTimeApi, whatIsToldIsSavedAndRestored)
{
    const FxInstanceId bell = add(kBell);
    play(3);
    ASSERT_EQ(fxScene_TriggerEvent(scene_, bell, "ring", 1), FX_OK);
    const auto state = savedState();
    play(2);
    const uint64_t want = simulationHash();
    ASSERT_EQ(restore(state), FX_OK);
    play(2);
    EXPECT_EQ(simulationHash(), want);
    EXPECT_EQ(particlesOf(bell), 5u);
}

TEST_F(InstanceTimeApi, aSeekEqualsPlayingForwardsAndBackwards)
{
    const FxInstanceId played = addFountain();
    play(90);
    const FxInstanceId sought = addFountain(); // begins 90 frames later
    play(1);
    EXPECT_EQ(fxScene_SeekInstance(scene_, sought, 1.5), FX_OK);
    EXPECT_EQ(particlesOf(sought), particlesOf(played));
    EXPECT_EQ(fxScene_SeekInstance(scene_, sought, 0.5), FX_OK);
    EXPECT_EQ(particlesOf(sought), 30u);
    const auto state = savedState();
    play(10);
    const uint64_t want = simulationHash();
    ASSERT_EQ(restore(state), FX_OK);
    play(10);
    EXPECT_EQ(simulationHash(), want);
}

TEST_F(InstanceTimeApi, aSeekBeforeTheFirstStepHasThePrewarmBehindIt)
{
    const std::string prewarmed = R"({"version": 1, "prewarm": 2, "emitters": [{"maxParticles": 4000,
        "emission": {"rate": 100}, "lifetime": 10, "forces": {"drag": 1, "curlStrength": 1},
        "collisions": [{"shape": "ground", "bounce": 0.5}]}]})"; // needs every step of its past
    const FxInstanceId fresh = add(prewarmed);
    ASSERT_EQ(fxScene_SeekInstance(scene_, fresh, 3.0), FX_OK);
    EXPECT_EQ(particlesOf(fresh), 300u);
    const FxInstanceId backwards = add(prewarmed);
    ASSERT_EQ(fxScene_SeekInstance(scene_, backwards, 0.5), FX_OK);
    EXPECT_EQ(particlesOf(backwards), 50u);
    const FxInstanceId stepped = add(prewarmed);
    play(1);
    ASSERT_EQ(fxScene_SeekInstance(scene_, stepped, 3.0), FX_OK);
    EXPECT_EQ(particlesOf(stepped), 300u);
    EXPECT_EQ(particlesOf(fresh), 302u); // one step later
}

TEST_F(InstanceTimeApi, aJumpInTimeIsTheEndOfAMove)
{
    const FxInstanceId id = add(R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 4000,
        "space": "world", "emission": {"rate": 600}, "lifetime": 100, "forces": {"gravity": 0},
        "appearance": {"kind": "sprite"}}]})");
    play(3);
    const double there[3] = {0, 8, 0};
    const float upright[4] = {0, 0, 0, 1};
    ASSERT_EQ(fxScene_SetTransform(scene_, id, there, upright, 1.0f), FX_OK);
    ASSERT_EQ(fxScene_SeekInstance(scene_, id, 0.0), FX_OK);
    ASSERT_EQ(fxScene_Update(scene_, 4 * kFrame), FX_OK);
    FxSnapshotId snapshot{};
    ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
    FxSnapshotColumn y{};
    y.structSize = sizeof y;
    ASSERT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, 0, "y", &y), FX_OK);
    ASSERT_GT(y.count, 30u);
    for (uint32_t i = 0; i < y.count; ++i) // particles keep to where it began: at the end of the way
        EXPECT_EQ(y.values[i], 0.0f);
    fxScene_ReleaseSnapshot(scene_, snapshot);
}

TEST_F(InstanceTimeApi, aSceneThatStandsStillShowsTheTimeThatWasSought)
{
    const FxInstanceId id = addFountain();
    play(60);
    for (const double seconds : {0.75, 0.25, 0.5}) { // as an editor does
        const uint64_t before = hash();
        ASSERT_EQ(fxScene_SeekInstance(scene_, id, seconds), FX_OK);
        ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
        const Shown shown = shownOf(scene_);
        EXPECT_EQ(shown.particles, uint32_t(60.0 * seconds)) << seconds;
        EXPECT_NEAR(double(shown.oldest), seconds, 1.0 / 60.0) << seconds;
        EXPECT_LE(double(shown.oldest), seconds + 1e-5) << seconds;
        EXPECT_EQ(shown.groupsBefore, 0u) << "nothing to mix it with";
        EXPECT_NE(hash(), before);
    }
    play(1); // from there on
    const Shown next = shownOf(scene_);
    EXPECT_EQ(next.particles, 31u);
    EXPECT_EQ(next.groupsBefore, 1u);
}

TEST_F(InstanceTimeApi, theHashFollowsASeekAtOnce)
{
    const FxInstanceId id = addFountain();
    play(30);
    const uint64_t want = hash();
    ASSERT_EQ(fxScene_SeekInstance(scene_, id, 0.25), FX_OK);
    EXPECT_NE(hash(), want);
    ASSERT_EQ(fxScene_SeekInstance(scene_, id, 0.5), FX_OK);
    EXPECT_EQ(hash(), want);
}

TEST_F(InstanceTimeApi, whoRestsIsShownWhereItIsSought)
{
    const FxInstanceId id =
        add(R"({"version": 1, "emitters": [{"emission": {"bursts": [{"time": 0, "count": 7},
        {"time": 20, "count": 3}]}, "lifetime": 0.5, "appearance": {"kind": "sprite"}}]})");
    play(120);
    FxInstanceState state{};
    ASSERT_EQ(fxScene_GetInstanceState(scene_, id, &state, nullptr), FX_OK);
    ASSERT_EQ(state, FX_INSTANCE_RESTING);
    EXPECT_EQ(shownOf(scene_).particles, 0u);
    ASSERT_EQ(fxScene_SeekInstance(scene_, id, 0.25), FX_OK);
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    EXPECT_EQ(shownOf(scene_).particles, 7u);
    ASSERT_EQ(fxScene_SeekInstance(scene_, id, 10.0), FX_OK);
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    EXPECT_EQ(shownOf(scene_).particles, 0u);
}

TEST_F(InstanceTimeApi, speedScalesTime)
{
    const FxInstanceId slow = add(fountainPreset());
    EXPECT_EQ(fxScene_SetInstanceSpeed(scene_, slow, 0.5f), FX_OK);
    play(60);
    EXPECT_EQ(particlesOf(slow), 30u);
    EXPECT_EQ(fxScene_SetInstanceSpeed(scene_, slow, 0.0f), FX_OK);
    play(60);
    EXPECT_EQ(particlesOf(slow), 30u);
    EXPECT_EQ(fxScene_SetInstanceSpeed(scene_, slow, 4.0f), FX_OK);
    play(6);
    EXPECT_EQ(particlesOf(slow), 54u);
}

TEST_F(InstanceTimeApi, badArgumentsAreRefused)
{
    const FxInstanceId bell = add(kBell);
    play(1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(fxScene_TriggerEvent(nullptr, bell, "ring", 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_TriggerEvent(scene_, bell, nullptr, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_TriggerEvent(scene_, bell, "ring", 65537), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_TriggerEvent(scene_, bell, "rang", 1), FX_ERROR_NOT_FOUND);
    EXPECT_EQ(fxScene_TriggerEvent(scene_, {77}, "ring", 1), FX_ERROR_STALE_ID);
    for (const float speed : {-1.0f, 17.0f, nan})
        EXPECT_EQ(fxScene_SetInstanceSpeed(scene_, bell, speed), FX_ERROR_INVALID_ARGUMENT);
    for (const double seconds : {-1.0, 1e6, double(nan)})
        EXPECT_EQ(fxScene_SeekInstance(scene_, bell, seconds), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetInstanceSpeed(scene_, {77}, 1.0f), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_SeekInstance(scene_, {77}, 1.0), FX_ERROR_STALE_ID);
}
