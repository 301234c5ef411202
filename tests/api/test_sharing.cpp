#include "tests/api/api_fixture.h"

#include <array>
#include <cmath>
#include <functional>

using fx::test::ApiTest;
using fx::test::kFrame;
using fx::test::loadText;
using fx::test::smallBlastPreset;

namespace {

/// A scene that shares and one that does not, which get the same calls.
class SharingApi : public ApiTest
{
protected:
    SharingApi()
    {
        blast_ = loadText(context_, smallBlastPreset());
        FxSceneDef def = fxDefaultSceneDef();
        def.shareInstances = 0;
        EXPECT_EQ(fxCreateScene(context_, &def, &alone_), FX_OK);
    }

    FxInstanceDef blastDef(int i) const
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = blast_;
        def.seed = 3;
        def.position[0] = 4.0 * i;
        return def;
    }

    /// Adds an instance to both scenes.
    void add(const FxInstanceDef& def)
    {
        ids_.emplace_back();
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &ids_.back()[0]), FX_OK);
        EXPECT_EQ(fxScene_CreateInstance(alone_, &def, &ids_.back()[1]), FX_OK);
    }
    void addMany(int count)
    {
        for (int i = 0; i < count; ++i)
            add(blastDef(i));
    }

    /// Calls change(scene, id of instance i) for both scenes.
    template <class F>
    void change(size_t i, F&& change)
    {
        change(scene_, ids_[i][0]);
        change(alone_, ids_[i][1]);
    }

    void setParameters(size_t i, float intensity, float wind, uint32_t emitting)
    {
        change(i, [&](FxScene* scene, FxInstanceId id) {
            FxInstanceParameters parameters = fxDefaultInstanceParameters();
            parameters.intensity = intensity;
            parameters.wind[2] = wind;
            parameters.emitting = emitting;
            EXPECT_EQ(fxScene_SetParameters(scene, id, &parameters), FX_OK);
        });
    }
    void setTransform(size_t i, std::array<double, 3> position, std::array<float, 4> rotation, float scale)
    {
        change(i, [&](FxScene* scene, FxInstanceId id) {
            EXPECT_EQ(fxScene_SetTransform(scene, id, position.data(), rotation.data(), scale), FX_OK);
        });
    }

    /// Steps both scenes and compares them after each frame.
    void playBoth(int frames)
    {
        for (int frame = 0; frame < frames; ++frame) {
            ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
            ASSERT_EQ(fxScene_Update(alone_, kFrame), FX_OK);
            uint64_t seen = 0, whole = 0;
            ASSERT_EQ(fxScene_GetStateHash(alone_, &seen), FX_OK);
            ASSERT_EQ(fxScene_GetSimulationHash(alone_, &whole), FX_OK);
            ASSERT_EQ(hash(), seen) << frame;
            ASSERT_EQ(simulationHash(), whole) << frame;
        }
    }

    FxSceneStatistics aloneStatistics() const
    {
        FxSceneStatistics statistics{};
        statistics.structSize = sizeof statistics;
        EXPECT_EQ(fxScene_GetStatistics(alone_, &statistics), FX_OK);
        return statistics;
    }

    FxPresetId blast_{};
    FxScene* alone_ = nullptr;
    std::vector<std::array<FxInstanceId, 2>> ids_; ///< in either scene
};

constexpr std::array<float, 4> kUpright{0, 0, 0, 1};

} // namespace

TEST_F(SharingApi, aHundredIdenticalInstancesCostTheStepsOfOne)
{
    addMany(1);
    playBoth(60);
    const FxSceneStatistics one = statistics();
    ASSERT_EQ(fxDestroyScene(scene_), FX_OK);
    const FxSceneDef def = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
    FxInstanceId id{};
    for (int i = 0; i < 100; ++i) {
        const FxInstanceDef instance = blastDef(i);
        ASSERT_EQ(fxScene_CreateInstance(scene_, &instance, &id), FX_OK);
    }
    play(60);
    const FxSceneStatistics hundred = statistics();
    EXPECT_EQ(hundred.instancesActive, 100u);
    EXPECT_EQ(hundred.simulations, 1u);
    EXPECT_EQ(hundred.particles, 100 * one.particles); // they are all there to be seen
    EXPECT_EQ(hundred.particleSteps, one.particleSteps);
    EXPECT_EQ(hundred.neighborPairs, one.neighborPairs);
    EXPECT_EQ(hundred.subSteps, one.subSteps);
    EXPECT_EQ(hundred.born, one.born);
    EXPECT_EQ(one.neighborPairs > 0, fx::test::kHasGas);
}

TEST_F(SharingApi, identicalEmittersShareOneSimulationAndAnotherSeedDoesNot)
{
    blast_ = loadText(context_, R"({"version": 1, "ground": false, "emitters": [
        {"shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1, "speed": 1, "radius": 0.2,
         "forces": {"drag": 0.5, "gravity": 0.3, "curlStrength": 1}}]})");
    addMany(20);
    playBoth(60);
    EXPECT_EQ(statistics().simulations, 1u);
    EXPECT_EQ(aloneStatistics().simulations, 20u);
    EXPECT_EQ(statistics().particleSteps * 20, aloneStatistics().particleSteps);
    FxInstanceDef other = blastDef(30);
    other.seed = 4;
    add(other);
    playBoth(10);
    EXPECT_EQ(statistics().simulations, 2u);
}

