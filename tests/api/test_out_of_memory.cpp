#include "tests/api/event_presets.h"

#include <algorithm>
#include <string>

using fx::test::burstPreset;
using fx::test::fountainPreset;
using fx::test::HostAllocator;
using fx::test::kFrame;
using fx::test::loadText;

namespace {

constexpr uint64_t kMaxAllocations = 10'000;

/// Calls `action` with the first, the second, ... allocation failing until none fails any more.
/// @param action returns its result; after FX_ERROR_OUT_OF_MEMORY everything must be as before
/// @return how many allocations there were to fail
template <class F>
uint64_t sweep(HostAllocator& memory, F&& action)
{
    for (uint64_t n = 1; n < kMaxAllocations; ++n) {
        const int64_t before = memory.blocks();
        memory.failFrom(n);
        const FxResult result = action();
        memory.failFrom(0);
        if (result == FX_OK)
            return n - 1;
        EXPECT_EQ(result, FX_ERROR_OUT_OF_MEMORY) << "allocation " << n << ": " << fxGetLastErrorMessage();
        EXPECT_LE(memory.blocks(), before + 4) << "allocation " << n; // tables may have grown, nothing else
    }
    ADD_FAILURE() << "it never succeeded";
    return 0;
}

/// A host whose memory runs out, and that has all of it back at the end of a test.
class OutOfMemory : public testing::Test
{
protected:
    OutOfMemory()
    {
        def_.allocator = memory_.hooks();
        def_.workers = 1;
    }
    void TearDown() override
    {
        EXPECT_EQ(fxDestroyContext(context_), FX_OK);
        EXPECT_EQ(memory_.blocks(), 0);
    }
    void createContext() { ASSERT_EQ(fxCreateContext(&def_, &context_), FX_OK); }
    void createScene()
    {
        const FxSceneDef def = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &def, &scene_), FX_OK);
    }

    HostAllocator memory_;
    FxContextDef def_ = fxDefaultContextDef();
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
};

} // namespace

TEST_F(OutOfMemory, creatingAContextFailsCleanlyAtEveryAllocation)
{
    EXPECT_GT(sweep(memory_,
                    [&] {
                        const FxResult result = fxCreateContext(&def_, &context_);
                        if (result != FX_OK) {
                            EXPECT_EQ(context_, nullptr);
                            EXPECT_EQ(memory_.blocks(), 0);
                        }
                        return result;
                    }),
              0u);
}

TEST_F(OutOfMemory, presetsScenesAndInstancesFailCleanlyAtEveryAllocationAndTheNextCallWorks)
{
    createContext();
    const std::string text = burstPreset(200, 1.0);
    FxPresetId preset{};
    EXPECT_GT(sweep(memory_,
                    [&] { return fxLoadPresetText(context_, text.data(), text.size(), nullptr, &preset); }),
              0u);

    const FxSceneDef sceneDef = fxDefaultSceneDef();
    EXPECT_GT(sweep(memory_, [&] { return fxCreateScene(context_, &sceneDef, &scene_); }), 0u);

    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    instanceDef.preset = preset;
    FxSceneStatistics statistics{};
    statistics.structSize = sizeof statistics;
    FxInstanceId id{};
    for (const int64_t start : {int64_t(0), FX_TICKS_PER_SECOND}) {
        instanceDef.startTick = start;
        ASSERT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_OK);
        const uint32_t before = statistics.instances;
        EXPECT_GT(sweep(memory_,
                        [&] {
                            const FxResult result = fxScene_CreateInstance(scene_, &instanceDef, &id);
                            EXPECT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_OK);
                            EXPECT_EQ(statistics.instances, before + (result == FX_OK ? 1 : 0));
                            return result;
                        }),
                  0u);
        EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
    }
    for (int frame = 0; frame < 90; ++frame)
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
}

