// Presets that are replaced under living instances: the result is that of new instances of the new preset.
#include "fxsdk/fxsdk.hpp"
#include "tests/api/api_fixture.h"
#include "tests/api/memory_sweep.h"

#include <cstring>
#include <string>
#include <vector>

using namespace fx::test;

namespace {

constexpr uint32_t kSeek = FX_REPLACE_SEEK;
constexpr uint32_t kRestart = FX_REPLACE_RESTART;

/// A fountain with particles of another speed, life and number.
std::string highFountain()
{
    return R"({"version": 1, "name": "high fountain", "emitters": [{
        "maxParticles": 256, "shape": "sphere", "size": 0.2, "emission": {"rate": 100}, "lifetime": 1.5,
        "speed": {"min": 4, "max": 6}, "radius": 0.1}]})";
}

/// Needs a step for every step of its past, and collides with the ground.
std::string bouncingFountain()
{
    return R"({"version": 1, "name": "bouncing", "emitters": [{
        "maxParticles": 4000, "emission": {"rate": 600}, "lifetime": 3, "speed": {"min": 1, "max": 3},
        "radius": 0.05, "forces": {"curlStrength": 1, "curlRate": 0.5}, "collisions": [{"shape": "ground", "bounce": 0.5}]}]})";
}

class ReloadApi : public ApiTest
{
protected:
    FxResult replace(FxPresetId from, FxPresetId to, uint32_t mode, uint32_t* outCount = nullptr) const
    {
        return fxScene_ReplacePreset(scene_, from, to, mode, outCount);
    }
    FxInstanceState stateOf(FxInstanceId id) const
    {
        FxInstanceState state{};
        EXPECT_EQ(fxScene_GetInstanceState(scene_, id, &state, nullptr), FX_OK);
        return state;
    }
    FxInstanceInfo infoOf(FxInstanceId id) const
    {
        FxInstanceInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_GetInstanceInfo(scene_, id, &info), FX_OK) << fxGetLastErrorMessage();
        return info;
    }
    /// An instance that has everything that a host can set.
    FxInstanceDef placed(FxPresetId preset) const
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset;
        def.seed = 11;
        def.scale = 1.5f;
        def.position[0] = 3;
        def.position[1] = 2;
        def.rotation[2] = def.rotation[3] = 0.70710678f;
        def.intensity = 0.5f;
        def.wind[0] = 2;
        return def;
    }
    FxScene* makeScene(uint64_t workBudget = fxDefaultSceneDef().workBudget) const
    {
        FxSceneDef def = fxDefaultSceneDef();
        def.workBudget = workBudget;
        FxScene* scene = nullptr;
        EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        return scene;
    }
};

uint64_t hashOf(FxScene* scene)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(scene, &hash), FX_OK) << fxGetLastErrorMessage();
    return hash;
}

void playIn(FxScene* scene, int frames)
{
    for (int frame = 0; frame < frames; ++frame)
        ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK) << fxGetLastErrorMessage();
}

FxInstanceId createIn(FxScene* scene, const FxInstanceDef& def)
{
    FxInstanceId id{};
    EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK) << fxGetLastErrorMessage();
    return id;
}

} // namespace

TEST_F(ReloadApi, theResultIsThatOfANewInstanceThatWasSoughtThere)
{
    std::vector<std::string> texts = {highFountain(), bouncingFountain(), burstPreset(100, 3),
                                      smallBlastPreset()};
    for (const std::string& text : texts)
        for (const int frames : {1, 40}) {
            SCOPED_TRACE(text);
            const FxPresetId next = loadText(context_, text);
            FxScene* const played = makeScene(0);
            FxScene* const sought = makeScene(0);
            const FxInstanceId old = createIn(played, placed(fountain_));
            playIn(played, frames);
            uint32_t count = 0;
            ASSERT_EQ(fxScene_ReplacePreset(played, fountain_, next, kSeek, &count), FX_OK)
                << fxGetLastErrorMessage();
            EXPECT_EQ(count, 1u);
            EXPECT_EQ(fxScene_IsValid(played, old), 1u);

            playIn(sought, frames);
            const FxInstanceId fresh = createIn(sought, placed(next));
            ASSERT_EQ(fxScene_SeekInstance(sought, fresh, frames * kFrame), FX_OK) << fxGetLastErrorMessage();
            for (const double seconds : {0.0, kFrame, 10 * kFrame}) {
                ASSERT_EQ(fxScene_Update(played, seconds), FX_OK);
                ASSERT_EQ(fxScene_Update(sought, seconds), FX_OK);
                EXPECT_EQ(hashOf(played), hashOf(sought)) << "after " << seconds << " s";
            }
            uint32_t particles = 0, expected = 0;
            EXPECT_EQ(fxScene_GetInstanceState(played, old, nullptr, &particles), FX_OK);
            EXPECT_EQ(fxScene_GetInstanceState(sought, fresh, nullptr, &expected), FX_OK);
            EXPECT_EQ(particles, expected);
            EXPECT_GT(particles, 0u);
            EXPECT_EQ(fxDestroyScene(played), FX_OK);
            EXPECT_EQ(fxDestroyScene(sought), FX_OK);
        }
}

