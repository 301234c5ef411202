// Reserved instances: created, updated and destroyed without any allocation, with the results of others.
#include "tests/api/api_fixture.h"
#include "tests/api/counting_new.h"
#include "tests/api/memory_sweep.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

using fx::test::kFrame;
using fx::test::newCalls;

constexpr uint32_t kCount = 4;

/// Sparks that burst into smoke, in two emitters that events connect.
std::string linkedPreset()
{
    return R"({"version": 1, "name": "linked", "ground": false, "emitters": [
        {"name": "shells", "maxParticles": 64, "emission": {"rate": 60}, "lifetime": 0.3, "speed": 3,
         "radius": 0.05, "events": [{"on": "death", "emit": "smoke", "count": 4}]},
        {"name": "smoke", "maxParticles": 1024, "lifetime": 0.6, "radius": 0.1}]})";
}

class ReserveApi : public fx::test::ApiTest
{
protected:
    FxPresetId load(const std::string& preset) const
    {
        if (preset.starts_with("{"))
            return fx::test::loadText(context_, preset);
        FxPresetId id{};
        EXPECT_EQ(fxLoadPresetLibrary(context_, preset.c_str(), &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    FxScene* makeScene(uint64_t limit = fxDefaultSceneDef().reserveLimit) const
    {
        FxSceneDef def = fxDefaultSceneDef();
        def.quality = FX_QUALITY_LOW; // of gases, for the time of the test
        def.reserveLimit = limit;
        FxScene* scene = nullptr;
        EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        return scene;
    }
    static FxInstanceId create(FxScene* scene, FxPresetId preset, uint64_t seed)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset;
        def.seed = seed;
        def.position[0] = double(seed);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    /// Creates, updates and destroys up to kCount instances, over and over.
    /// @return number of allocations, of the host's allocator and of the C++ runtime
    static uint64_t cycle(FxScene* scene, FxPresetId preset, int cycles,
                          std::vector<uint64_t>* outHashes = nullptr)
    {
        FxInstanceId ids[kCount]{};
        const uint64_t before = newCalls();
        for (int i = 0; i < cycles; ++i) {
            FxInstanceId& id = ids[size_t(i) % kCount];
            if (id.bits != 0) {
                EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
            }
            id = create(scene, preset, uint64_t(i % 7));
            for (int step = 0; step < 3; ++step)
                EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK) << fxGetLastErrorMessage();
            uint64_t hash = 0;
            if (outHashes) {
                EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK);
                outHashes->push_back(hash);
            }
        }
        const uint64_t calls = newCalls() - before;
        for (const FxInstanceId id : ids)
            EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
        return calls;
    }
    static FxReservationInfo info(FxScene* scene, FxPresetId preset)
    {
        FxReservationInfo found{};
        found.structSize = sizeof found;
        EXPECT_EQ(fxScene_GetReservation(scene, preset, FX_QUALITY_DEFAULT, &found), FX_OK)
            << fxGetLastErrorMessage();
        return found;
    }
    static FxResult reserve(FxScene* scene, FxPresetId preset, uint32_t count)
    {
        return fxScene_ReservePreset(scene, preset, FX_QUALITY_DEFAULT, count);
    }
    uint64_t reservedBytes() const
    {
        FxMemoryStats stats{};
        stats.structSize = sizeof stats;
        EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
        return stats.bytesReserved;
    }
    static std::vector<std::byte> stateOf(FxScene* scene)
    {
        size_t size = 0;
        EXPECT_EQ(fxScene_SaveState(scene, nullptr, 0, &size), FX_OK);
        std::vector<std::byte> state(size);
        EXPECT_EQ(fxScene_SaveState(scene, state.data(), size, &size), FX_OK);
        return state;
    }
    static uint64_t hashOf(FxScene* scene)
    {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK);
        return hash;
    }
};

const std::vector<std::string>& presets()
{
    static const std::vector<std::string> all = {
        "campfire",     "sparks",    fx::test::kHasGas ? "explosion" : "debris",
        linkedPreset(), "fireworks", "stratus-bank"};
    return all;
}

} // namespace

