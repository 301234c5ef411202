// Instances in layers, which are drawn one over the other.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace {

/// A cloud of still, dense dust of one color about its origin.
std::string dust(const std::string& color)
{
    return R"({"version": 1, "name": "dust", "ground": false, "emitters": [
        {"layer": "dust", "shape": "sphere", "size": 0.2, "emission": {"bursts": [{"time": 0, "count": 40}]},
         "lifetime": 100, "radius": 0.4, "opticalDepth": 4, "albedoOverLife": )" +
           color + R"(, "forces": {"gravity": 0}}]})";
}

/// A single sprite of one color.
std::string card(const std::string& color)
{
    return R"({"version": 1, "name": "card", "ground": false, "emitters": [
        {"shape": "point", "emission": {"bursts": [{"time": 0, "count": 1}]}, "lifetime": 100, "radius": 0.5,
         "forces": {"gravity": 0},
         "appearance": {"kind": "sprite", "order": "depth", "blend": "alpha", "luminance": 20000,
                        "colorOverLife": )" +
           color + "}}]}";
}

constexpr const char* kRed = "[0.9, 0.05, 0.05]";
constexpr const char* kBlue = "[0.05, 0.05, 0.9]";

class ViewSortLayers : public fx::test::ViewApiTest
{
protected:
    void SetUp() override
    {
        const FxSceneDef def = fxDefaultSceneDef();
        ASSERT_EQ(fxCreateScene(context_, &def, &stage_), FX_OK);
    }
    FxInstanceId add(const std::string& preset, double z, int32_t layer, int32_t sortKey = 0)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset =
            preset.find('{') == std::string::npos ? library(preset) : fx::test::loadText(context_, preset);
        def.position[2] = z;
        def.layer = layer;
        def.sortKey = sortKey;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(stage_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    FxPresetId library(const std::string& name)
    {
        FxPresetId preset{};
        EXPECT_EQ(fxLoadPresetLibrary(context_, name.c_str(), &preset), FX_OK) << fxGetLastErrorMessage();
        return preset;
    }
    void step(int updates)
    {
        for (int i = 0; i < updates; ++i)
            ASSERT_EQ(fxScene_Update(stage_, fx::test::kFrame), FX_OK);
    }
    static FxViewSettings settingsOf(uint32_t composition)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.lightSlices = 0;
        settings.composition = composition;
        for (int i = 0; i < 3; ++i) {
            settings.sunIlluminance[i] = 60'000.0f;
            settings.skyLuminance[i] = 4'000.0f;
        }
        return settings;
    }
    FxView* makeView(const FxViewSettings& settings)
    {
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, stage_, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        return view;
    }
    std::vector<float> drawn(FxView* view)
    {
        fillPicture();
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    }
    std::vector<float> drawnAnew(uint32_t composition)
    {
        FxView* const view = makeView(settingsOf(composition));
        std::vector<float> shown = drawn(view);
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        return shown;
    }
    /// Red minus blue in the middle of the picture.
    static float redness(const std::vector<float>& shown)
    {
        const size_t middle = size_t(4) * (size_t(kSize / 2) * kSize + kSize / 2);
        return shown[middle] - shown[middle + 2];
    }
    uint64_t hash()
    {
        uint64_t value = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(stage_, &value), FX_OK);
        return value;
    }

    FxScene* stage_ = nullptr;
};

} // namespace