TEST_F(ReloadApi, aRestartIsThatOfANewInstance)
{
    const std::string prewarmed =
        R"({"version": 1, "prewarm": 0.5, "emitters": [{"maxParticles": 256, "emission": {"rate": 100}, "lifetime": 2, "speed": 2}]})";
    for (const std::string& text : {highFountain(), prewarmed}) {
        const FxPresetId next = loadText(context_, text);
        FxScene* const played = makeScene();
        FxScene* const fresh = makeScene();
        (void)createIn(played, placed(fountain_));
        playIn(played, 30);
        playIn(fresh, 30);
        ASSERT_EQ(fxScene_ReplacePreset(played, fountain_, next, kRestart, nullptr), FX_OK);
        (void)createIn(fresh, placed(next));
        playIn(played, 20);
        playIn(fresh, 20);
        EXPECT_EQ(hashOf(played), hashOf(fresh));
        EXPECT_EQ(fxDestroyScene(played), FX_OK);
        EXPECT_EQ(fxDestroyScene(fresh), FX_OK);
    }
}

TEST_F(ReloadApi, instancesKeepIdPlaceTimeSpeedAndMask)
{
    const FxPresetId next = loadText(context_, highFountain());
    const FxInstanceDef def = placed(fountain_);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
    const FxInstanceId other = addFountain();
    ASSERT_EQ(fxScene_SetVisibilityMask(scene_, id, 2u), FX_OK);
    ASSERT_EQ(fxScene_SetInstanceSpeed(scene_, id, 2.0f), FX_OK);
    play(30);
    const FxInstanceInfo before = infoOf(id);
    EXPECT_EQ(before.preset.bits, fountain_.bits);
    EXPECT_DOUBLE_EQ(before.localSeconds, 1.0);
    uint32_t count = 0;
    ASSERT_EQ(replace(fountain_, next, kSeek, &count), FX_OK);
    EXPECT_EQ(count, 2u);
    const FxInstanceInfo after = infoOf(id);
    EXPECT_EQ(after.preset.bits, next.bits);
    EXPECT_DOUBLE_EQ(after.localSeconds, 1.0);
    EXPECT_EQ(after.position[0], 3.0);
    EXPECT_EQ(fxScene_IsValid(scene_, other), 1u);
    play(30);
    EXPECT_DOUBLE_EQ(infoOf(id).localSeconds, 2.0);
    const size_t masked = savedState().size();
    ASSERT_EQ(fxScene_SetVisibilityMask(scene_, id, 0xFFFFFFFFu), FX_OK);
    EXPECT_LT(savedState().size(), masked); // it had a mask of its own
}

TEST_F(ReloadApi, anInstanceThatDoesNotEmitStaysSilent)
{
    const FxInstanceId id = addFountain();
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.intensity = 0;
    ASSERT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_OK);
    play(20);
    ASSERT_EQ(replace(fountain_, loadText(context_, highFountain()), kSeek), FX_OK);
    play(20);
    EXPECT_EQ(infoOf(id).particles, 0u);
}

TEST_F(ReloadApi, aPausedClockShowsTheNewPresetWithTheNextUpdate)
{
    (void)addFountain();
    play(30);
    const uint64_t before = hash();
    ASSERT_EQ(replace(fountain_, loadText(context_, highFountain()), kSeek), FX_OK);
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    EXPECT_NE(hash(), before);
}

TEST_F(ReloadApi, equalInstancesStillShareASimulation)
{
    for (int i = 0; i < 20; ++i)
        (void)addFountain();
    play(30);
    ASSERT_EQ(statistics().simulations, 1u);
    ASSERT_EQ(replace(fountain_, loadText(context_, bouncingFountain()), kSeek), FX_OK);
    EXPECT_EQ(statistics().simulations, 1u);
    play(10);
    EXPECT_EQ(statistics().simulations, 1u);
    EXPECT_EQ(statistics().instancesActive, 20u);
}