TEST_F(OutOfMemory, leavingASharedSimulationSavingAndRestoringFailCleanlyAtEveryAllocation)
{
    createContext();
    createScene();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    instanceDef.preset = loadText(context_, fx::test::smallBlastPreset());
    FxInstanceId first{}, second{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &instanceDef, &first), FX_OK);
    instanceDef.position[0] = 1.0; // geometry parts them
    ASSERT_EQ(fxScene_CreateInstance(scene_, &instanceDef, &second), FX_OK);
    for (int frame = 0; frame < 10; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);

    /// Sweeps over an action that must change nothing while it fails.
    const auto sweepUnchanged = [&](auto&& action) {
        uint64_t before = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene_, &before), FX_OK);
        EXPECT_GT(sweep(memory_,
                        [&] {
                            const FxResult result = action();
                            memory_.failFrom(0);
                            uint64_t after = 0;
                            EXPECT_EQ(fxScene_GetSimulationHash(scene_, &after), FX_OK);
                            if (result != FX_OK) {
                                EXPECT_EQ(after, before);
                            }
                            return result;
                        }),
                  0u);
    };
    std::vector<std::byte> state(1 << 20);
    size_t size = 0;
    sweepUnchanged([&] { return fxScene_SaveState(scene_, state.data(), state.size(), &size); });
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.wind[0] = 2.0f;
    sweepUnchanged([&] { return fxScene_SetParameters(scene_, second, &parameters); });
    sweepUnchanged([&] { return fxScene_RestoreState(scene_, state.data(), size); });
    EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    const float corners[9] = {2, -3, -3, 2, 3, -3, 2, 0, 3};
    FxCollisionMesh mesh = fxDefaultCollisionMesh();
    mesh.positions = corners;
    mesh.vertexCount = 3;
    mesh.cellSize = 0.5f;
    sweepUnchanged([&] { return fxScene_SetCollisionMesh(scene_, &mesh); });
}

TEST_F(OutOfMemory, anUpdateWithoutMemoryStillTakesItsStepsAndRecovers)
{
    createContext();
    createScene();
    FxInstanceDef instanceDef = fxDefaultInstanceDef();
    instanceDef.preset = loadText(context_, fountainPreset());
    FxInstanceId awake{}, late{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &instanceDef, &awake), FX_OK);
    instanceDef.startTick = FX_TICKS_PER_SECOND / 60 * 2;
    ASSERT_EQ(fxScene_CreateInstance(scene_, &instanceDef, &late), FX_OK);

    memory_.failFrom(1);
    EXPECT_EQ(fxScene_Update(scene_, 4 * kFrame), FX_ERROR_OUT_OF_MEMORY); // no room for the first snapshots
    EXPECT_TRUE(memory_.hasFailed());
    memory_.failFrom(0);
    FxSceneStatistics statistics{};
    statistics.structSize = sizeof statistics;
    ASSERT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_OK);
    EXPECT_EQ(statistics.simulatedTick, FX_TICKS_PER_SECOND / 15);
    EXPECT_EQ(statistics.wakeFailures, 1u);
    FxInstanceState state{};
    ASSERT_EQ(fxScene_GetInstanceState(scene_, late, &state, nullptr), FX_OK);
    EXPECT_EQ(state, FX_INSTANCE_FINISHED);

    EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
    uint32_t particles = 0;
    ASSERT_EQ(fxScene_GetInstanceState(scene_, awake, &state, &particles), FX_OK);
    EXPECT_GT(particles, 0u);
}

namespace {

/// A floor at y = -1 of the world.
int meetFloor(void*, const double from[3], const double to[3], float* outShare, float outNormal[3])
{
    if (to[1] >= -1.0 || from[1] < to[1])
        return 0;
    *outShare = from[1] > -1.0 ? float((from[1] + 1.0) / (from[1] - to[1])) : 0.0f;
    outNormal[0] = outNormal[2] = 0.0f;
    outNormal[1] = 1.0f;
    return 1;
}

/// Hail at two places that shares a simulation, until something is in its way.
FxScene* makeHail(FxContext* context)
{
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    EXPECT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = loadText(context, R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64,
        "shape": "disc", "size": 1, "emission": {"rate": 60}, "lifetime": 9, "radius": 0.01,
        "appearance": {"kind": "sprite"}, "collisions": [{"shape": "hook", "bounce": 0.5}]}]})");
    for (const double y : {0.0, 1.0}) {
        def.position[1] = y;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
    }
    for (int frame = 0; frame < 10; ++frame)
        EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    return scene;
}