TEST_F(ViewSortLayers, aFarInstanceOfAHigherLayerCoversANearOne)
{
    const FxInstanceId nearer = add(dust(kRed), 0.0, 0);
    const FxInstanceId farther = add(dust(kBlue), -2.0, 0);
    step(3);
    for (const uint32_t composition :
         {uint32_t(FX_COMPOSITION_SORTED), uint32_t(FX_COMPOSITION_SLABS), uint32_t(FX_COMPOSITION_VOLUME)})
    {
        SCOPED_TRACE(composition);
        ASSERT_EQ(fxScene_SetLayer(stage_, farther, 0, 0), FX_OK);
        ASSERT_EQ(fxScene_SetLayer(stage_, nearer, 0, 0), FX_OK);
        FxView* const view = makeView(settingsOf(composition));
        const std::vector<float> plain = drawn(view);
        EXPECT_GT(redness(plain), 0.1f);
        ASSERT_EQ(fxScene_SetLayer(stage_, farther, 1, 0), FX_OK); // takes effect with the next frame
        EXPECT_LT(redness(drawn(view)), -0.1f);
        ASSERT_EQ(fxScene_SetLayer(stage_, nearer, 2, 0), FX_OK);
        EXPECT_GT(redness(drawn(view)), 0.1f);
        ASSERT_EQ(fxScene_SetLayer(stage_, nearer, -1, 0), FX_OK);
        EXPECT_LT(redness(drawn(view)), -0.1f);
        EXPECT_EQ(fxDestroyView(view), FX_OK);
    }
}

TEST_F(ViewSortLayers, aSingleLayerOfAnyNumberChangesNoBit)
{
    const FxInstanceId fire = add("campfire", 0.0, 0);
    const FxInstanceId smoke = add("smoke-column", -1.0, 0);
    step(30);
    const uint64_t before = hash();
    const std::vector<float> plain = drawnAnew(FX_COMPOSITION_SORTED);
    for (const int32_t layer : {FX_LOWEST_LAYER, 3, FX_HIGHEST_LAYER}) {
        ASSERT_EQ(fxScene_SetLayer(stage_, fire, layer, 7), FX_OK);
        ASSERT_EQ(fxScene_SetLayer(stage_, smoke, layer, 7), FX_OK);
        EXPECT_EQ(drawnAnew(FX_COMPOSITION_SORTED), plain);
    }
    ASSERT_EQ(fxScene_SetLayer(stage_, fire, 0, 0), FX_OK);
    ASSERT_EQ(fxScene_SetLayer(stage_, smoke, 0, 0), FX_OK);
    EXPECT_EQ(drawnAnew(FX_COMPOSITION_SORTED), plain);
    EXPECT_EQ(hash(), before);
}

TEST_F(ViewSortLayers, aLayerIsDrawnAsAFrameOfItsInstances)
{
    const FxInstanceId fire = add("campfire", 0.0, 0);
    const FxInstanceId smoke = add("smoke-column", -1.0, 1);
    const FxInstanceId sparks = add("sparks", 0.5, 1);
    step(30);
    const std::vector<float> layered = drawnAnew(FX_COMPOSITION_SORTED);

    fillPicture(); // the same by two frames with masks, the second over the first
    const auto mask = [&](FxInstanceId id, uint32_t bits) {
        EXPECT_EQ(fxScene_SetVisibilityMask(stage_, id, bits), FX_OK);
        EXPECT_EQ(fxScene_SetLayer(stage_, id, 0, 0), FX_OK);
    };
    mask(fire, 1);
    mask(smoke, 2);
    mask(sparks, 2);
    FxViewSettings settings = settingsOf(FX_COMPOSITION_SORTED);
    for (const uint32_t bits : {1u, 2u}) {
        settings.shimmerStrength = bits == 1u ? 0.0f : 1.0f; // only the last completes the picture
        FxView* const view = makeView(settings);
        FxFrameDef def = frame();
        def.visibilityMask = bits;
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxDestroyView(view), FX_OK);
    }
    EXPECT_LE(fx::test::largestShownDifference(layered, picture()), 1.0f / 255.0f);
}