TEST_F(ReloadApi, whatHasNotStartedStartsWithTheNewPresetAndWhatHasEndedStaysEnded)
{
    FxInstanceDef def = instanceDef();
    def.startTick = FX_TICKS_PER_SECOND;
    FxInstanceId later{}, ended{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &later), FX_OK);
    const FxPresetId burst = loadText(context_, burstPreset(20, 0.1));
    FxInstanceDef brief = fxDefaultInstanceDef();
    brief.preset = burst;
    ASSERT_EQ(fxScene_CreateInstance(scene_, &brief, &ended), FX_OK);
    play(30);
    ASSERT_EQ(stateOf(ended), FX_INSTANCE_FINISHED);
    const FxPresetId next = loadText(context_, highFountain());
    uint32_t count = 99;
    ASSERT_EQ(replace(burst, next, kSeek, &count), FX_OK);
    EXPECT_EQ(count, 0u);
    EXPECT_EQ(stateOf(ended), FX_INSTANCE_FINISHED);
    ASSERT_EQ(replace(fountain_, next, kSeek, &count), FX_OK);
    EXPECT_EQ(count, 1u);
    EXPECT_EQ(stateOf(later), FX_INSTANCE_DORMANT);
    EXPECT_NEAR(infoOf(later).localSeconds, -0.5, 1e-9);
    play(60);
    EXPECT_EQ(infoOf(later).particles, 50u); // half a second at 100 births a second
}

TEST_F(ReloadApi, anInstanceEndsWhenTheNewPresetEndsBeforeItsTime)
{
    const FxInstanceId id = addFountain();
    play(90);
    ASSERT_EQ(replace(fountain_, loadText(context_, burstPreset(20, 0.5)), kSeek), FX_OK);
    play(2);
    EXPECT_EQ(stateOf(id), FX_INSTANCE_FINISHED);
}

TEST_F(ReloadApi, aHiddenInstanceIsReplacedToo)
{
    const FxInstanceId id = addFountain();
    play(10);
    FxActivationHints hints = fxDefaultActivationHints();
    hints.occluded = 1;
    ASSERT_EQ(fxScene_SetActivationHints(scene_, id, &hints), FX_OK);
    play(10);
    ASSERT_EQ(stateOf(id), FX_INSTANCE_HIDDEN);
    ASSERT_EQ(replace(fountain_, loadText(context_, highFountain()), kSeek), FX_OK);
    play(10);
    EXPECT_EQ(stateOf(id), FX_INSTANCE_HIDDEN); // its hints are kept
    hints.occluded = 0;
    ASSERT_EQ(fxScene_SetActivationHints(scene_, id, &hints), FX_OK);
    play(10);
    EXPECT_EQ(stateOf(id), FX_INSTANCE_ACTIVE);
    EXPECT_EQ(infoOf(id).particles, 66u); // 40 frames at 100 a second
}

TEST_F(ReloadApi, aBudgetDividesTheWayAndTheResultIsTheSame)
{
    const FxPresetId next = loadText(context_, bouncingFountain());
    FxScene* const whole = makeScene(0);
    FxPresetInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxGetPresetInfo(context_, next, &info), FX_OK);
    FxScene* const divided = makeScene(8 * info.stepWork); // a quarter is for instances that catch up
    const FxInstanceId a = createIn(whole, placed(fountain_));
    const FxInstanceId b = createIn(divided, placed(fountain_));
    playIn(whole, 120);
    playIn(divided, 120);
    ASSERT_EQ(fxScene_ReplacePreset(whole, fountain_, next, kSeek, nullptr), FX_OK);
    ASSERT_EQ(fxScene_ReplacePreset(divided, fountain_, next, kSeek, nullptr), FX_OK);
    FxInstanceState state{};
    EXPECT_EQ(fxScene_GetInstanceState(divided, b, &state, nullptr), FX_OK);
    EXPECT_EQ(state, FX_INSTANCE_WAKING);
    playIn(whole, 600);
    playIn(divided, 600);
    EXPECT_EQ(fxScene_GetInstanceState(divided, b, &state, nullptr), FX_OK);
    EXPECT_EQ(state, FX_INSTANCE_ACTIVE);
    FxInstanceInfo ofWhole{}, ofDivided{};
    ofWhole.structSize = ofDivided.structSize = sizeof ofWhole;
    EXPECT_EQ(fxScene_GetInstanceInfo(whole, a, &ofWhole), FX_OK);
    EXPECT_EQ(fxScene_GetInstanceInfo(divided, b, &ofDivided), FX_OK);
    EXPECT_EQ(ofWhole.particles, ofDivided.particles);
    EXPECT_DOUBLE_EQ(ofWhole.localSeconds, ofDivided.localSeconds);
    EXPECT_EQ(hashOf(whole), hashOf(divided));
    EXPECT_EQ(fxDestroyScene(whole), FX_OK);
    EXPECT_EQ(fxDestroyScene(divided), FX_OK);
}

