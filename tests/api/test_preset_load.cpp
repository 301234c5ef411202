// Presets that a worker thread of the host loads.
#include "fxsdk/fxsdk.hpp"
#include "tests/api/api_fixture.h"
#include "tests/api/library_names.h"
#include "tests/api/memory_sweep.h"
#include "tests/presets/small_png.h"

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

using fx::test::kFrame;

namespace {

constexpr const char* kCards = R"({"version": 1, "name": "cards", "emitters": [
    {"name": "one", "emission": {"rate": 20}, "lifetime": 1, "radius": 0.1,
     "appearance": {"kind": "mesh", "mesh": "shard.obj"}},
    {"name": "two", "emission": {"rate": 20}, "lifetime": 1, "radius": 0.1,
     "appearance": {"kind": "sprite", "texture": "card.png", "luminance": 100}}]})";

/// A mesh of several KiB.
std::string shardMesh()
{
    std::string text;
    for (int i = 0; i < 100; ++i)
        text += "v 0 0 " + std::to_string(i) + "\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
    return text;
}

/// An archive of the host that can stop a load in the middle of a file.
struct LoadArchive
{
    std::map<std::string, std::string> files{
        {"cards.fx.json", kCards}, {"card.png", fx::test::smallPng()}, {"shard.obj", shardMesh()}};
    std::function<void(const std::string& name)> onOpen;
    std::atomic<int> open{0};

    FxAssetHook hook()
    {
        return {this,
                [](void* user, const char* name, size_t* outSize) -> const void* {
                    auto& self = *static_cast<LoadArchive*>(user);
                    if (self.onOpen)
                        self.onOpen(name);
                    const auto found = self.files.find(name);
                    if (found == self.files.end())
                        return nullptr;
                    ++self.open;
                    *outSize = found->second.size();
                    return found->second.data();
                },
                [](void* user, const void*, size_t) { --static_cast<LoadArchive*>(user)->open; }};
    }
};

class PresetLoadApi : public ::testing::Test
{
protected:
    PresetLoadApi()
    {
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.allocator = memory_.hooks();
        def.assets = archive_.hook();
        EXPECT_EQ(fxCreateContext(&def, &context_), FX_OK);
    }
    ~PresetLoadApi() override
    {
        EXPECT_EQ(fxDestroyContext(context_), FX_OK);
        EXPECT_EQ(memory_.blocks(), 0);
        EXPECT_EQ(archive_.open, 0);
    }

    FxPresetLoad* begin(const char* path, const std::string& text = {})
    {
        FxPresetLoad* load = nullptr;
        EXPECT_EQ(fxBeginPresetLoad(context_, path, text.empty() ? nullptr : text.data(), text.size(), &load),
                  FX_OK)
            << fxGetLastErrorMessage();
        return load;
    }
    static FxPresetLoadProgress progressOf(FxPresetLoad* load)
    {
        FxPresetLoadProgress progress{};
        progress.structSize = sizeof progress;
        EXPECT_EQ(fxPresetLoad_GetProgress(load, &progress), FX_OK);
        return progress;
    }
    uint32_t presetCount()
    {
        FxMemoryStats stats{};
        stats.structSize = sizeof stats;
        EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
        return stats.presets;
    }
    uint64_t bytesInUse()
    {
        FxMemoryStats stats{};
        stats.structSize = sizeof stats;
        EXPECT_EQ(fxContext_GetMemoryStats(context_, &stats), FX_OK);
        return stats.bytesInUse;
    }
    /// Hash of a scene that has played the preset for a second.
    uint64_t playedHash(FxPresetId preset)
    {
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = preset;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK) << fxGetLastErrorMessage();
        for (int i = 0; i < 10; ++i)
            EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK);
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK);
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
        return hash;
    }

    fx::test::ScarceMemory memory_;
    LoadArchive archive_;
    FxContext* context_ = nullptr;
};

} // namespace