TEST_F(ReserveApi, instancesAllocateNothing)
{
    for (const std::string& name : presets()) {
        const std::string shown = name.starts_with("{") ? "linked emitters" : name;
        SCOPED_TRACE(shown);
        const FxPresetId preset = load(name);
        FxScene* const scene = makeScene();
        const uint64_t before = bytesInUse();
        ASSERT_EQ(reserve(scene, preset, kCount), FX_OK) << fxGetLastErrorMessage();
        const uint64_t bytes = bytesInUse() - before;
        const uint64_t reserved = cycle(scene, preset, 200);
        FxScene* const other = makeScene();
        const uint64_t control = cycle(other, preset, 20);
        std::printf("%-16s %u reserved, %llu KiB (estimate %llu): %llu allocations in 200 cycles, %llu in 20 "
                    "without\n",
                    shown.c_str(), kCount, static_cast<unsigned long long>(bytes >> 10),
                    static_cast<unsigned long long>(info(scene, preset).bytes >> 10),
                    static_cast<unsigned long long>(reserved), static_cast<unsigned long long>(control));
        EXPECT_EQ(reserved, 0u);
        EXPECT_GT(control, 100u);
        EXPECT_EQ(info(scene, preset).misses, 0u);
        EXPECT_EQ(info(scene, preset).available, kCount);
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
        ASSERT_EQ(fxDestroyScene(other), FX_OK);
    }
}