TEST_F(ReloadApi, aReplacedSceneIsSavedAndRestored)
{
    const FxInstanceId id = addFountain();
    play(40);
    const FxPresetId next = loadText(context_, bouncingFountain());
    ASSERT_EQ(replace(fountain_, next, kSeek), FX_OK);
    ASSERT_EQ(fxUnloadPreset(context_, fountain_), FX_OK); // nothing needs it any more
    const auto state = savedState();
    play(20);
    const uint64_t want = simulationHash();
    ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
    play(20);
    EXPECT_EQ(simulationHash(), want);
    EXPECT_EQ(fxScene_IsValid(scene_, id), 1u);
}

TEST_F(ReloadApi, aPresetIsReplacedByItselfAndBackAgain)
{
    (void)addFountain();
    play(40);
    const auto untouched = infoOf(addFountain());
    EXPECT_EQ(untouched.particles, 0u);
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    const uint64_t before = hash();
    const FxPresetId next = loadText(context_, highFountain());
    ASSERT_EQ(replace(fountain_, next, kSeek), FX_OK);
    ASSERT_EQ(replace(next, fountain_, kSeek), FX_OK);
    ASSERT_EQ(replace(fountain_, fountain_, kSeek), FX_OK);
    ASSERT_EQ(fxScene_Update(scene_, 0.0), FX_OK);
    EXPECT_EQ(hash(), before);
}

