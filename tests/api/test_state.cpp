#include "tests/api/api_fixture.h"

#include <array>
#include <thread>

using fx::test::burstPreset;
using fx::test::kFrame;
using fx::test::loadText;
using fx::test::smallBlastPreset;

namespace {

/// A scene with instances in every state of life, some of them alike.
class StateApi : public fx::test::ApiTest
{
protected:
    StateApi()
    {
        blast_ = loadText(context_, smallBlastPreset());
        FxInstanceDef def = fxDefaultInstanceDef();
        for (int i = 0; i < 6; ++i) {
            def.preset = i < 4 ? blast_ : fountain_;
            def.seed = uint64_t(i / 2); // pairs
            def.position[0] = 5.0 * i;
            def.startTick = i < 4 ? 0 : 40 * FX_TICKS_PER_SECOND / 37; // while the test runs, not on a step
            def.quality = i == 3 ? FX_QUALITY_HIGH : FX_QUALITY_DEFAULT;
            EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &ids_[size_t(i)]), FX_OK);
        }
        def.preset = loadText(context_, burstPreset(10, 0.2));
        def.destroyWhenFinished = 1;
        def.startTick = 0;
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &brief_), FX_OK);
    }

    void blow(FxInstanceId id, float wind) const
    {
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        parameters.wind[0] = wind;
        ASSERT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_OK);
    }

    FxPresetId blast_{};
    std::array<FxInstanceId, 6> ids_{};
    FxInstanceId brief_{};
};

} // namespace

TEST_F(StateApi, twoThousandStepsAfterARestoredStateAreTheSameBitForBit)
{
    play(33);
    blow(ids_[0], 3.0f);
    play(7);
    ASSERT_EQ(fxScene_Update(scene_, 0.3 * kFrame), FX_OK); // a part of a step is state, too
    const std::vector<std::byte> state = savedState();
    const auto run = [this] {
        std::vector<uint64_t> hashes;
        for (int i = 0; i < 200; ++i) {
            play(10);
            hashes.insert(hashes.end(), {hash(), simulationHash()});
        }
        return hashes;
    };
    const std::vector<uint64_t> first = run();
    const FxSceneStatistics after = statistics();
    ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(savedState(), state);
    EXPECT_EQ(run(), first);
    EXPECT_EQ(statistics().nowTick, after.nowTick);
    EXPECT_EQ(statistics().particleSteps, after.particleSteps);
    EXPECT_EQ(after.neighborPairs > 0, fx::test::kHasGas);
    EXPECT_GE(after.steps, 2040u);
}

TEST_F(StateApi, restoringShowsTheSavedStepAtOnce)
{
    play(20);
    const uint64_t shown = hash();
    const std::vector<std::byte> state = savedState();
    play(20);
    ASSERT_NE(hash(), shown);
    ASSERT_EQ(restore(state), FX_OK);
    EXPECT_EQ(hash(), shown);
    FxSnapshotId snapshot{};
    ASSERT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxScene_GetSnapshotInfo(scene_, snapshot, &info), FX_OK);
    EXPECT_EQ(info.tickNewer, 20 * FX_TICKS_PER_SECOND / 60);
    EXPECT_EQ(info.groupsOlder, 0u); // what was shown before did not lead here
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene_, snapshot), FX_OK);
}

TEST_F(StateApi, restoredTrailsHashAsWhenTheyWereSaved)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    ASSERT_EQ(fxLoadPresetLibrary(context_, "tracer", &def.preset), FX_OK);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    play(20);
    const uint64_t shown = hash();
    const std::vector<std::byte> state = savedState();
    play(20);
    ASSERT_EQ(restore(state), FX_OK);
    EXPECT_EQ(hash(), shown);
}

TEST_F(StateApi, aPresetThatIsLoadedTwiceIsOneToAState)
{
    FxInstanceDef def = instanceDef();
    FxInstanceId id{};
    for (int i = 0; i < 2; ++i) {
        def.preset = loadText(context_, smallBlastPreset());
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    }
    play(10);
    const uint64_t before = simulationHash();
    const std::vector<std::byte> state = savedState();
    ASSERT_EQ(restore(state), FX_OK);
    EXPECT_EQ(simulationHash(), before);
    EXPECT_EQ(savedState(), state);
}