TEST_F(ReserveApi, instancesOfAllReservationsAllocateNothingTogether)
{
    const FxPresetId few = load("campfire"), many = load("sparks");
    constexpr uint64_t kMany = 32;
    FxScene* const scene = makeScene();
    ASSERT_EQ(reserve(scene, few, kCount), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(reserve(scene, many, kMany), FX_OK) << fxGetLastErrorMessage();
    FxInstanceId ids[kCount + kMany]{};
    for (int round = 0; round < 3; ++round) {
        const uint64_t before = newCalls();
        for (uint64_t i = 0; i < kCount + kMany; ++i)
            ids[i] = create(scene, i < kCount ? few : many, i);
        for (int step = 0; step < 3; ++step)
            EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK) << fxGetLastErrorMessage();
        for (const FxInstanceId id : ids)
            EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
        EXPECT_EQ(newCalls() - before, 0u) << round;
    }
    EXPECT_EQ(info(scene, few).misses + info(scene, many).misses, 0u);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(ReserveApi, aRestoredStateLeavesTheReservationWhole)
{
    for (const std::string& name : presets()) {
        SCOPED_TRACE(name);
        const FxPresetId preset = load(name);
        FxScene* const scene = makeScene();
        const std::vector<std::byte> empty = stateOf(scene);
        ASSERT_EQ(reserve(scene, preset, kCount), FX_OK) << fxGetLastErrorMessage();
        std::vector<FxInstanceId> ids;
        for (uint64_t i = 0; i < kCount; ++i)
            ids.push_back(create(scene, preset, i));
        ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
        const std::vector<std::byte> full = stateOf(scene);
        for (int round = 0; round < 3; ++round) {
            ASSERT_EQ(fxScene_RestoreState(scene, full.data(), full.size()), FX_OK)
                << fxGetLastErrorMessage();
            EXPECT_EQ(info(scene, preset).count, kCount);
            EXPECT_EQ(info(scene, preset).available, 0u); // restored instances count
            for (int step = 0; step < 2; ++step)
                ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
            ASSERT_EQ(fxScene_RestoreState(scene, empty.data(), empty.size()), FX_OK)
                << fxGetLastErrorMessage();
            EXPECT_EQ(info(scene, preset).available, kCount);
            EXPECT_EQ(cycle(scene, preset, 40), 0u) << round;
        }
        ASSERT_EQ(fxScene_RestoreState(scene, full.data(), full.size()), FX_OK);
        for (const FxInstanceId id : ids)
            ASSERT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
        EXPECT_EQ(info(scene, preset).available, kCount);
        EXPECT_EQ(info(scene, preset).misses, 0u);
        EXPECT_EQ(cycle(scene, preset, 40), 0u);
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    }
}

TEST_F(ReserveApi, callsThatAddNoSetKeepTheRoomInSnapshots)
{
    const FxPresetId preset = load("campfire"), other = load("sparks");
    FxScene* const scene = makeScene();
    ASSERT_EQ(reserve(scene, other, 8), FX_OK);
    ASSERT_EQ(reserve(scene, preset, kCount), FX_OK);
    FxInstanceId ids[kCount]{};
    for (uint64_t i = 0; i < kCount; ++i)
        ids[i] = create(scene, preset, i);
    ASSERT_EQ(reserve(scene, preset, kCount), FX_OK); // before snapshots have the instances
    ASSERT_EQ(reserve(scene, other, 4), FX_OK);
    const uint64_t before = newCalls();
    for (int step = 0; step < 6; ++step)
        EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    for (const FxInstanceId id : ids)
        EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
    EXPECT_EQ(newCalls() - before, 0u);
    EXPECT_EQ(cycle(scene, other, 20), 0u);
    EXPECT_EQ(cycle(scene, preset, 20), 0u);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(ReserveApi, resultsAndStatesAreThoseOfOtherInstances)
{
    for (const std::string& name : presets()) {
        SCOPED_TRACE(name);
        const FxPresetId preset = load(name);
        FxScene* const scene = makeScene();
        FxScene* const other = makeScene();
        ASSERT_EQ(reserve(scene, preset, kCount), FX_OK);
        std::vector<uint64_t> hashes, wanted;
        cycle(scene, preset, 20, &hashes);
        cycle(other, preset, 20, &wanted);
        EXPECT_EQ(hashes, wanted);
        create(scene, preset, 3);
        create(other, preset, 3);
        for (int i = 0; i < 10; ++i) {
            ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
            ASSERT_EQ(fxScene_Update(other, kFrame), FX_OK);
        }
        EXPECT_EQ(hashOf(scene), hashOf(other));
        const std::vector<std::byte> state = stateOf(scene);
        ASSERT_EQ(fxScene_RestoreState(other, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(hashOf(other), hashOf(scene));
        ASSERT_EQ(fxScene_RestoreState(scene, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(hashOf(other), hashOf(scene));
        EXPECT_EQ(info(scene, preset).count, kCount); // a state has no reservations
        ASSERT_EQ(fxDestroyScene(scene), FX_OK);
        ASSERT_EQ(fxDestroyScene(other), FX_OK);
    }
}

TEST_F(ReserveApi, memoryIsCountedAndFreed)
{
    const FxPresetId preset = load("campfire");
    FxScene* const scene = makeScene();
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    const uint64_t before = bytesInUse();
    ASSERT_EQ(reserve(scene, preset, 16), FX_OK) << fxGetLastErrorMessage();
    const uint64_t used = bytesInUse() - before, counted = info(scene, preset).bytes;
    EXPECT_EQ(reservedBytes(), counted);
    EXPECT_LT(counted, 2 * used); // the estimate of FxPresetInfo
    EXPECT_LT(used, 2 * counted);
    ASSERT_EQ(reserve(scene, preset, 8), FX_OK);
    EXPECT_EQ(reservedBytes(), counted / 2);
    EXPECT_LT(bytesInUse() - before, used * 3 / 4);
    const FxInstanceId id = create(scene, preset, 1);
    EXPECT_EQ(info(scene, preset).available, 7u);
    ASSERT_EQ(reserve(scene, preset, 8), FX_OK); // of which one is in use
    EXPECT_EQ(info(scene, preset).available, 7u);
    ASSERT_EQ(reserve(scene, preset, 0), FX_OK);
    EXPECT_EQ(reservedBytes(), 0u);
    EXPECT_EQ(info(scene, preset).count, 0u);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK); // the instance goes on
    ASSERT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
    EXPECT_LT(bytesInUse() - before, used / 4);
    ASSERT_EQ(reserve(scene, preset, 16), FX_OK);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
    EXPECT_EQ(reservedBytes(), 0u);
}

TEST_F(ReserveApi, instancesBeyondTheReservationAreCounted)
{
    const FxPresetId preset = load("sparks");
    ASSERT_EQ(reserve(scene_, preset, 2), FX_OK);
    std::vector<FxInstanceId> ids;
    for (uint64_t i = 0; i < 5; ++i)
        ids.push_back(create(scene_, preset, i));
    play(3);
    EXPECT_EQ(info(scene_, preset).misses, 3u);
    EXPECT_EQ(info(scene_, preset).available, 0u);
    for (const FxInstanceId id : ids)
        ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    play(3);
    EXPECT_EQ(info(scene_, preset).available, 2u);
}

TEST_F(ReserveApi, aReservationBeyondTheLimitNamesBytesAndRemedy)
{
    const FxPresetId campfire = load("campfire"), sparks = load("sparks");
    FxScene* const scene = makeScene(8u << 20);
    ASSERT_EQ(reserve(scene, campfire, 1), FX_OK) << fxGetLastErrorMessage();
    const uint64_t before = bytesInUse();
    EXPECT_EQ(reserve(scene, sparks, 60'000), FX_ERROR_CAPACITY);
    const std::string message = fxGetLastErrorMessage();
    EXPECT_NE(message.find("8388608 bytes"), std::string::npos) << message;
    EXPECT_NE(message.find("FxSceneDef::reserveLimit"), std::string::npos) << message;
    EXPECT_LT(bytesInUse(), before + 1024);
    EXPECT_EQ(info(scene, campfire).available, 1u);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(ReserveApi, aRedirectedPresetKeepsItsReservationAndAnUnloadedOneLosesIt)
{
    const FxPresetId preset = load("sparks"), other = load(linkedPreset());
    FxScene* const scene = makeScene();
    ASSERT_EQ(reserve(scene, preset, kCount), FX_OK);
    const FxInstanceId id = create(scene, preset, 1);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    uint32_t replaced = 0;
    ASSERT_EQ(fxScene_ReplacePreset(scene, preset, other, FX_REPLACE_SEEK, &replaced), FX_OK);
    EXPECT_EQ(replaced, 1u);
    EXPECT_EQ(info(scene, preset).count, kCount);
    EXPECT_EQ(info(scene, other).count, 0u);
    ASSERT_EQ(fxRedirectPreset(context_, preset, other), FX_OK);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    EXPECT_EQ(info(scene, preset).count, kCount); // of the new content
    EXPECT_EQ(info(scene, preset).available, kCount - 1);
    ASSERT_EQ(fxScene_DestroyInstance(scene, id), FX_OK);
    EXPECT_EQ(info(scene, preset).available, kCount);
    EXPECT_EQ(cycle(scene, preset, 40), 0u);
    const uint64_t bytes = reservedBytes();
    EXPECT_GT(bytes, 0u);
    ASSERT_EQ(fxUnloadPreset(context_, preset), FX_OK);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    EXPECT_EQ(reservedBytes(), 0u);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(ReserveApi, aPresetRedirectedToAReservedOneAddsItsNumber)
{
    const FxPresetId preset = load("sparks"), other = load(linkedPreset()), last = load("campfire");
    FxScene* const scene = makeScene();
    ASSERT_EQ(reserve(scene, preset, 2), FX_OK);
    ASSERT_EQ(reserve(scene, other, 5), FX_OK);
    ASSERT_EQ(reserve(scene, last, 1), FX_OK);
    ASSERT_EQ(fxRedirectPreset(context_, preset, other), FX_OK);
    ASSERT_EQ(fxRedirectPreset(context_, last, other), FX_OK);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    EXPECT_EQ(info(scene, preset).count, 8u);
    EXPECT_EQ(info(scene, other).available, 8u);
    EXPECT_EQ(reservedBytes(), info(scene, other).bytes);
    ASSERT_EQ(reserve(scene, preset, 3), FX_OK); // its own number
    EXPECT_EQ(info(scene, other).count, 9u);
    ASSERT_EQ(fxUnloadPreset(context_, preset), FX_OK);
    ASSERT_EQ(fxUnloadPreset(context_, last), FX_OK);
    ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    EXPECT_EQ(info(scene, other).count, 5u);
    ASSERT_EQ(reserve(scene, other, 0), FX_OK);
    EXPECT_EQ(reservedBytes(), 0u);
    ASSERT_EQ(fxDestroyScene(scene), FX_OK);
}

TEST_F(ReserveApi, wrongArgumentsAreRefused)
{
    const FxPresetId preset = load("sparks");
    const auto refuse = [&](FxScene* scene, FxPresetId of, uint32_t quality, uint32_t count, FxResult code) {
        EXPECT_EQ(fxScene_ReservePreset(scene, of, quality, count), code) << fxGetLastErrorMessage();
    };
    refuse(nullptr, preset, 0, 1, FX_ERROR_INVALID_ARGUMENT);
    refuse(scene_, FxPresetId{}, 0, 1, FX_ERROR_STALE_ID);
    refuse(scene_, preset, 5, 1, FX_ERROR_INVALID_ARGUMENT);
    refuse(scene_, preset, 0, 65'537, FX_ERROR_INVALID_ARGUMENT);
    FxReservationInfo out{};
    EXPECT_EQ(fxScene_GetReservation(scene_, preset, 0, &out), FX_ERROR_VERSION);
    out.structSize = sizeof out;
    EXPECT_EQ(fxScene_GetReservation(scene_, preset, 5, &out), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetReservation(scene_, FxPresetId{}, 0, &out), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_GetReservation(scene_, preset, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetReservation(scene_, preset, 0, &out), FX_OK);
    EXPECT_EQ(out.count, 0u);
    EXPECT_EQ(reservedBytes(), 0u);
}
