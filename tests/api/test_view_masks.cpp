// Frames that show some of the instances of a scene.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace {

constexpr const char* kBlocks =
    R"({"version": 1, "blocks": [{
        "types": [{"name": "puff", "builder": {"form": "cloud", "size": [1, 1, 1], "count": 30, "radius": 0.2}}],
        "of": [{"type": "puff"}],
        "emitter": {"shape": "sphere", "size": 0.6, "position": [0, 1, 0],
                    "emission": {"bursts": [{"time": 0, "count": 8}]}, "lifetime": 9, "speed": 0.1,
                    "radius": 0.4, "opticalDepth": 4, "forces": {"gravity": 0}}}]})";

/// Places of two effects of a scene. A place without a preset stays empty.
struct Pair
{
    std::array<const char*, 2> presets; ///< names of the library, or texts
    std::array<uint32_t, 2> masks{~0u, ~0u};
};

class ViewMasks : public fx::test::ViewApiTest
{
protected:
    FxScene* makeScene(const Pair& pair, int updates)
    {
        FxScene* scene = nullptr;
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        for (size_t i = 0; i < 2; ++i) {
            if (!pair.presets[i])
                continue;
            FxInstanceDef def = fxDefaultInstanceDef();
            if (*pair.presets[i] == '{')
                def.preset = fx::test::loadText(context_, pair.presets[i]);
            else
                EXPECT_EQ(fxLoadPresetLibrary(context_, pair.presets[i], &def.preset), FX_OK)
                    << fxGetLastErrorMessage();
            def.position[0] = i == 0 ? -0.7 : 0.7;
            def.seed = i;
            def.visibilityMask = pair.masks[i];
            EXPECT_EQ(fxScene_CreateInstance(scene, &def, &ids_[i]), FX_OK) << fxGetLastErrorMessage();
        }
        step(scene, updates);
        return scene;
    }
    static void step(FxScene* scene, int updates)
    {
        for (int i = 0; i < updates; ++i)
            ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
    }
    FxView* makeView(FxScene* scene, uint32_t composition = FX_COMPOSITION_SORTED)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.composition = composition;
        settings.sunDirection[0] = 1.0f; // one effect stands in the shadow of the other
        settings.sunDirection[1] = settings.sunDirection[2] = 0.0f;
        for (int i = 0; i < 3; ++i) {
            settings.sunIlluminance[i] = 60'000.0f;
            settings.skyLuminance[i] = 4'000.0f;
        }
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        return view;
    }
    FxFrameDef masked(uint32_t mask) const
    {
        FxFrameDef def = frame();
        def.origin[1] = 1.0;
        def.visibilityMask = mask;
        return def;
    }
    std::vector<float> drawn(FxView* view, uint32_t mask)
    {
        fillPicture();
        const FxFrameDef def = masked(mask);
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    }
    /// By a view without history: the places of light slices depend on what was shown before.
    std::vector<float> drawnAnew(FxScene* scene, uint32_t composition, uint32_t mask)
    {
        FxView* const view = makeView(scene, composition);
        const std::vector<float> result = drawn(view, mask);
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        return result;
    }

    std::array<FxInstanceId, 2> ids_{};
};

} // namespace

TEST_F(ViewMasks, showWhatAViewOfAFewerInstancesShows)
{
    constexpr std::array<std::array<const char*, 2>, 3> kPairs{
        {{"campfire", "smoke-column"}, {"sparks", "fireworks"}, {kBlocks, "campfire"}}};
    constexpr int kUpdates = 40;
    for (const auto& presets : kPairs) {
        const bool hasBlocks = presets == kPairs[2];
        SCOPED_TRACE(std::string(hasBlocks ? "blocks" : presets[0]) + " and " + presets[1]);
        const uint32_t composition =
            hasBlocks ? uint32_t(FX_COMPOSITION_SLABS) : uint32_t(FX_COMPOSITION_SORTED);
        FxScene* const both = makeScene({presets, {1u, 6u}}, kUpdates);
        const std::vector<float> all = drawnAnew(both, composition, ~0u);
        for (size_t shown = 0; shown < 2; ++shown) {
            Pair alone{};
            alone.presets[shown] = presets[shown];
            FxScene* const single = makeScene(alone, kUpdates);
            const std::vector<float> wanted = drawnAnew(single, composition, ~0u);
            EXPECT_LE(
                fx::test::largestShownDifference(drawnAnew(both, composition, shown == 0 ? 1u : 4u), wanted),
                1.0f / 255.0f);
            EXPECT_GT(fx::test::largestShownDifference(all, wanted),
                      8.0f / 255.0f); // the other is seen as well
            ASSERT_EQ(fxDestroyScene(single), FX_OK);
        }
        EXPECT_EQ(drawnAnew(both, composition, 3u), all);
        fillPicture();
        const std::vector<float> empty = picture();
        EXPECT_EQ(drawnAnew(both, composition, 8u), empty);
        EXPECT_EQ(drawnAnew(both, composition, 0u), empty);
        ASSERT_EQ(fxDestroyScene(both), FX_OK);
    }
}