TEST_F(PresetLoadApi, loadsOnAWorkerWhatALoadAtOnceGives)
{
    for (const std::string& name : fx::test::libraryNames()) {
        FxPresetLoad* const load = begin(("library:" + name).c_str());
        EXPECT_EQ(progressOf(load).state, uint32_t(FX_PRESET_LOAD_WAITING));
        FxPresetId loaded{}, atOnce{};
        EXPECT_EQ(fxPresetLoad_Finish(load, &loaded), FX_ERROR_INVALID_ARGUMENT);
        std::thread([load] { EXPECT_EQ(fxPresetLoad_Run(load), FX_OK) << fxGetLastErrorMessage(); }).join();
        const FxPresetLoadProgress progress = progressOf(load);
        EXPECT_EQ(progress.state, uint32_t(FX_PRESET_LOAD_READY));
        EXPECT_EQ(progress.fraction, 1.0f);
        EXPECT_GE(progress.filesRead, 1u);
        ASSERT_EQ(fxPresetLoad_Finish(load, &loaded), FX_OK) << fxGetLastErrorMessage();
        FxPresetId again{};
        ASSERT_EQ(fxPresetLoad_Finish(load, &again), FX_OK);
        EXPECT_EQ(again.bits, loaded.bits);
        ASSERT_EQ(fxLoadPresetLibrary(context_, name.c_str(), &atOnce), FX_OK);
        FxPresetInfo a{}, b{};
        a.structSize = b.structSize = sizeof a;
        ASSERT_EQ(fxGetPresetInfo(context_, loaded, &a), FX_OK);
        ASSERT_EQ(fxGetPresetInfo(context_, atOnce, &b), FX_OK);
        EXPECT_EQ(std::string(a.name), b.name);
        EXPECT_EQ(a.memoryBytes, b.memoryBytes);
        EXPECT_EQ(a.startWork, b.startWork);
        if (name == "campfire" || name == "debris" || name == "fireworks") {
            EXPECT_EQ(playedHash(loaded), playedHash(atOnce)) << name;
        }
        EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
        EXPECT_EQ(fxUnloadPreset(context_, loaded), FX_OK); // the preset outlives its load
        EXPECT_EQ(fxUnloadPreset(context_, atOnce), FX_OK);
    }
}

