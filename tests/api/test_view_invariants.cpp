// What a frame costs follows what is asked for and what is seen, counted exactly.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <string>

namespace {

using Names = std::vector<std::string>;

/// The work of some frames of a scene.
struct Work
{
    uint64_t particleSteps, neighborPairs, blobs, fragments;
};

class ViewInvariants : public fx::test::ViewApiTest
{
protected:
    Names passesWith(const FxViewSettings& settings)
    {
        EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
        FxFrameDef def = frame();
        def.origin[0] += 1e-4 * ++drawn_; // nothing that the last frame kept serves again
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return fx::test::passNamesOf(view_);
    }

    /// `seen` of eight instances before the camera, the others behind it.
    Work workOf(FxPresetId preset, int seen, uint32_t quality)
    {
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        FxScene* scene = nullptr;
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        for (int i = 0; i < 8; ++i) {
            FxInstanceDef def = fxDefaultInstanceDef();
            def.preset = preset;
            def.seed = uint64_t(i);
            def.quality = quality;
            def.position[0] = 0.3 * i;
            def.position[2] = i < seen ? 0.0 : 100.0;
            FxInstanceId id{};
            EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK);
        }
        const FxFrameDef def = frame();
        FxFocus focus = fxDefaultFocus();
        std::copy_n(def.origin, 3, focus.origin);
        std::copy_n(def.projection, 16, focus.projection);
        EXPECT_EQ(fxScene_SetFocus(scene, &focus, 1), FX_OK);
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK) << fxGetLastErrorMessage();
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene, nullptr, &view), FX_OK);
        fillPicture();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        FxSceneStatistics simulated{};
        simulated.structSize = sizeof simulated;
        EXPECT_EQ(fxScene_GetStatistics(scene, &simulated), FX_OK);
        FxViewStatistics shown{};
        shown.structSize = sizeof shown;
        EXPECT_EQ(fxView_GetStatistics(view, &shown), FX_OK);
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
        return {simulated.particleSteps, simulated.neighborPairs, shown.blobs, shown.estimatedFragments};
    }

    int drawn_ = 0; ///< frames of passesWith()
};

} // namespace

TEST_F(ViewInvariants, aFeatureThatIsSwitchedOffAddsNoPass) // I4
{
    update(30);
    FxViewSettings all = fxDefaultViewSettings();
    all.toneMap = 1;
    const Names everything{
        "light list",  "scene distance", "blob upload",       "blob light", "media",         "composite",
        "heat offset", "heat shimmer",   "heat shimmer back", "dazzle sum", "dazzle budget", "dazzle deal",
        "tone map",    "present"};
    Names first = everything; // the flames cast light, and no frame has filled planes for it yet
    first.insert(first.begin() + 1, {"light slice casters", "light slices"});
    EXPECT_EQ(passesWith(all), first); // the control: each of them is there when it is on
    // from here on only the eye moves, and the planes serve again
    const auto without = [&everything](std::vector<std::string> gone) {
        Names left;
        std::copy_if(everything.begin(), everything.end(), std::back_inserter(left), [&](const auto& name) {
            return std::find(gone.begin(), gone.end(), name) == gone.end();
        });
        return left;
    };
    FxViewSettings settings = all;
    settings.shimmerStrength = 0;
    EXPECT_EQ(passesWith(settings), without({"heat offset", "heat shimmer", "heat shimmer back"}));
    settings = all;
    settings.dazzle = 0;
    EXPECT_EQ(passesWith(settings), without({"dazzle sum", "dazzle budget", "dazzle deal"}));
    settings = all;
    settings.toneMap = 0;
    EXPECT_EQ(passesWith(settings), without({"tone map"}));
    settings = all;
    settings.detail = 0; // a permutation of a program, no pass
    EXPECT_EQ(passesWith(settings), everything);
    settings = all;
    settings.toneMap = settings.dazzle = 0;
    settings.shimmerStrength = 0;
    EXPECT_EQ(passesWith(settings),
              (Names{"light list", "scene distance", "blob upload", "blob light", "media", "composite"}));
}

