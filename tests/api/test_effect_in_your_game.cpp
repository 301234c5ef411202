// The code of docs/howto/effect-in-your-game.md, compiled as C and called as a game would.
#include "tests/api/encoded_targets.h"

#include <algorithm>

extern "C" {
struct Effects
{
    FxContext* context;
    FxScene* scene;
    FxView* view;
    FxPresetId explosion;
};
int openEffects(Effects* effects, const FxViewSettings* settings);
int explode(const Effects* effects, double x, double y, double z);
int drawEffects(const Effects* effects, double seconds, const float view[16], const float projection[16],
                FxFrameDef target);
FxFrameDef windowTarget(int32_t width, int32_t height);
FxFrameDef hdrTarget(uint32_t color, uint32_t depth, int32_t width, int32_t height);
FxViewSettings gameLight(float ev100, float unit, float paper, const float sky[3]);
int useAuthorsSettings(FxContext* context, FxPresetId preset, FxViewSettings* settings);
int lookAtTheEffect(const Effects* effects, FxInstanceId instance, FxFrameDef* frame);
int drawEffectsAroundGlass(const Effects* effects, FxFrameDef target, float glassDepth,
                           void (*drawGlass)(void));
int showInMainViewOnly(const Effects* effects, FxInstanceId instance);
struct Sounds
{
    uint32_t bang, impact;
    void (*play)(uint32_t cue, const double position[3], float loudness, uint64_t userData);
    void (*addDecal)(const double position[3], const float normal[3]);
};
int hearEffects(FxScene* scene, const Sounds* sounds);
int turnBlue(FxContext* context, const Effects* effects, FxInstanceId instance);
}

using EffectInYourGame = fx::test::EncodedTargetTest;

TEST_F(EffectInYourGame, theCodeOfThePageDrawsAnExplosionIntoBothKindsOfTargets)
{
    const float sky[3] = {0.3f, 0.4f, 0.6f};
    for (const bool isHdr : {false, true}) {
        const FxViewSettings settings = gameLight(13.0f, 9830.4f, 0.7f, sky);
        Effects effects{};
        ASSERT_EQ(openEffects(&effects, &settings), 0) << fxGetLastErrorMessage();
        ASSERT_EQ(explode(&effects, 0.0, 0.0, 0.0), 0) << fxGetLastErrorMessage();
        const fx::test::EncodedTarget target = targetsOf(isHdr ? GL_RGBA16F : GL_RGBA8).front();
        const fx::test::EncodedDepth depth = depthsOf(1)[5];
        attach(target, depth);
        store(target, std::vector<float>(size_t(kSize * kSize * 4), 0.25f));
        const std::vector<float> before = stored(target);
        FxFrameDef def =
            isHdr ? hdrTarget(target.texture, depth_.name(), kSize, kSize) : windowTarget(kSize, kSize);
        if (!isHdr)
            def.framebuffer = target.framebuffer; // for want of a window
        const FxFrameDef camera = frame();
        def.origin[2] = 12.0;
        for (int i = 0; i < 8; ++i)
            ASSERT_EQ(drawEffects(&effects, 1.0 / 15.0, camera.view, camera.projection, def), 0)
                << fxGetLastErrorMessage();
        EXPECT_NE(stored(target), before);
        EXPECT_EQ(fxDestroyContext(effects.context), FX_OK);
    }
}

TEST_F(EffectInYourGame, theCodeOfThePageHearsImpactsAndPlacesDecals)
{
    static int played, decals;
    played = decals = 0;
    const float sky[3] = {0.3f, 0.4f, 0.6f};
    const FxViewSettings settings = gameLight(13.0f, 9830.4f, 0.7f, sky);
    Effects effects{};
    ASSERT_EQ(openEffects(&effects, &settings), 0) << fxGetLastErrorMessage();
    FxInstanceDef def = fxDefaultInstanceDef();
    ASSERT_EQ(fxLoadPresetLibrary(effects.context, "debris", &def.preset), FX_OK) << fxGetLastErrorMessage();
    def.userData = 42;
    FxInstanceId instance{};
    ASSERT_EQ(fxScene_CreateInstance(effects.scene, &def, &instance), FX_OK) << fxGetLastErrorMessage();
    Sounds sounds{FX_NO_CUE, 0, nullptr, nullptr};
    ASSERT_EQ(fxFindPresetCue(effects.context, def.preset, "impact", &sounds.impact), FX_OK);
    sounds.play = [](uint32_t, const double*, float, uint64_t userData) { played += userData == 42; };
    sounds.addDecal = [](const double*, const float normal[3]) { decals += normal[1] > 0.0f; };
    for (int i = 0; i < 180; ++i) {
        ASSERT_EQ(fxScene_Update(effects.scene, 1.0 / 60.0), FX_OK);
        ASSERT_EQ(hearEffects(effects.scene, &sounds), 0) << fxGetLastErrorMessage();
    }
    EXPECT_GT(decals, 0);
    EXPECT_EQ(played, decals);
    EXPECT_EQ(fxDestroyContext(effects.context), FX_OK);
}