TEST_F(StateApi, anotherSceneOfTheSamePresetsContinuesTheSame)
{
    play(30);
    const std::vector<std::byte> state = savedState();
    play(60);

    FxScene* other = nullptr;
    FxSceneDef def = fxDefaultSceneDef();
    def.shareInstances = 0; // how the work is done is not part of the state
    ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
    ASSERT_EQ(fxScene_RestoreState(other, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
    std::array<FxInstanceId, 8> ids{};
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetInstances(other, ids.data(), uint32_t(ids.size()), &count), FX_OK);
    ASSERT_EQ(count, 6u);
    EXPECT_EQ(fxScene_IsValid(other, ids[0]), 1u);
    for (int frame = 0; frame < 60; ++frame)
        ASSERT_EQ(fxScene_Update(other, kFrame), FX_OK);
    uint64_t seen = 0, whole = 0;
    ASSERT_EQ(fxScene_GetStateHash(other, &seen), FX_OK);
    ASSERT_EQ(fxScene_GetSimulationHash(other, &whole), FX_OK);
    EXPECT_EQ(seen, hash());
    EXPECT_EQ(whole, simulationHash());
    EXPECT_EQ(fxDestroyScene(other), FX_OK);
}

TEST_F(StateApi, identitiesComeBackWithTheirInstances)
{
    play(5);
    const std::vector<std::byte> state = savedState();
    play(30);
    EXPECT_EQ(fxScene_IsValid(scene_, brief_), 0u); // ended and destroyed itself
    ASSERT_EQ(fxScene_DestroyInstance(scene_, ids_[2]), FX_OK);
    FxInstanceId late{};
    FxInstanceDef def = instanceDef();
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &late), FX_OK);

    ASSERT_EQ(restore(state), FX_OK);
    EXPECT_EQ(fxScene_IsValid(scene_, brief_), 1u);
    EXPECT_EQ(fxScene_IsValid(scene_, ids_[2]), 1u);
    EXPECT_EQ(fxScene_IsValid(scene_, late), 0u);
    FxInstanceId next{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &next), FX_OK);
    for (const FxInstanceId id : ids_)
        EXPECT_NE(next.bits, id.bits);
    play(30);
    EXPECT_EQ(fxScene_IsValid(scene_, brief_), 0u); // it still destroys itself
}

TEST_F(StateApi, identitiesAreGivenOutInTheSameOrderAsBefore)
{
    for (const size_t i : {3u, 0u, 2u})
        ASSERT_EQ(fxScene_DestroyInstance(scene_, ids_[i]), FX_OK);
    const std::vector<std::byte> state = savedState();
    const auto addFive = [this] {
        std::array<uint64_t, 5> bits{};
        for (uint64_t& each : bits)
            each = addFountain().bits;
        return bits;
    };
    const std::array<uint64_t, 5> first = addFive();
    ASSERT_EQ(restore(state), FX_OK);
    EXPECT_EQ(addFive(), first);
}

TEST_F(StateApi, partsOfATickAreKept)
{
    const double tick = 1.0 / double(FX_TICKS_PER_SECOND);
    ASSERT_EQ(fxScene_Update(scene_, 0.4 * tick), FX_OK);
    const std::vector<std::byte> state = savedState();
    ASSERT_EQ(restore(state), FX_OK);
    ASSERT_EQ(fxScene_Update(scene_, 0.4 * tick), FX_OK);
    EXPECT_EQ(statistics().nowTick, 1); // 0.8, rounded
}

