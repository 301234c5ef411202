#include "tests/api/api_fixture.h"

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

} // namespace

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