TEST_F(ViewSortLayers, theGreaterSortKeyIsOnTopAtEqualDepth)
{
    const FxInstanceId red = add(card(kRed), 0.0, 0);
    const FxInstanceId blue = add(card(kBlue), 0.0, 0);
    step(3);
    FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
    const float plain = redness(drawn(view));
    EXPECT_LT(plain, -0.1f); // the later instance
    ASSERT_EQ(fxScene_SetLayer(stage_, red, 0, 1), FX_OK);
    EXPECT_GT(redness(drawn(view)), 0.1f);
    ASSERT_EQ(fxScene_SetLayer(stage_, blue, 0, 2), FX_OK);
    EXPECT_EQ(redness(drawn(view)), plain);
    ASSERT_EQ(fxScene_SetLayer(stage_, red, 0, INT32_MAX), FX_OK);
    ASSERT_EQ(fxScene_SetLayer(stage_, blue, 0, INT32_MIN), FX_OK);
    EXPECT_GT(redness(drawn(view)), 0.1f);
    const double nearer[3] = {0, 0, 0.1}; // depth comes first
    const float rotation[4] = {0, 0, 0, 1};
    ASSERT_EQ(fxScene_SetTransform(stage_, blue, nearer, rotation, 1.0f), FX_OK);
    step(2);
    EXPECT_LT(redness(drawn(view)), -0.1f);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, orderSmallEmittersThatShareTheirRows)
{
    std::vector<FxInstanceId> reds;
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = fx::test::loadText(context_, card(kRed));
    for (int i = 0; i < 30; ++i) {
        def.seed = uint64_t(i); // or they would be one simulation
        ASSERT_EQ(fxScene_CreateInstance(stage_, &def, &reds.emplace_back()), FX_OK);
    }
    const FxInstanceId blue = add(card(kBlue), 0.0, 0, -1);
    step(3);
    FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
    EXPECT_GT(redness(drawn(view)), 0.1f);
    ASSERT_EQ(fxScene_SetLayer(stage_, blue, 0, 1), FX_OK);
    EXPECT_LT(redness(drawn(view)), -0.1f);
    for (const FxInstanceId red : reds)
        ASSERT_EQ(fxScene_SetLayer(stage_, red, 1, 0), FX_OK);
    EXPECT_GT(redness(drawn(view)), 0.1f);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, areInSavedStates)
{
    (void)add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), -2.0, 5, -3);
    step(3);
    const std::vector<float> wanted = drawnAnew(FX_COMPOSITION_SORTED);
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(stage_, nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(stage_, state.data(), state.size(), &size), FX_OK);
    ASSERT_EQ(fxScene_DestroyAllInstances(stage_), FX_OK);
    ASSERT_EQ(fxScene_RestoreState(stage_, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(drawnAnew(FX_COMPOSITION_SORTED), wanted);
    EXPECT_LT(redness(wanted), -0.1f);
}

TEST_F(ViewSortLayers, meetRangesOfDepthWithinEachRange)
{
    (void)add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), -3.0, 1);
    step(3);
    FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
    fillPicture();
    FxFrameDef def = frame();
    def.rangePart = FX_RANGE_FIRST;
    def.rangeNear = 4.5f; // between the clouds: the far range holds the blue one
    ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_LT(redness(picture()), -0.1f);
    def.rangePart = FX_RANGE_LAST;
    def.rangeNear = 0.0f;
    def.rangeFar = 4.5f;
    ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(redness(picture()), 0.1f); // the near range is drawn over all layers of the far one
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, areToneMappedOnce)
{
    const FxInstanceId first = add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), -2.0, 0);
    step(3);
    FxViewSettings settings = settingsOf(FX_COMPOSITION_SORTED);
    settings.toneMap = 1;
    FxView* const view = makeView(settings);
    const std::vector<float> plain = drawn(view);
    ASSERT_EQ(fxScene_SetLayer(stage_, first, -1, 0), FX_OK);
    const std::vector<float> layered = drawn(view);
    EXPECT_NE(plain.front(), kBackground); // a corner without effects
    EXPECT_EQ(layered.front(), plain.front());
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, areToneMappedOnceInATextureOfSrgb)
{
    const FxInstanceId shown = add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), 1e4, 0); // behind the camera
    step(3);
    auto target = fx::render::GlTexture::create(*host_, kSize, kSize, GL_SRGB8_ALPHA8, "codes");
    ASSERT_TRUE(target.ok());
    FxViewSettings settings = settingsOf(FX_COMPOSITION_SORTED);
    settings.toneMap = 1;
    FxView* const view = makeView(settings);
    const auto drawnCodes = [&] {
        const float gray[4] = {kBackground, kBackground, kBackground, 1.0f};
        host_->gl.ClearTexImage(target->name(), 0, GL_RGBA, GL_FLOAT, gray);
        FxFrameDef def = frame();
        def.colorTexture = target->name();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        return fx::render::readTexture(*host_, target->name(), kSize, kSize, 4);
    };
    const std::vector<float> plain = drawnCodes();
    ASSERT_EQ(fxScene_SetLayer(stage_, shown, -1, 0), FX_OK);
    const std::vector<float> layered = drawnCodes();
    EXPECT_LE(fx::test::largestShownDifference(layered, plain), 3.0f / 255.0f); // rounded once more
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, destroyedInstancesKeepTheirLayerWhileTheyAreShown)
{
    const FxInstanceId dying = add(dust(kRed), 0.0, 3);
    (void)add(dust(kBlue), -2.0, 3);
    step(3);
    FxViewSettings settings = settingsOf(FX_COMPOSITION_SORTED);
    settings.outputs = FX_OUTPUT_INSTANCE_ID; // refused in several layers
    FxView* const view = makeView(settings);
    EXPECT_GT(redness(drawn(view)), 0.1f);
    ASSERT_EQ(fxScene_DestroyInstance(stage_, dying), FX_OK);
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(stage_, nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(stage_, state.data(), state.size(), &size), FX_OK);
    for (int i = 0; i < 6; ++i) {
        SCOPED_TRACE(i);
        (void)drawn(view);
        step(1);
    }
    EXPECT_LT(redness(drawn(view)), -0.1f);
    EXPECT_EQ(fxScene_RestoreState(stage_, state.data(), state.size()), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, hiddenInstancesStayHiddenWhenTheyAreDestroyed)
{
    const FxInstanceId hidden = add(dust(kRed), 0.0, 0);
    ASSERT_EQ(fxScene_SetVisibilityMask(stage_, hidden, 0), FX_OK);
    step(3);
    FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
    const std::vector<float> before = drawn(view);
    ASSERT_EQ(fxScene_DestroyInstance(stage_, hidden), FX_OK);
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(drawn(view), before) << i;
        step(1);
    }
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, areAllDrawnAfterAPreparationThatRanOutOfMemory)
{
    (void)add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), -2.0, 1);
    step(3);
    const FxFrameDef def = frame();
    FxResult result = FX_ERROR_OUT_OF_MEMORY;
    uint64_t n = 1;
    for (; result == FX_ERROR_OUT_OF_MEMORY && n < 300 && !HasFailure(); ++n) {
        FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
        memory_.failFrom(n);
        result = fxView_PrepareLights(view, &def);
        memory_.failFrom(0);
        EXPECT_LT(redness(drawn(view)), -0.1f) << n;
        EXPECT_EQ(fxDestroyView(view), FX_OK);
    }
    EXPECT_EQ(result, FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(n, 5u);
}