TEST_F(ViewMasks, takeEffectWithTheNextFrameAndDoNotChangeTheSimulation)
{
    FxScene* const scene = makeScene({{"campfire", "campfire"}}, 40);
    FxView* const view = makeView(scene);
    const auto hashOf = [](FxScene* of) {
        uint64_t hash = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(of, &hash), FX_OK);
        return hash;
    };
    const uint64_t before = hashOf(scene);
    const std::vector<float> all = drawn(view, 1u);
    ASSERT_EQ(fxScene_SetVisibilityMask(scene, ids_[0], 2u), FX_OK);
    const std::vector<float> second = drawn(view, 1u);
    EXPECT_GT(fx::test::largestShownDifference(second, all), 8.0f / 255.0f);
    EXPECT_LE(fx::test::largestShownDifference(drawn(view, 1u), second), 1.0f / 255.0f);
    EXPECT_LE(fx::test::largestShownDifference(drawn(view, 3u), all), 1.0f / 255.0f);
    EXPECT_EQ(hashOf(scene), before);
    ASSERT_EQ(fxScene_SetVisibilityMask(scene, ids_[0], ~0u), FX_OK);
    EXPECT_LE(fx::test::largestShownDifference(drawn(view, 1u), all), 1.0f / 255.0f);
    EXPECT_EQ(fxScene_SetVisibilityMask(nullptr, ids_[0], 1u), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetVisibilityMask(scene, FxInstanceId{}, 1u), FX_ERROR_STALE_ID);
}

TEST_F(ViewMasks, areInSavedStates)
{
    FxScene* const scene = makeScene({{"campfire", "campfire"}, {2u, 1u}}, 40);
    FxView* const view = makeView(scene);
    const std::vector<float> wanted = drawn(view, 1u);
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(scene, nullptr, 0, &size), FX_OK);
    std::vector<unsigned char> state(size);
    ASSERT_EQ(fxScene_SaveState(scene, state.data(), state.size(), &size), FX_OK);
    ASSERT_EQ(fxScene_SetVisibilityMask(scene, ids_[0], 1u), FX_OK);
    ASSERT_EQ(fxScene_SetVisibilityMask(scene, ids_[1], 2u), FX_OK);
    EXPECT_GT(fx::test::largestShownDifference(drawn(view, 1u), wanted), 8.0f / 255.0f);
    ASSERT_EQ(fxScene_RestoreState(scene, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> restored = drawn(view, 1u); // at the last step, not before it
    EXPECT_GT(fx::test::largestShownDifference(drawn(view, 2u), restored), 8.0f / 255.0f);
    ASSERT_EQ(fxScene_SetVisibilityMask(scene, ids_[0], 2u), FX_OK);
    ASSERT_EQ(fxScene_SetVisibilityMask(scene, ids_[1], 1u), FX_OK);
    EXPECT_LE(fx::test::largestShownDifference(drawn(view, 1u), restored), 1.0f / 255.0f);
}

TEST_F(ViewMasks, areACauseOfBeingUnseen)
{
    FxScene* const scene = makeScene({{"campfire", "campfire"}, {2u, 1u}}, 40);
    const auto causeOf = [&](FxInstanceId id, const FxFrameDef* camera) {
        FxVisibility report{};
        report.structSize = sizeof report;
        EXPECT_EQ(fxScene_ExplainVisibility(scene, id, camera, &report), FX_OK) << fxGetLastErrorMessage();
        return report.cause;
    };
    const FxFrameDef def = masked(1u);
    EXPECT_EQ(causeOf(ids_[0], &def), uint32_t(FX_VISIBILITY_MASKED));
    EXPECT_EQ(causeOf(ids_[1], &def), uint32_t(FX_VISIBILITY_IN_VIEW));
    EXPECT_EQ(causeOf(ids_[0], nullptr),
              uint32_t(FX_VISIBILITY_IN_VIEW)); // without a camera there is no mask
    EXPECT_NE(std::string(fxGetVisibilityText(FX_VISIBILITY_MASKED)).find("fxScene_SetVisibilityMask"),
              std::string::npos);
}