uint64_t hashOf(FxScene* scene)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK) << fxGetLastErrorMessage();
    return hash;
}

} // namespace

TEST_F(OutOfMemory, aContactHookIsSetOrTheSceneIsAsItWasAtEveryAllocation)
{
    createContext();
    FxScene *scene = makeHail(context_), *other = makeHail(context_);
    FxContactHook hook = fxDefaultContactHook();
    hook.meet = &meetFloor;
    ASSERT_EQ(fxScene_SetContactHook(other, &hook), FX_OK);
    const uint64_t before = hashOf(scene);
    EXPECT_GT(sweep(memory_,
                    [&] {
                        const FxResult result = fxScene_SetContactHook(scene, &hook);
                        memory_.failFrom(0);
                        EXPECT_EQ(hashOf(scene), before);
                        return result;
                    }),
              0u); // what they shared is copied
    for (int frame = 0; frame < 60; ++frame)
        for (FxScene* each : {scene, other})
            ASSERT_EQ(fxScene_Update(each, kFrame), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(hashOf(scene), hashOf(other));
}

TEST_F(OutOfMemory, theEmitterThatDoesNotFitIsNamedWithItsBytesAndTheRemedy)
{
    createContext();
    createScene();
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = loadText(context_, R"({"version":1,"emitters":[{"name":"embers","maxParticles":100000,
        "emission":{"rate":1},"trail":{"lifetime":1}}]})");
    memory_.failFrom(1);
    FxInstanceId instance{};
    EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &instance), FX_ERROR_OUT_OF_MEMORY);
    uint64_t tries = 1; // tables may come first
    while (std::string(fxGetLastErrorMessage()).find("embers") == std::string::npos && ++tries < 100) {
        memory_.failFrom(tries);
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &instance), FX_ERROR_OUT_OF_MEMORY);
    }
    memory_.failFrom(0);
    const std::string message = fxGetLastErrorMessage();
    EXPECT_NE(message.find("\"embers\", whose maxParticles 100000 take"), std::string::npos) << message;
    EXPECT_NE(message.find("lower maxParticles or maxPoints of its trail"), std::string::npos) << message;
}

TEST_F(OutOfMemory, eventsOfAStepThatWasDroppedAreCountedAsLost)
{
    // the first instance has events in a step, in which the second one may find no memory
    const auto play = [&](int frames, uint64_t failing, uint64_t& outLost) {
        createContext();
        FxSceneDef sceneDef = fxDefaultSceneDef();
        sceneDef.eventCapacity = 2000;
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK);
        FxInstanceDef def = fxDefaultInstanceDef();
        for (const std::string& preset : {fx::test::kDrop, fx::test::kSparks}) {
            def.preset = loadText(context_, preset);
            FxInstanceId id{};
            EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        }
        for (int frame = 1; frame < frames; ++frame)
            EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        memory_.failFrom(failing);
        const FxResult result = fxScene_Update(scene_, kFrame);
        memory_.failFrom(0);
        EXPECT_TRUE(result == FX_OK || result == FX_ERROR_OUT_OF_MEMORY);
        uint32_t count = 0;
        EXPECT_EQ(fxScene_GetEvents(scene_, nullptr, 0, &count, &outLost), FX_OK);
        EXPECT_EQ(fxDestroyContext(context_), FX_OK);
        context_ = nullptr;
        return count;
    };
    uint64_t mostLost = 0;
    for (int frames = 1; frames < 40 && mostLost == 0; ++frames) {
        uint64_t lost = 0, none = 0;
        const uint32_t expected = play(frames, 0, none);
        EXPECT_EQ(none, 0u);
        for (uint64_t failing = 1; failing < 40 && lost == 0; ++failing) {
            const uint32_t got = play(frames, failing, lost);
            EXPECT_LE(got + lost, expected) << frames << " " << failing;
        }
        mostLost = lost;
    }
    EXPECT_GT(mostLost, 0u);
}