TEST_F(ReloadApi, wrongArgumentsChangeNothing)
{
    const FxInstanceId id = addFountain();
    play(10);
    const uint64_t before = simulationHash();
    uint32_t count = 7;
    EXPECT_EQ(fxScene_ReplacePreset(nullptr, fountain_, fountain_, kSeek, &count), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(replace({12345}, fountain_, kSeek, &count), FX_ERROR_STALE_ID);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("oldPreset"), std::string::npos);
    EXPECT_EQ(replace(fountain_, {}, kSeek, &count), FX_ERROR_STALE_ID);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("newPreset"), std::string::npos);
    EXPECT_EQ(replace(fountain_, fountain_, 2, &count), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(count, 7u);
    EXPECT_EQ(simulationHash(), before);

    FxInstanceInfo info{};
    EXPECT_EQ(fxScene_GetInstanceInfo(scene_, id, &info), FX_ERROR_VERSION);
    EXPECT_EQ(fxScene_GetInstanceInfo(scene_, id, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_GetInstanceInfo(scene_, {5}, &info), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxRedirectPreset(nullptr, fountain_, fountain_), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxRedirectPreset(context_, {5}, fountain_), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxRedirectPreset(context_, fountain_, {5}), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxGetPresets(context_, nullptr, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    FxPresetId listed[1] = {{9}};
    (void)loadText(context_, highFountain());
    EXPECT_EQ(fxGetPresets(context_, listed, 1, &count), FX_ERROR_CAPACITY);
    EXPECT_EQ(listed[0].bits, 9u);
    char text[4] = "abc";
    size_t size = 0;
    EXPECT_EQ(fxGetPresetSource(context_, fountain_, text, sizeof text, &size), FX_ERROR_CAPACITY);
    EXPECT_STREQ(text, "abc");
    EXPECT_EQ(fxGetPresetSource(context_, {5}, nullptr, 0, &size), FX_ERROR_STALE_ID);
}

TEST_F(ReloadApi, aRedirectedIdNamesTheNewEffectForLaterInstances)
{
    fxsdk::Context context;
    fxsdk::Scene scene(context);
    const FxPresetId preset = context.loadText(fountainPreset(), "fx/fountain.fx.json");
    const FxPresetId edited = context.loadText(highFountain(), "fx/fountain.fx.json");
    const FxInstanceId before = scene.create(preset);
    EXPECT_EQ(context.presets().size(), 2u);
    EXPECT_EQ(context.source(preset), "fx/fountain.fx.json");
    EXPECT_EQ(scene.replacePreset(preset, edited), 1u);
    context.redirect(preset, edited);
    EXPECT_STREQ(context.info(preset).name, "high fountain");
    context.unload(edited);
    const FxInstanceId after = scene.create(preset);
    EXPECT_EQ(scene.info(before).preset.bits, preset.bits);
    EXPECT_EQ(scene.info(after).preset.bits, preset.bits);
    scene.update(kFrame);
    EXPECT_EQ(scene.info(before).particles, scene.info(after).particles);
}

TEST_F(ReloadApi, anEditedTextFindsTheFilesBesideItsPath)
{
    const std::string textured =
        R"({"version": 1, "emitters": [{"emission": {"rate": 10}, "appearance": {"kind": "sprite", "texture": "NAME"}}]})";
    const auto withName = [&](const std::string& name) {
        std::string text = textured;
        return text.replace(text.find("NAME"), 4, name);
    };
    const std::string folder = std::string(FX_SOURCE_DIR) + "/tests/assets/";
    FxPresetId preset{};
    const std::string fromLibrary = withName("library:smoke.png");
    EXPECT_EQ(
        fxLoadPresetTextAt(context_, fromLibrary.data(), fromLibrary.size(), "library:campfire", &preset),
        FX_OK)
        << fxGetLastErrorMessage();
    const std::string missing = withName("no-such.png");
    EXPECT_NE(
        fxLoadPresetTextAt(context_, missing.data(), missing.size(), (folder + "a.fx.json").c_str(), &preset),
        FX_OK);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("no-such.png"), std::string::npos);
    EXPECT_EQ(fxLoadPresetTextAt(context_, missing.data(), 0, "a", &preset), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetTextAt(context_, missing.data(), missing.size(), nullptr, &preset),
              FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ReloadApi, theHostsAssetsBesideThePathAreFoundThroughItsHook)
{
    struct Archive
    {
        std::vector<std::string> asked;
        std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    } archive;
    FxContextDef def = fxDefaultContextDef();
    def.assets.user = &archive;
    def.assets.open = [](void* user, const char* name, size_t* outSize) -> const void* {
        auto& self = *static_cast<Archive*>(user);
        self.asked.push_back(name);
        *outSize = self.mesh.size();
        return std::strcmp(name, "fx/rock.obj") == 0 ? self.mesh.data() : nullptr;
    };
    def.assets.close = [](void*, const void*, size_t) {};
    fxsdk::Context context(def);
    const std::string text =
        R"({"version": 1, "emitters": [{"emission": {"rate": 10}, "appearance": {"kind": "mesh", "mesh": "rock.obj"}}]})";
    (void)context.loadTextAt(text, "fx/rocks.fx.json");
    ASSERT_FALSE(archive.asked.empty());
    EXPECT_EQ(archive.asked.front(), "fx/rock.obj");
}

TEST(ReloadMemory, aReplacementHappensForAllInstancesOrForNone)
{
    ScarceMemory memory;
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.allocator = memory.hooks();
    contextDef.workers = 1;
    FxContext* context = nullptr;
    FxScene* scene = nullptr;
    ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK);
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
    for (const char* text : {"high", "bouncing", "blast"}) {
        SCOPED_TRACE(text);
        const FxPresetId from = loadText(context, fountainPreset());
        const FxPresetId to = loadText(context, text[0] == 'h'   ? highFountain()
                                                : text[1] == 'o' ? bouncingFountain()
                                                                 : smallBlastPreset());
        for (int i = 0; i < 3; ++i) {
            FxInstanceDef def = fxDefaultInstanceDef();
            def.preset = from;
            def.seed = uint64_t(i / 2); // two that share
            (void)createIn(scene, def);
        }
        playIn(scene, 20);
        const auto simulationHash = [&] {
            uint64_t hash = 0;
            EXPECT_EQ(fxScene_GetSimulationHash(scene, &hash), FX_OK);
            return hash;
        };
        const uint64_t before = simulationHash();
        uint32_t count = 0;
        EXPECT_GT(refuseEach(
                      memory, [&] { return fxScene_ReplacePreset(scene, from, to, kSeek, &count); },
                      [&] { return simulationHash() == before && count == 0; }),
                  0u);
        EXPECT_EQ(count, 3u);
        EXPECT_NE(simulationHash(), before);
        playIn(scene, 5);
    }
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
    EXPECT_EQ(memory.blocks(), 0);
}