TEST_F(ViewInvariants, workGrowsWithWhatIsSeenAndIsThatOfTheSeenAlone) // I5
{
    const FxPresetId burst = fx::test::loadText(context_, fx::test::burstPreset(40, 3.0));
    Work before = workOf(burst, 0, FX_QUALITY_DEFAULT);
    EXPECT_EQ(before.particleSteps, 0u);
    EXPECT_EQ(before.blobs, 0u);
    EXPECT_EQ(before.fragments, 0u);
    const uint64_t one = workOf(burst, 1, FX_QUALITY_DEFAULT).particleSteps;
    for (int seen = 1; seen <= 8; ++seen) {
        const Work work = workOf(burst, seen, FX_QUALITY_DEFAULT);
        EXPECT_GT(work.particleSteps, before.particleSteps) << seen;
        EXPECT_GE(work.blobs, before.blobs) << seen;
        EXPECT_GE(work.fragments, before.fragments) << seen;
        EXPECT_EQ(work.particleSteps, one * uint64_t(seen)) << seen;
        before = work;
    }
}

#if FXSDK_WITH_SPH
TEST_F(ViewInvariants, workGrowsWithTheQualityOfAGas) // I5
{
    const FxPresetId gas =
        fx::test::loadText(context_, R"({"version": 1, "ground": false, "gas": [{"particles": 60}]})");
    const Work low = workOf(gas, 1, FX_QUALITY_LOW), medium = workOf(gas, 1, FX_QUALITY_MEDIUM),
               high = workOf(gas, 1, FX_QUALITY_HIGH);
    EXPECT_LT(low.particleSteps, medium.particleSteps);
    EXPECT_LT(medium.particleSteps, high.particleSteps);
    EXPECT_LT(low.neighborPairs, medium.neighborPairs);
    EXPECT_LT(medium.neighborPairs, high.neighborPairs);
    EXPECT_LT(low.blobs, high.blobs);
}
#endif

TEST_F(ViewInvariants, aViewThatSleepsStillRefusesBadFramesAndWakesForWhateverThereIsToDraw) // I2
{
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    FxView* view = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    ASSERT_EQ(fxCreateView(context_, scene, &settings, &view), FX_OK);
    const FxFrameDef good = frame();
    const auto drawnBy = [&](int frames) {
        FxViewStatistics shown{};
        shown.structSize = sizeof shown;
        for (int i = 0; i < frames; ++i) {
            EXPECT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
            EXPECT_EQ(fxView_Render(view, &good), FX_OK) << fxGetLastErrorMessage();
        }
        EXPECT_EQ(fxView_GetStatistics(view, &shown), FX_OK);
        return shown.passes;
    };
    EXPECT_EQ(drawnBy(10), 0u);
    for (int kind = 0; kind < 4; ++kind) {
        FxFrameDef bad = good;
        if (kind == 0)
            bad.view[0] = 2.0f;
        if (kind == 1)
            bad.projection[5] = 0.0f;
        if (kind == 2)
            bad.colorTexture = 0;
        EXPECT_EQ(fxView_Render(view, kind == 3 ? nullptr : &bad), FX_ERROR_INVALID_ARGUMENT) << kind;
        EXPECT_EQ(fxView_Render(view, &good), FX_OK);
    }
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = fx::test::loadText(context_, fx::test::burstPreset(40, 0.2));
    def.destroyWhenFinished = 1;
    for (int life = 0; life < 3; ++life) {
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK) << fxGetLastErrorMessage();
        EXPECT_GT(drawnBy(2), 0u) << life;
        EXPECT_EQ(drawnBy(life == 1 ? 400 : 40), 0u) << life; // beyond the time until it gives memory back
    }
    settings.toneMap = 1; // of the host's own picture
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    EXPECT_GT(drawnBy(1), 0u);
    settings.toneMap = 0;
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    EXPECT_EQ(drawnBy(3), 0u);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
    EXPECT_EQ(fxDestroyScene(scene), FX_OK);
}
