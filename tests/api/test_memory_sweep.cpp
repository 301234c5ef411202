// Every request for memory of a host's day is refused in turn: creating, loading, updating, saving and
// restoring. A call that fails changes nothing, loses nothing, and succeeds when it is repeated.
#include "tests/api/api_fixture.h"
#include "tests/api/library_names.h"
#include "tests/api/memory_sweep.h"

#include <algorithm>
#include <string>
#include <vector>

using fx::test::kFrame;
using fx::test::refuseEach;

namespace {

class MemorySweep : public ::testing::Test
{
protected:
    MemorySweep()
    {
        contextDef_.allocator = memory_.hooks();
        contextDef_.workers = 1;
        EXPECT_EQ(fxCreateContext(&contextDef_, &context_), FX_OK);
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK);
    }
    ~MemorySweep() override
    {
        EXPECT_EQ(fxDestroyContext(context_), FX_OK);
        EXPECT_EQ(memory_.blocks(), 0);
    }

    FxInstanceDef instanceOf(const char* preset)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        EXPECT_EQ(fxLoadPresetLibrary(context_, preset, &def.preset), FX_OK) << fxGetLastErrorMessage();
        return def;
    }
    FxInstanceId add(const char* preset)
    {
        const FxInstanceDef def = instanceOf(preset);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    void play(int frames)
    {
        for (int frame = 0; frame < frames; ++frame)
            ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
    }
    uint64_t hash() const
    {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene_, &hash), FX_OK) << fxGetLastErrorMessage();
        return hash;
    }
    std::vector<std::byte> state() const
    {
        size_t size = 0;
        EXPECT_EQ(fxScene_SaveState(scene_, nullptr, 0, &size), FX_OK);
        std::vector<std::byte> state(size);
        EXPECT_EQ(fxScene_SaveState(scene_, state.data(), size, &size), FX_OK);
        return state;
    }
    FxSceneStatistics statistics() const
    {
        FxSceneStatistics statistics{};
        statistics.structSize = sizeof statistics;
        EXPECT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_OK);
        return statistics;
    }
    /// Sweeps over a call that leaves the scene, counters and identities included, as it is while it fails.
    template <class Action>
    void sweep(Action&& action)
    {
        const std::vector<std::byte> before = state();
        EXPECT_GT(refuseEach(memory_, action, [&] { return state() == before; }), 0u);
    }
    /// The same over a call that may divide simulations that instances share, without changing results.
    template <class Action>
    uint64_t sweepChange(Action&& action)
    {
        const uint64_t before = hash();
        return refuseEach(memory_, action, [&] { return hash() == before; });
    }

    fx::test::ScarceMemory memory_;
    FxContextDef contextDef_ = fxDefaultContextDef();
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
};

} // namespace

TEST_F(MemorySweep, contextsAndScenesAreCreatedOrNot)
{
    FxContext* context = nullptr;
    const int64_t before = memory_.blocks();
    EXPECT_GT(refuseEach(
                  memory_, [&] { return fxCreateContext(&contextDef_, &context); },
                  [&] { return context == nullptr && memory_.blocks() == before; }),
              0u);
    ASSERT_EQ(fxDestroyContext(context), FX_OK);
    FxScene* scene = nullptr;
    const FxSceneDef def = fxDefaultSceneDef();
    EXPECT_GT(
        refuseEach(
            memory_, [&] { return fxCreateScene(context_, &def, &scene); }, [&] { return scene == nullptr; }),
        0u);
}

TEST_F(MemorySweep, instancesAreCreatedOrTheSceneIsAsItWas)
{
    (void)add("sparks");
    const FxInstanceId gone = add("sparks");
    play(3);
    ASSERT_EQ(fxScene_DestroyInstance(scene_, gone), FX_OK); // its index is given out again
    for (const char* preset : {fx::test::kLargeEffect, "fireworks", "debris", "smoke-column"})
        for (const int64_t delay : {int64_t(0), int64_t(FX_TICKS_PER_SECOND)}) {
            SCOPED_TRACE(preset);
            FxInstanceDef def = instanceOf(preset);
            def.startTick = statistics().simulatedTick + delay;
            FxInstanceId id{};
            sweep([&] { return fxScene_CreateInstance(scene_, &def, &id); });
            EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
        }
    play(2);
}

TEST_F(MemorySweep, identitiesAreThoseOfAHostWithMemory)
{
    FxScene* other = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &other), FX_OK);
    const FxInstanceDef def = instanceOf("rain");
    for (int i = 0; i < 3; ++i) {
        FxInstanceId id{};
        sweep([&] { return fxScene_CreateInstance(scene_, &def, &id); });
        ASSERT_EQ(fxScene_CreateInstance(other, &def, &id), FX_OK);
    }
    uint64_t wanted = 0;
    ASSERT_EQ(fxScene_GetSimulationHash(other, &wanted), FX_OK);
    EXPECT_EQ(hash(), wanted);
}

