#include "tests/api/api_fixture.h"

#include <atomic>
#include <barrier>
#include <functional>
#include <thread>
#include <vector>

using fx::test::burstPreset;
using fx::test::fountainPreset;
using fx::test::kFrame;
using fx::test::loadText;
using ThreadApi = fx::test::ApiTest;

namespace {

/// What a host's callback does in the middle of a call, once.
struct Intruder
{
    std::function<void()> action;

    void run()
    {
        const std::function<void()> now = std::move(action);
        action = nullptr;
        if (now)
            now();
    }
};

void intrudeInLoop(void* user, uint32_t count, uint32_t, FxLoopBody body, void* argument)
{
    static_cast<Intruder*>(user)->run();
    body(argument, 0, count);
}

const void* intrudeInOpen(void* user, const char*, size_t*)
{
    static_cast<Intruder*>(user)->run();
    return nullptr;
}

template <class F>
void onAnotherThread(F&& body)
{
    std::thread(std::forward<F>(body)).join();
}

/// Every row that is shown lies within the bounds of its group.
void checkRows(FxScene* scene, FxSnapshotId snapshot, FxSnapshotStep step, uint32_t index)
{
    FxSnapshotGroup group{};
    group.structSize = sizeof group;
    ASSERT_EQ(fxScene_GetSnapshotGroup(scene, snapshot, step, index, &group), FX_OK);
    const float* columns[4] = {};
    constexpr const char* kNames[4] = {"x", "y", "z", "radius"};
    for (int c = 0; c < 4; ++c) {
        FxSnapshotColumn column{};
        column.structSize = sizeof column;
        ASSERT_EQ(fxScene_FindSnapshotColumn(scene, snapshot, step, index, kNames[c], &column), FX_OK);
        ASSERT_EQ(column.count, group.count);
        columns[c] = column.values;
    }
    for (uint32_t i = 0; i < group.count; ++i)
        for (int axis = 0; axis < 3 && columns[3][i] > 0.0f; ++axis) {
            ASSERT_GE(columns[axis][i], group.boundsMin[axis]);
            ASSERT_LE(columns[axis][i], group.boundsMax[axis]);
        }
}

/// Looks at both steps of one snapshot after another until `isOver`, and counts them.
void readSnapshots(FxScene* scene, const std::atomic<bool>& isOver, std::atomic<int>& seen)
{
    for (; !isOver; ++seen) {
        FxSnapshotId id{};
        ASSERT_EQ(fxScene_AcquireSnapshot(scene, &id), FX_OK);
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        ASSERT_EQ(fxScene_GetSnapshotInfo(scene, id, &info), FX_OK);
        for (uint32_t g = 0; g < info.groupsNewer; ++g)
            ASSERT_NO_FATAL_FAILURE(checkRows(scene, id, FX_SNAPSHOT_NEWER, g));
        for (uint32_t g = 0; g < info.groupsOlder; ++g)
            ASSERT_NO_FATAL_FAILURE(checkRows(scene, id, FX_SNAPSHOT_OLDER, g));
        ASSERT_EQ(fxScene_ReleaseSnapshot(scene, id), FX_OK);
    }
}

} // namespace