TEST_F(StateApi, presetsThatWereUnloadedAreFoundInTheSceneAndMissedInAnother)
{
    play(5);
    const std::vector<std::byte> state = savedState();
    ASSERT_EQ(fxUnloadPreset(context_, blast_), FX_OK);
    EXPECT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
    FxScene* other = nullptr;
    const FxSceneDef def = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
    EXPECT_EQ(fxScene_RestoreState(other, state.data(), state.size()), FX_ERROR_NOT_FOUND);
    loadText(context_, "\n" + smallBlastPreset()); // the same but for a blank
    EXPECT_EQ(fxScene_RestoreState(other, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxDestroyScene(other), FX_OK);
}

TEST_F(StateApi, aSceneWithOtherRulesIsRefused)
{
    play(5);
    const std::vector<std::byte> state = savedState();
    std::array<FxSceneDef, 4> defs;
    defs.fill(fxDefaultSceneDef());
    defs[0].stepTicks /= 2;
    defs[1].gravity[1] = -1.62f;
    defs[2].hasGround = 0;
    defs[3].maxInstances = 5;
    for (const FxSceneDef& def : defs) {
        FxScene* other = nullptr;
        ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
        const FxResult wanted = def.maxInstances == 5 ? FX_ERROR_CAPACITY : FX_ERROR_INVALID_ARGUMENT;
        EXPECT_EQ(fxScene_RestoreState(other, state.data(), state.size()), wanted);
        EXPECT_EQ(fxDestroyScene(other), FX_OK);
    }
}

TEST_F(StateApi, theSimulationHashSeesWhatIsNotYetSeen)
{
    play(10);
    const uint64_t seen = hash();
    const uint64_t whole = simulationHash();
    blow(ids_[5], 1.0f); // dormant
    EXPECT_EQ(hash(), seen);
    EXPECT_NE(simulationHash(), whole);
    blow(ids_[5], 0.0f);
    EXPECT_EQ(simulationHash(), whole);
    ASSERT_EQ(fxScene_Update(scene_, 0.5 * kFrame), FX_OK); // no step is due
    EXPECT_EQ(simulationHash(), whole);
}

TEST_F(StateApi, argumentsAreChecked)
{
    size_t size = 77;
    uint64_t hash = 77;
    uint32_t count = 77;
    std::array<std::byte, 64> small{};
    EXPECT_EQ(fxScene_SaveState(nullptr, nullptr, 0, &size), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SaveState(scene_, nullptr, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SaveState(scene_, small.data(), small.size(), &size), FX_ERROR_CAPACITY);
    EXPECT_EQ(small, (std::array<std::byte, 64>{}));
    EXPECT_EQ(size, 77u);
    EXPECT_EQ(fxScene_RestoreState(nullptr, small.data(), small.size()), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_RestoreState(scene_, nullptr, 64), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_RestoreState(scene_, small.data(), 0), FX_ERROR_PARSE);
    EXPECT_EQ(fxScene_GetSimulationHash(nullptr, &hash), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetSimulationHash(scene_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetInstances(nullptr, nullptr, 0, &count), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetInstances(scene_, nullptr, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    FxInstanceId one{};
    EXPECT_EQ(fxScene_GetInstances(scene_, &one, 1, &count), FX_ERROR_CAPACITY);
    EXPECT_EQ(one.bits, 0u);
    EXPECT_EQ(count, 77u);
    EXPECT_EQ(fxScene_GetInstances(scene_, nullptr, 0, &count), FX_OK);
    EXPECT_EQ(count, 7u);
}

TEST_F(StateApi, otherThreadsAreSentAway)
{
    const std::vector<std::byte> state = savedState();
    std::thread([&] {
        size_t size = 0;
        uint64_t hash = 0;
        uint32_t count = 0;
        EXPECT_EQ(fxScene_SaveState(scene_, nullptr, 0, &size), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_RestoreState(scene_, state.data(), state.size()), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetSimulationHash(scene_, &hash), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetInstances(scene_, nullptr, 0, &count), FX_ERROR_WRONG_THREAD);
    }).join();
}

TEST_F(StateApi, qualitiesOutsideOfTheListAreRefused)
{
    FxInstanceDef def = instanceDef();
    FxInstanceId id{};
    for (const uint32_t quality : {5u, 1u << 30, ~0u}) {
        def.quality = quality;
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_ERROR_INVALID_ARGUMENT) << quality;
        FxSceneDef sceneDef = fxDefaultSceneDef();
        sceneDef.quality = quality;
        FxScene* scene = nullptr;
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_ERROR_INVALID_ARGUMENT) << quality;
    }
    def.quality = FX_QUALITY_LOW;
    def.reserved = 1;
    EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_ERROR_INVALID_ARGUMENT);
}