TEST_F(MemorySweep, presetsAreLoadedOrNot)
{
    FxMemoryStats stats{};
    stats.structSize = sizeof stats;
    ASSERT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
    uint32_t loaded = stats.presets;
    for (const std::string& name : fx::test::libraryNames()) {
        SCOPED_TRACE(name);
        FxPresetId preset{};
        (void)refuseEach(
            memory_, [&] { return fxLoadPresetLibrary(context_, name.c_str(), &preset); },
            [&] {
                EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
                return stats.presets == loaded;
            });
        ASSERT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
        EXPECT_GT(stats.presets, loaded);
        loaded = stats.presets;
    }
}

TEST_F(MemorySweep, anUpdateTakesItsTimeAndTheNextOneWorks)
{
    for (const char* preset : {fx::test::kLargeEffect, "fireworks", "debris"})
        (void)add(preset);
    uint64_t failures = 0;
    for (const int frames : {0, 20}) {
        play(frames);
        const std::vector<std::byte> before = state();
        const auto update = [&] {
            const int64_t begun = statistics().simulatedTick;
            const FxResult result = fxScene_Update(scene_, kFrame);
            EXPECT_EQ(statistics().simulatedTick - begun, FX_TICKS_PER_SECOND / 60);
            return result;
        };
        const auto goesOn = [&] {
            return fxScene_Update(scene_, kFrame) == FX_OK &&
                   fxScene_RestoreState(scene_, before.data(), before.size()) == FX_OK;
        };
        failures += refuseEach(memory_, update, goesOn);
    }
    EXPECT_GT(failures, 0u);
}

TEST_F(MemorySweep, statesAreSavedAndRestoredOrTheSceneIsAsItWas)
{
    for (const char* preset : {fx::test::kLargeEffect, "fireworks", "burning-debris"})
        (void)add(preset);
    play(10);
    std::vector<std::byte> saved = state();
    size_t size = 0;
    sweep([&] { return fxScene_SaveState(scene_, saved.data(), saved.size(), &size); });
    EXPECT_EQ(size, saved.size());
    const uint64_t then = hash();
    play(5);
    sweep([&] { return fxScene_RestoreState(scene_, saved.data(), saved.size()); });
    EXPECT_EQ(hash(), then);
    EXPECT_TRUE(state() == saved);
}

TEST_F(MemorySweep, instancesAreChangedOrTheSceneIsAsItWas)
{
    const float rotation[4] = {0, 0, 0, 1};
    uint64_t allocations = 0;
    for (const char* preset : {fx::test::kLargeEffect, "fireworks", "magic-trail"}) {
        SCOPED_TRACE(preset);
        (void)add(preset); // shares a simulation with the next
        const FxInstanceId id = add(preset);
        play(20);
        for (const double seconds : {0.5, 0.1}) { // onwards and back
            SCOPED_TRACE(seconds);
            EXPECT_GT(sweepChange([&] { return fxScene_SeekInstance(scene_, id, seconds); }), 0u);
        }
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        parameters.wind[0] = 2.0f;
        const double position[3] = {1, 2, 3};
        sweepChange([&] { return fxScene_SetParameters(scene_, id, &parameters); });
        sweepChange([&] { return fxScene_SetTransform(scene_, id, position, rotation, 2.0f); });
        sweepChange([&] { return fxScene_SetInstanceSpeed(scene_, id, 0.5f); });
        FxMotion motion = fxDefaultMotion();
        motion.aheadSeconds = 0.5;
        allocations += sweepChange([&] { return fxScene_SetMotion(scene_, id, &motion); });
        play(2);
    }
    EXPECT_GT(allocations, 0u); // the list of motions grows now and then
}