TEST(HostAllocator, countsWhatSeveralThreadsTakeAndReleaseAtOnce)
{
    constexpr int kThreads = 2, kBlocks = 300'000;
    fx::test::HostAllocator memory;
    const FxAllocator hooks = memory.hooks();
    std::barrier together(kThreads);
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t)
        threads.emplace_back([&hooks, &together] {
            together.arrive_and_wait();
            for (int i = 0; i < kBlocks; ++i) {
                void* const kept = hooks.allocate(hooks.user, 16, 16);
                hooks.release(hooks.user, hooks.allocate(hooks.user, 16, 16), 16, 16);
                hooks.release(hooks.user, kept, 16, 16);
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(memory.blocks(), 0);
    EXPECT_EQ(memory.bytes(), 0);
}

TEST_F(ThreadApi, everySceneFunctionRefusesAnotherThread)
{
    const FxInstanceId id = addFountain();
    const FxInstanceDef def = instanceDef();
    onAnotherThread([&] {
        const double position[3] = {0, 0, 0};
        const float rotation[4] = {0, 0, 0, 1};
        const FxInstanceParameters parameters = fxDefaultInstanceParameters();
        FxInstanceId other{};
        FxSceneStatistics statistics{};
        statistics.structSize = sizeof statistics;
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &other), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_DestroyInstance(scene_, id), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_IsValid(scene_, id), 0u);
        EXPECT_EQ(fxScene_GetInstanceState(scene_, id, nullptr, nullptr), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_SetTransform(scene_, id, position, rotation, 1), FX_ERROR_WRONG_THREAD);
        const FxMotion motion = fxDefaultMotion();
        FxReservationInfo reservation{};
        reservation.structSize = sizeof reservation;
        EXPECT_EQ(fxScene_SetMotion(scene_, id, &motion), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_ReservePreset(scene_, def.preset, 0, 2), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetReservation(scene_, def.preset, 0, &reservation), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetStatistics(scene_, &statistics), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxScene_GetStateHash(scene_, &hash), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxDestroyScene(scene_), FX_ERROR_WRONG_THREAD);
    });
    EXPECT_EQ(statistics().steps, 0u);
    EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
}

TEST_F(ThreadApi, aSceneThatWasAdoptedBelongsToItsNewThread)
{
    onAnotherThread([this] {
        ASSERT_EQ(fxScene_AdoptThread(scene_), FX_OK);
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    });
    EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_ERROR_WRONG_THREAD);
    ASSERT_EQ(fxScene_AdoptThread(scene_), FX_OK);
    EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
}

TEST_F(ThreadApi, theMessageOfAThreadIsItsOwn)
{
    EXPECT_EQ(fxScene_Update(scene_, -1.0), FX_ERROR_INVALID_ARGUMENT);
    const std::string mine = fxGetLastErrorMessage();
    onAnotherThread([this] {
        EXPECT_STREQ(fxGetLastErrorMessage(), "");
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_ERROR_WRONG_THREAD);
    });
    EXPECT_EQ(mine, fxGetLastErrorMessage());
}

TEST_F(ThreadApi, presetsLoadOnManyThreadsAtOnceWhileTheSceneRuns)
{
    addFountain();
    std::vector<std::thread> loaders;
    for (int t = 0; t < 3; ++t)
        loaders.emplace_back([this] {
            for (int i = 0; i < 20; ++i) {
                const FxPresetId id = loadText(context_, fountainPreset());
                EXPECT_EQ(fxUnloadPreset(context_, id), FX_OK);
            }
        });
    for (int frame = 0; frame < 200; ++frame)
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    for (std::thread& loader : loaders)
        loader.join();
}

TEST_F(ThreadApi, presetsLoadOnWorkersWhileOthersPollAndCancelThem)
{
    addFountain();
    constexpr int kLoads = 24;
    std::vector<FxPresetLoad*> loads(kLoads);
    for (FxPresetLoad*& load : loads)
        ASSERT_EQ(fxBeginPresetLoad(context_, "library:debris", nullptr, 0, &load), FX_OK);
    std::atomic<size_t> next{0};
    std::vector<std::thread> workers;
    for (int t = 0; t < 2; ++t)
        workers.emplace_back([&] {
            for (size_t i = next++; i < loads.size(); i = next++) {
                const FxResult result = fxPresetLoad_Run(loads[i]);
                EXPECT_TRUE(result == FX_OK || result == FX_ERROR_INTERRUPTED) << fxGetLastErrorMessage();
            }
        });
    std::vector<float> last(loads.size());
    std::vector<bool> hasEnded(loads.size());
    size_t ended = 0, ready = 0;
    while (ended < loads.size() && !HasFailure()) {
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
        for (size_t i = 0; i < loads.size(); ++i) {
            FxPresetLoadProgress progress{};
            progress.structSize = sizeof progress;
            EXPECT_EQ(fxPresetLoad_GetProgress(loads[i], &progress), FX_OK);
            EXPECT_GE(progress.fraction, last[i]);
            last[i] = progress.fraction;
            if (i % 3 == 1 && (progress.filesRead > 0 || i % 2 == 0)) { // some before they run
                EXPECT_EQ(fxPresetLoad_Cancel(loads[i]), FX_OK);
            }
            if (hasEnded[i] || progress.state == FX_PRESET_LOAD_WAITING ||
                progress.state == FX_PRESET_LOAD_RUNNING)
                continue;
            FxPresetId preset{};
            const FxResult result = fxPresetLoad_Finish(loads[i], &preset);
            EXPECT_EQ(result == FX_OK, progress.state == FX_PRESET_LOAD_READY);
            ready += result == FX_OK ? 1 : 0;
            hasEnded[i] = true;
            ++ended;
        }
    }
    for (std::thread& worker : workers)
        worker.join();
    for (FxPresetLoad* load : loads)
        EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
    EXPECT_GE(ready, loads.size() * 2 / 3);
    FxMemoryStats stats{};
    stats.structSize = sizeof stats;
    EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
    EXPECT_EQ(stats.presets, 1u + ready);
}