TEST_F(PresetLoadApi, readsFilesAndTextsAsTheFunctionsThatLoadAtOnce)
{
    for (const bool hasText : {false, true}) {
        FxPresetLoad* const load = begin("cards.fx.json", hasText ? kCards : "");
        ASSERT_EQ(fxPresetLoad_Run(load), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(progressOf(load).filesRead, hasText ? 2u : 3u);
        EXPECT_EQ(fxPresetLoad_Run(load), FX_OK); // the load has ended
        FxPresetId loaded{}, atOnce{};
        ASSERT_EQ(fxPresetLoad_Finish(load, &loaded), FX_OK);
        ASSERT_EQ(fxLoadPresetFile(context_, "cards.fx.json", &atOnce), FX_OK);
        EXPECT_EQ(playedHash(loaded), playedHash(atOnce));
        EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
    }
}

TEST_F(PresetLoadApi, tellsWhatIsBeingLoadedAndNeverGoesBack)
{
    FxPresetLoad* const load = begin("cards.fx.json");
    std::vector<std::string> items;
    float last = -1.0f;
    archive_.onOpen = [&](const std::string&) {
        const FxPresetLoadProgress progress = progressOf(load);
        EXPECT_EQ(progress.state, uint32_t(FX_PRESET_LOAD_RUNNING));
        EXPECT_GT(progress.fraction, last);
        EXPECT_LT(progress.fraction, 1.0f);
        last = progress.fraction;
        items.emplace_back(progress.item);
        FxPresetId preset{42};
        EXPECT_EQ(fxPresetLoad_Finish(load, &preset), FX_ERROR_INVALID_ARGUMENT);
        EXPECT_EQ(preset.bits, 42u);
        EXPECT_EQ(fxPresetLoad_Run(load), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(fxDestroyPresetLoad(load), FX_ERROR_RE_ENTRANT);
    };
    ASSERT_EQ(fxPresetLoad_Run(load), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(items, (std::vector<std::string>{"cards.fx.json", "shard.obj", "card.png"}));
    EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
    EXPECT_EQ(presetCount(), 0u); // the host never had its id
}

TEST_F(PresetLoadApi, keepsTheErrorWithItsPlaceForTheThreadThatFinishes)
{
    archive_.files["bad.fx.json"] = "{\"version\": 1,\n \"emitters\": [{\"radious\": 1}]}";
    archive_.files["missing.fx.json"] =
        std::string(kCards).replace(std::string(kCards).find("card.png"), 8, "cart.png");
    const std::map<std::string, std::string> wanted{{"bad.fx.json", "bad.fx.json:2:"},
                                                    {"missing.fx.json", "cart.png"},
                                                    {"nowhere.fx.json", "nowhere.fx.json"}};
    const uint64_t before = bytesInUse();
    for (const auto& [path, words] : wanted) {
        FxPresetLoad* const load = begin(path.c_str());
        FxResult result = FX_OK;
        std::thread([&] { result = fxPresetLoad_Run(load); }).join();
        EXPECT_NE(result, FX_OK);
        EXPECT_EQ(progressOf(load).state, uint32_t(FX_PRESET_LOAD_FAILED));
        EXPECT_LT(progressOf(load).fraction, 1.0f);
        FxPresetId preset{42};
        EXPECT_EQ(fxPresetLoad_Finish(load, &preset), result);
        EXPECT_EQ(preset.bits, 42u);
        const std::string message = fxGetLastErrorMessage();
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_EQ(fxLoadPresetFile(context_, path.c_str(), &preset), result);
        EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
    }
    EXPECT_EQ(presetCount(), 0u);
    EXPECT_LE(bytesInUse(), before + 256); // room of tables; the mesh of the second preset is gone
}

TEST_F(PresetLoadApi, leavesNothingBehindWhereverItIsCanceled)
{
    FxPresetLoad* const first = begin("cards.fx.json"); // tables have room now
    ASSERT_EQ(fxPresetLoad_Cancel(first), FX_OK);
    EXPECT_EQ(progressOf(first).state, uint32_t(FX_PRESET_LOAD_CANCELED));
    EXPECT_EQ(fxPresetLoad_Run(first), FX_ERROR_INTERRUPTED);
    EXPECT_EQ(fxDestroyPresetLoad(first), FX_OK);
    const uint64_t before = bytesInUse();
    for (const char* file : {"cards.fx.json", "shard.obj", "card.png"}) {
        FxPresetLoad* const load = begin("cards.fx.json");
        archive_.onOpen = [&](const std::string& name) {
            if (name == file) {
                EXPECT_EQ(fxPresetLoad_Cancel(load), FX_OK);
            }
        };
        EXPECT_EQ(fxPresetLoad_Run(load), FX_ERROR_INTERRUPTED) << file;
        EXPECT_EQ(progressOf(load).state, uint32_t(FX_PRESET_LOAD_CANCELED));
        FxPresetId preset{};
        EXPECT_EQ(fxPresetLoad_Finish(load, &preset), FX_ERROR_INTERRUPTED);
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find("cards.fx.json"), std::string::npos);
        EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
        EXPECT_EQ(presetCount(), 0u);
        EXPECT_LE(bytesInUse(), before + 256) << file;
    }
    archive_.onOpen = nullptr;
    FxPresetLoad* const last = begin("cards.fx.json");
    EXPECT_EQ(fxPresetLoad_Run(last), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxPresetLoad_Cancel(last), FX_OK); // too late
    FxPresetId preset{};
    EXPECT_EQ(fxPresetLoad_Finish(last, &preset), FX_OK);
    EXPECT_EQ(fxDestroyPresetLoad(last), FX_OK);
    EXPECT_EQ(presetCount(), 1u);
}

TEST_F(PresetLoadApi, leavesNothingBehindWhenMemoryRunsOut)
{
    FxPresetLoad* kept = nullptr;
    const auto action = [&] {
        FxPresetLoad* load = nullptr;
        FxResult result = fxBeginPresetLoad(context_, "cards.fx.json", kCards,
                                            std::char_traits<char>::length(kCards), &load);
        if (result != FX_OK)
            return result;
        result = fxPresetLoad_Run(load);
        if (result == FX_OK)
            kept = load;
        else
            EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
        return result;
    };
    const uint64_t before = bytesInUse();
    const uint64_t failures = fx::test::refuseEach(memory_, action, [&] {
        return presetCount() == 0 && bytesInUse() <= before + 256; // room of tables
    });
    EXPECT_GE(failures, 4u);
    FxPresetId preset{};
    EXPECT_EQ(fxPresetLoad_Finish(kept, &preset), FX_OK);
}

TEST_F(PresetLoadApi, canRunLaterWhenACallbackMayNotRunIt)
{
    FxPresetLoad* const outer = begin("cards.fx.json");
    FxPresetLoad* const inner = begin("library:sparks");
    FxPresetLoad* const canceled = begin("library:sparks");
    archive_.onOpen = [&](const std::string&) {
        EXPECT_EQ(fxPresetLoad_Run(inner), FX_ERROR_RE_ENTRANT);
        EXPECT_EQ(progressOf(inner).state, uint32_t(FX_PRESET_LOAD_WAITING));
    };
    ASSERT_EQ(fxPresetLoad_Run(outer), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxPresetLoad_Run(inner), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxPresetLoad_Cancel(canceled), FX_OK);
    EXPECT_EQ(fxPresetLoad_Run(canceled), FX_ERROR_INTERRUPTED);
    EXPECT_EQ(presetCount(), 2u);
}

TEST_F(PresetLoadApi, itsContextIsNotDestroyedWhileItRunsOrWaits)
{
    FxPresetLoad* const first = begin("cards.fx.json");
    FxPresetLoad* const second = begin("cards.fx.json");
    std::atomic<bool> isInside{false}, goesOn{false};
    archive_.onOpen = [&](const std::string&) {
        isInside = true;
        while (!goesOn)
            std::this_thread::yield();
    };
    std::thread runs([&] { EXPECT_EQ(fxPresetLoad_Run(first), FX_OK) << fxGetLastErrorMessage(); });
    while (!isInside)
        std::this_thread::yield();
    std::thread waits([&] { EXPECT_EQ(fxPresetLoad_Run(second), FX_ERROR_INTERRUPTED); });
    while (progressOf(second).state == FX_PRESET_LOAD_WAITING)
        std::this_thread::yield();
    EXPECT_EQ(fxDestroyContext(context_), FX_ERROR_RE_ENTRANT); // and does not wait for the load
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("fxPresetLoad_Cancel"), std::string::npos);
    EXPECT_EQ(fxPresetLoad_Cancel(second), FX_OK);
    goesOn = true;
    runs.join();
    waits.join();
    EXPECT_EQ(presetCount(), 1u);
}

TEST_F(PresetLoadApi, endsWithItsContext)
{
    FxPresetLoad* const ready = begin("cards.fx.json");
    ASSERT_EQ(fxPresetLoad_Run(ready), FX_OK);
    (void)begin("cards.fx.json"); // both are destroyed with the context, see the destructor of the test
}

TEST_F(PresetLoadApi, refusesWrongArguments)
{
    FxPresetLoad* load = nullptr;
    FxPresetId preset{};
    EXPECT_EQ(fxBeginPresetLoad(nullptr, "a", nullptr, 0, &load), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxBeginPresetLoad(context_, nullptr, nullptr, 0, &load), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxBeginPresetLoad(context_, "a", nullptr, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxBeginPresetLoad(context_, "a", nullptr, 1, &load), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxBeginPresetLoad(context_, "a", "{}", 0, &load), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxBeginPresetLoad(context_, "a", "{}", size_t(5) << 20, &load), FX_ERROR_TOO_LARGE);
    EXPECT_EQ(load, nullptr);
    EXPECT_EQ(fxPresetLoad_Run(nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxPresetLoad_Cancel(nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxPresetLoad_Finish(nullptr, &preset), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxPresetLoad_GetProgress(nullptr, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxDestroyPresetLoad(nullptr), FX_OK);
    load = begin("cards.fx.json");
    FxPresetLoadProgress progress{};
    EXPECT_EQ(fxPresetLoad_GetProgress(load, nullptr), FX_ERROR_INVALID_ARGUMENT);
    progress.structSize = 3;
    EXPECT_EQ(fxPresetLoad_GetProgress(load, &progress), FX_ERROR_VERSION);
    EXPECT_EQ(fxPresetLoad_Finish(load, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxDestroyPresetLoad(load), FX_OK);
}

TEST_F(PresetLoadApi, isObjectsOfCppToo)
{
    EXPECT_EQ(fxsdk::Error(FX_ERROR_INTERRUPTED, "").code(), FX_ERROR_INTERRUPTED);
    FxContextDef def = fxDefaultContextDef();
    def.workers = 1;
    fxsdk::Context context(def);
    fxsdk::PresetLoad load(context, "library:sparks");
    std::thread([&] { load.run(); }).join();
    EXPECT_EQ(load.progress().state, uint32_t(FX_PRESET_LOAD_READY));
    EXPECT_STREQ(context.info(load.finish()).name, "sparks");
    fxsdk::PresetLoad never(context, "library:sparks");
    never.cancel();
    EXPECT_THROW(never.run(), fxsdk::Error);
}