TEST_F(MemorySweep, instancesAreReservedOrTheReservationIsAsItWas)
{
    FxReservationInfo info{};
    info.structSize = sizeof info;
    for (const char* preset : {fx::test::kLargeEffect, "fireworks"}) {
        SCOPED_TRACE(preset);
        const FxPresetId id = instanceOf(preset).preset;
        (void)add(preset);
        play(3);
        const std::vector<std::byte> before = state();
        int64_t failures = 0, most = 0;
        const int64_t start = memory_.blocks();
        for (uint64_t n = 1;; n = fx::test::nextRefused(n)) {
            bool isDone = false;
            for (int attempt = 0; attempt < 6 && !isDone; ++attempt) {
                memory_.refuse(n, attempt % 2 == 1);
                const FxResult result = fxScene_ReservePreset(scene_, id, 0, 2);
                isDone = result == FX_OK;
                memory_.refuse(0, false);
                ASSERT_TRUE(isDone || result == FX_ERROR_OUT_OF_MEMORY) << fxGetLastErrorMessage();
                failures += isDone ? 0 : 1;
                most = std::max(most, isDone ? 0 : memory_.blocks());
                ASSERT_EQ(fxScene_GetReservation(scene_, id, 0, &info), FX_OK);
                ASSERT_EQ(info.count, isDone ? 2u : 0u) << "request " << n;
                ASSERT_EQ(state(), before) << "request " << n;
            }
            if (isDone)
                break;
        }
        EXPECT_GT(failures, 100);
        EXPECT_LT(most - start, failures / 2); // room of snapshots is kept, but not added to by each failure
        play(2);
    }
}

TEST_F(MemorySweep, aReservationIsRaisedOrStaysWhole)
{
    FxReservationInfo info{};
    info.structSize = sizeof info;
    const FxInstanceDef def = instanceOf("fireworks");
    ASSERT_EQ(fxScene_ReservePreset(scene_, def.preset, 0, 2), FX_OK);
    uint64_t failures = 0;
    for (uint64_t n = 1;; n = fx::test::nextRefused(n)) {
        memory_.refuse(n, n % 2 == 1);
        const FxResult result = fxScene_ReservePreset(scene_, def.preset, 0, 4);
        memory_.refuse(0, false);
        ASSERT_EQ(fxScene_GetReservation(scene_, def.preset, 0, &info), FX_OK);
        ASSERT_EQ(info.count, result == FX_OK ? 4u : 2u) << "request " << n;
        ASSERT_EQ(info.available, info.count) << "request " << n;
        if (result == FX_OK)
            break;
        ASSERT_EQ(result, FX_ERROR_OUT_OF_MEMORY) << fxGetLastErrorMessage();
        ++failures;
    }
    EXPECT_GT(failures, 50u);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    play(2);
}

TEST_F(MemorySweep, aStateIsRestoredOrTheReservationStaysWhole)
{
    FxReservationInfo info{};
    info.structSize = sizeof info;
    const FxInstanceDef def = instanceOf("fireworks");
    ASSERT_EQ(fxScene_ReservePreset(scene_, def.preset, 0, 3), FX_OK);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    play(3);
    const std::vector<std::byte> one = state();
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    play(3);
    const std::vector<std::byte> before = state();
    const auto available = [&] {
        EXPECT_EQ(fxScene_GetReservation(scene_, def.preset, 0, &info), FX_OK);
        return info.available;
    };
    EXPECT_EQ(available(), 1u);
    EXPECT_GT(refuseEach(
                  memory_, [&] { return fxScene_RestoreState(scene_, one.data(), one.size()); },
                  [&] { return available() == 1 && state() == before; }),
              0u);
    EXPECT_EQ(available(), 2u);
    EXPECT_EQ(fxScene_DestroyInstance(scene_, id), FX_ERROR_STALE_ID);
    ASSERT_EQ(fxScene_DestroyAllInstances(scene_), FX_OK);
    EXPECT_EQ(available(), 3u);
}

TEST_F(MemorySweep, aRedirectedReservationIsMadeByALaterUpdateIfMemoryRunsOut)
{
    FxReservationInfo info{};
    info.structSize = sizeof info;
    const FxPresetId contents[2] = {instanceOf("sparks").preset, instanceOf("campfire").preset};
    const FxPresetId preset = instanceOf("fireworks").preset;
    ASSERT_EQ(fxScene_ReservePreset(scene_, preset, 0, 2), FX_OK);
    uint64_t failures = 0;
    for (uint64_t n = 1; n < 10'000; n = fx::test::nextRefused(n)) {
        ASSERT_EQ(fxRedirectPreset(context_, preset, contents[n % 2]), FX_OK) << fxGetLastErrorMessage();
        memory_.refuse(n, true);
        const FxResult result = fxScene_Update(scene_, kFrame);
        const bool hasRefused = memory_.hasRefused();
        memory_.refuse(0, false);
        ASSERT_TRUE(result == FX_OK || result == FX_ERROR_OUT_OF_MEMORY) << fxGetLastErrorMessage();
        failures += result == FX_OK ? 0 : 1;
        play(1);
        ASSERT_EQ(fxScene_GetReservation(scene_, preset, 0, &info), FX_OK);
        ASSERT_EQ(info.count, 2u) << "request " << n;
        ASSERT_EQ(info.available, 2u) << "request " << n;
        if (!hasRefused)
            break;
    }
    EXPECT_GT(failures, 20u);
}