TEST_F(SharingApi, sharedInstancesAreShownAtTheirOwnPlaces)
{
    addMany(3);
    playBoth(10);
    FxSnapshotId snapshot{};
    ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
    const uint32_t solvers = fx::test::kHasGas ? 3 : 2;
    for (uint32_t i = 0; i < 3 * solvers; ++i) {
        FxSnapshotGroup group{};
        group.structSize = sizeof group;
        ASSERT_EQ(fxScene_GetSnapshotGroup(scene_, snapshot, FX_SNAPSHOT_NEWER, i, &group), FX_OK);
        EXPECT_EQ(group.instance.bits, ids_[i / solvers][0].bits);
        EXPECT_EQ(group.position[0], 4.0 * (i / solvers));
        EXPECT_EQ(group.solver, i % solvers);
    }
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot), FX_OK);
}

TEST_F(SharingApi, eachWayOfBeingDifferentEndsSharingWithTheBitsOfNeverHavingShared)
{
    addMany(8);
    playBoth(20);
    EXPECT_EQ(statistics().simulations, 1u);
    EXPECT_EQ(aloneStatistics().simulations, 8u);
    setParameters(1, 1.0f, 5.0f, 1); // wind
    EXPECT_EQ(statistics().simulations, 2u);
    playBoth(10);
    setParameters(2, 3.0f, 0.0f, 1); // intensity
    playBoth(10);
    setParameters(3, 1.0f, 0.0f, 0); // emission
    const float half = std::sqrt(0.5f);
    setTransform(4, {0, 0, 0}, {0, 0, half, half}, 1.0f); // gravity comes from the side
    EXPECT_EQ(statistics().simulations, 5u);
    playBoth(10);
    setParameters(0, 1.0f, 0.0f, 1); // what it has
    setTransform(5, {1e5, 2, -3}, kUpright, 7.0f);
    EXPECT_EQ(statistics().simulations, 5u); // 0, 5, 6, 7 go on together
    playBoth(30);
}

TEST_F(SharingApi, aTurnAboutTheVerticalSharesUntilTheWindBlows)
{
    const float half = std::sqrt(0.5f);
    addMany(3);
    setTransform(1, {0, 0, 0}, {0, half, 0, half}, 1.0f);
    setTransform(2, {0, 0, 0}, kUpright, 2.0f);
    playBoth(10);
    EXPECT_EQ(statistics().simulations, 1u);
    for (size_t i = 0; i < 3; ++i)
        setParameters(i, 1.0f, 4.0f, 1); // from another side, and weaker for the large one
    playBoth(10);
    EXPECT_EQ(statistics().simulations, 3u);
}

TEST_F(SharingApi, instancesChangedAlikeBeforeTheirStartShareAgain)
{
    addMany(4);
    for (size_t i = 0; i < 4; ++i)
        setParameters(i, 2.0f, 3.0f, 1);
    EXPECT_EQ(statistics().simulations, 1u);
    setParameters(2, 1.0f, 3.0f, 1);
    EXPECT_EQ(statistics().simulations, 2u);
    playBoth(20);
}

TEST_F(SharingApi, onlyEqualStartsSeedsPresetsAndQualitiesShare)
{
    FxInstanceDef def = blastDef(0);
    add(def);
    def.seed = 4;
    add(def);
    def = blastDef(0);
    def.quality = FX_QUALITY_LOW;
    add(def);
    def = blastDef(0);
    def.preset = fountain_;
    add(def);
    def = blastDef(0);
    def.startTick = 100; // within the first step
    add(def);
    add(def);
    def.startTick = 20 * FX_TICKS_PER_SECOND / 60 + 5;
    add(def);
    add(def);
    playBoth(15);
    EXPECT_EQ(statistics().simulations, 5u);
    add(blastDef(0)); // starts now, so it is younger than the first
    EXPECT_EQ(statistics().simulations, 6u);
    add(blastDef(1)); // as young as the one before
    EXPECT_EQ(statistics().simulations, 6u);
    playBoth(15);
    EXPECT_EQ(statistics().simulations, 7u); // the two late ones have woken together
}

TEST_F(SharingApi, leavingInstancesDoNotDisturbTheOthers)
{
    addMany(4);
    playBoth(5);
    change(0, [](FxScene* scene, FxInstanceId id) { EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK); });
    playBoth(5);
    setParameters(1, 1.0f, 2.0f, 1);
    change(2, [](FxScene* scene, FxInstanceId id) { EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK); });
    playBoth(5);
    EXPECT_EQ(statistics().simulations, 2u);
    change(3, [](FxScene* scene, FxInstanceId id) { EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK); });
    change(1, [](FxScene* scene, FxInstanceId id) { EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK); });
    EXPECT_EQ(statistics().simulations, 0u);
    addMany(2);
    playBoth(5);
    EXPECT_EQ(statistics().simulations, 1u);
}

TEST_F(SharingApi, aRestoredStateStillShares)
{
    addMany(5);
    playBoth(10);
    setParameters(0, 1.0f, 2.0f, 1);
    playBoth(10);
    const std::vector<std::byte> state = savedState();
    playBoth(10);
    ASSERT_EQ(restore(state), FX_OK);
    EXPECT_EQ(statistics().simulations, 2u);
    ASSERT_EQ(fxScene_RestoreState(alone_, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(aloneStatistics().simulations, 5u);
    setParameters(1, 1.0f, 3.0f, 1);
    playBoth(20);
    EXPECT_EQ(statistics().simulations, 3u);
}

TEST_F(SharingApi, aRestoredStateOfAnInstanceThatHasNotBegunCanBeJoined)
{
    playBoth(3);
    add(blastDef(0));
    const std::vector<std::byte> state = savedState();
    ASSERT_EQ(restore(state), FX_OK);
    add(blastDef(1));
    EXPECT_EQ(statistics().simulations, 1u);
    playBoth(10);
}