TEST_F(EffectInYourGame, theCodeOfThePageTakesTheAuthorsSettings)
{
    const float sky[3] = {0.3f, 0.4f, 0.6f};
    FxViewSettings settings = gameLight(13.0f, 9830.4f, 0.7f, sky);
    Effects effects{};
    ASSERT_EQ(openEffects(&effects, &settings), 0) << fxGetLastErrorMessage();
    ASSERT_EQ(useAuthorsSettings(effects.context, effects.explosion, &settings), 0)
        << fxGetLastErrorMessage();
    EXPECT_EQ(settings.exposureEv100, 11.3f); // of library:explosion
    EXPECT_GT(settings.sunIlluminance[0], 0.0f);
    EXPECT_EQ(fxView_SetSettings(effects.view, &settings), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxDestroyContext(effects.context), FX_OK);
}

TEST_F(EffectInYourGame, theCodeOfThePageSeesTheEffectByItsOwnCamera)
{
    Effects effects{};
    const FxViewSettings settings = fxDefaultViewSettings();
    ASSERT_EQ(openEffects(&effects, &settings), 0) << fxGetLastErrorMessage();
    const fx::test::EncodedTarget target = targetsOf(GL_RGBA16F).front();
    ASSERT_EQ(explode(&effects, 0.0, 0.0, 0.0), 0) << fxGetLastErrorMessage();
    for (int i = 0; i < 12; ++i)
        ASSERT_EQ(fxScene_Update(effects.scene, 1.0 / 60.0), FX_OK);
    FxInstanceId instance{};
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetInstances(effects.scene, &instance, 1, &count), FX_OK);
    FxFrameDef def = hdrTarget(target.texture, 0, kSize, kSize);
    ASSERT_EQ(lookAtTheEffect(&effects, instance, &def), 0) << fxGetLastErrorMessage();
    EXPECT_GT(def.origin[2], 1.0);
    store(target, std::vector<float>(size_t(kSize * kSize * 4), 0.25f));
    const std::vector<float> before = stored(target);
    ASSERT_EQ(fxView_Render(effects.view, &def), FX_OK) << fxGetLastErrorMessage();
    const size_t middle = (size_t(kSize) * kSize / 2 + kSize / 2) * 4; // where the camera looks
    EXPECT_NE(stored(target)[middle], before[middle]);
    EXPECT_EQ(fxDestroyContext(effects.context), FX_OK);
}

TEST_F(EffectInYourGame, theCodeOfThePageDrawsEffectsBeforeAndBehindGlass)
{
    static int drawn;
    drawn = 0;
    const float sky[3] = {0.3f, 0.4f, 0.6f};
    const FxViewSettings settings = gameLight(13.0f, 9830.4f, 0.7f, sky);
    Effects effects{};
    ASSERT_EQ(openEffects(&effects, &settings), 0) << fxGetLastErrorMessage();
    ASSERT_EQ(explode(&effects, 0.0, 0.0, 0.0), 0) << fxGetLastErrorMessage();
    const fx::test::EncodedTarget target = targetsOf(GL_RGBA16F).front();
    attach(target, depthsOf(1)[5]);
    FxFrameDef def = hdrTarget(target.texture, depth_.name(), kSize, kSize);
    std::copy_n(frame().projection, 16, def.projection);
    def.origin[2] = 12.0;
    for (int i = 0; i < 30; ++i)
        ASSERT_EQ(fxScene_Update(effects.scene, 1.0 / 60.0), FX_OK);
    store(target, std::vector<float>(size_t(kSize * kSize * 4), 0.25f));
    const std::vector<float> empty = stored(target);
    ASSERT_EQ(drawEffectsAroundGlass(&effects, def, 12.0f, [] { ++drawn; }), 0) << fxGetLastErrorMessage();
    EXPECT_EQ(drawn, 1);
    EXPECT_NE(stored(target), empty);
    FxInstanceId instance{};
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetInstances(effects.scene, &instance, 1, &count), FX_OK);
    ASSERT_EQ(turnBlue(effects.context, &effects, instance), 0) << fxGetLastErrorMessage();
    ASSERT_EQ(showInMainViewOnly(&effects, instance), 0) << fxGetLastErrorMessage();
    def.visibilityMask = 2u; // of the map
    store(target, std::vector<float>(size_t(kSize * kSize * 4), 0.25f));
    ASSERT_EQ(fxView_Render(effects.view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(stored(target), empty);
    EXPECT_EQ(fxDestroyContext(effects.context), FX_OK);
}