TEST_F(ThreadApi, manySmallEmittersAreReadOnOtherThreadsWhileTheyComeAndGo)
{
    FxInstanceDef def = instanceDef();
    def.preset = loadText(context_, R"({"version": 1, "name": "sparks", "ground": false, "emitters": [{
        "maxParticles": 16, "shape": "sphere", "size": 0.5, "emission": {"rate": 10}, "lifetime": 1,
        "speed": 2, "radius": 0.25, "appearance": {"kind": "sprite"}}]})");
    std::vector<FxInstanceId> ids(24); // so many of one preset share their rows
    const auto begin = [&](FxInstanceId& id) {
        ++def.seed; // or they would be the same effect, and share all
        ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    };
    for (FxInstanceId& id : ids)
        begin(id);
    for (int frame = 0; frame < 90; ++frame)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    std::atomic<bool> isOver{false};
    std::atomic<int> seen{0};
    std::vector<std::thread> readers;
    for (int t = 0; t < 3; ++t)
        readers.emplace_back([&] { readSnapshots(scene_, isOver, seen); });
    for (uint64_t frame = 0; (frame < 200 || seen < 100) && !HasFailure(); ++frame) {
        if (frame % 4 == 0) {
            FxInstanceId& id = ids[frame / 4 % ids.size()];
            EXPECT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
            begin(id);
        }
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    }
    isOver = true;
    for (std::thread& reader : readers)
        reader.join();
}

TEST(ReEntrancy, aLoopOfTheHostMustNotEnterTheSceneThatIsStepping)
{
    Intruder intruder;
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.parallelFor = {&intruder, &intrudeInLoop};
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene *scene = nullptr, *other = nullptr;
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &other), FX_OK);
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = loadText(context, burstPreset(5000, 2.0));
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);

    bool entered = false;
    intruder.action = [&] {
        entered = true;
        EXPECT_EQ(fxScene_Update(scene, kFrame), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxScene_DestroyInstance(scene, id), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxScene_IsValid(scene, id), 0u);
        EXPECT_EQ(fxScene_AdoptThread(scene), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxDestroyScene(scene), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxDestroyContext(context), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxScene_Update(other, kFrame), FX_OK); // another scene is free
        FxPresetId preset{};
        EXPECT_EQ(fxLoadPresetLibrary(context, "steam", &preset), FX_OK);
    };
    EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
    EXPECT_TRUE(entered);
    EXPECT_EQ(fxScene_IsValid(scene, id), 1u);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}

TEST(ReEntrancy, theAssetHookMustNotLoadInTheContextThatIsLoading)
{
    Intruder intruder;
    FxContextDef def = fxDefaultContextDef();
    def.assets = {&intruder, &intrudeInOpen, [](void*, const void*, size_t) {}};
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK);
    bool entered = false;
    intruder.action = [&] {
        entered = true;
        const std::string text = fountainPreset();
        FxPresetId id{};
        EXPECT_EQ(fxLoadPresetText(context, text.data(), text.size(), nullptr, &id), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxDestroyContext(context), FX_ERROR_RE_ENTRANT);
    };
    FxPresetId id{};
    EXPECT_EQ(fxLoadPresetFile(context, "nothing.fx.json", &id), FX_ERROR_NOT_FOUND);
    EXPECT_TRUE(entered);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}