TEST_F(ViewSortLayers, showTheSameToBothEyes)
{
    (void)add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), -2.0, 1);
    step(3);
    const std::vector<float> wanted = drawnAnew(FX_COMPOSITION_SORTED);
    FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
    auto second = fx::render::GlTexture::create(*host_, kSize, kSize, GL_RGBA32F, "second eye");
    ASSERT_TRUE(second.ok());
    fillPicture();
    const float gray[4] = {kBackground, kBackground, kBackground, 1.0f};
    host_->gl.ClearTexImage(second->name(), 0, GL_RGBA, GL_FLOAT, gray);
    const FxFrameDef first = frame();
    FxFrameDef other = first;
    other.colorTexture = second->name();
    ASSERT_EQ(fxView_RenderStereo(view, &first, &other), FX_OK) << fxGetLastErrorMessage();
    EXPECT_LE(fx::test::largestShownDifference(picture(), wanted), 1.0f / 255.0f);
    const std::vector<float> right = fx::render::readTexture(*host_, second->name(), kSize, kSize, 4);
    EXPECT_LE(fx::test::largestShownDifference(right, wanted), 1.0f / 255.0f);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, repeatWithoutAllocationsAndEndWhenTheyAreUnused)
{
    const FxInstanceId lower = add(dust(kRed), 0.0, 0);
    (void)add(dust(kBlue), -2.0, 1);
    step(3);
    FxView* const view = makeView(settingsOf(FX_COMPOSITION_SORTED));
    const std::vector<float> shown = drawn(view);
    EXPECT_EQ(drawn(view), shown);
    const auto statisticsOf = [&] {
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        EXPECT_EQ(fxView_GetStatistics(view, &statistics), FX_OK);
        return statistics;
    };
    const FxViewStatistics two = statisticsOf();
    EXPECT_EQ(two.allocations, 0u);
    EXPECT_EQ(two.blobs, 80u); // of both layers
    uint32_t groups = 0;
    for (const uint32_t count : two.lodGroups)
        groups += count;
    EXPECT_EQ(groups, 2u);
    const int64_t blocks = memory_.blocks();
    ASSERT_EQ(fxScene_SetLayer(stage_, lower, 1, 0), FX_OK);
    for (int i = 0; i < 150; ++i)
        (void)drawn(view);
    EXPECT_EQ(statisticsOf().blobs, 80u);
    EXPECT_LT(memory_.blocks(), blocks); // the renderer of the lower layer is gone
    EXPECT_GT(two.sharedBytes, statisticsOf().sharedBytes);
    ASSERT_EQ(fxScene_SetLayer(stage_, lower, 0, 0), FX_OK);
    (void)drawn(view);
    ASSERT_EQ(fxView_SetScene(view, scene_), FX_OK);
    EXPECT_EQ(statisticsOf().blobs, 0u); // of a renderer that has drawn nothing
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewSortLayers, refuseWhatTheyCannotShowAndWrongNumbers)
{
    const FxInstanceId id = add(dust(kRed), 0.0, 0);
    const FxInstanceId upper = add(dust(kBlue), -2.0, 1);
    step(3);
    FxViewSettings settings = settingsOf(FX_COMPOSITION_SORTED);
    settings.layerOutputs = 1;
    FxView* const view = makeView(settings);
    const FxFrameDef def = frame();
    fillPicture();
    const std::vector<float> before = picture();
    EXPECT_EQ(fxView_Render(view, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("layerOutputs"), std::string::npos);
    EXPECT_EQ(picture(), before);
    ASSERT_EQ(fxScene_SetLayer(stage_, id, 1, 0), FX_OK);
    EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    for (const int32_t layer : {FX_LOWEST_LAYER - 1, FX_HIGHEST_LAYER + 1, INT32_MIN, INT32_MAX}) {
        EXPECT_EQ(fxScene_SetLayer(stage_, upper, layer, 0), FX_ERROR_INVALID_ARGUMENT) << layer;
        FxInstanceDef bad = fxDefaultInstanceDef();
        bad.preset = library("sparks");
        bad.layer = layer;
        FxInstanceId none{};
        EXPECT_EQ(fxScene_CreateInstance(stage_, &bad, &none), FX_ERROR_INVALID_ARGUMENT);
    }
    EXPECT_EQ(fxScene_SetLayer(nullptr, upper, 0, 0), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetLayer(stage_, FxInstanceId{}, 0, 0), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}
