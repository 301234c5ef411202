// What the functions of views refuse.
#include "tests/api/view_fixture.h"

#include <cstring>
#include <limits>
#include <thread>

using ViewArguments = fx::test::ViewApiTest;

namespace {
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
} // namespace

TEST_F(ViewArguments, aSettingOutOfRangeIsRefusedByNameAndTheOldOnesStay)
{
    const auto refuse = [this](const char* member, void (*spoil)(FxViewSettings&)) {
        FxViewSettings settings = fxDefaultViewSettings();
        spoil(settings);
        const FxResult result = fxView_SetSettings(view_, &settings);
        EXPECT_TRUE(result == FX_ERROR_INVALID_ARGUMENT || result == FX_ERROR_VERSION) << member;
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), member), nullptr) << fxGetLastErrorMessage();
        FxView* view = nullptr;
        EXPECT_NE(fxCreateView(context_, scene_, &settings, &view), FX_OK) << member;
        EXPECT_EQ(view, nullptr);
    };
    refuse("structSize", [](FxViewSettings& s) { s.structSize = 5; });
    refuse("exposureEv100", [](FxViewSettings& s) { s.exposureEv100 = kNan; });
    refuse("sunDirection", [](FxViewSettings& s) { s.sunDirection[0] = 2.0f; });
    refuse("sunDirection", [](FxViewSettings& s) { s.sunDirection[1] = kNan; });
    refuse("sunIlluminance", [](FxViewSettings& s) { s.sunIlluminance[2] = -1.0f; });
    refuse("skyLuminance", [](FxViewSettings& s) { s.skyLuminance[0] = kInf; });
    refuse("groundAlbedo", [](FxViewSettings& s) { s.groundAlbedo = 1.5f; });
    refuse("shimmerStrength", [](FxViewSettings& s) { s.shimmerStrength = -1.0f; });
    refuse("shimmerMaxOffset", [](FxViewSettings& s) { s.shimmerMaxOffset = kInf; });
    refuse("dazzle", [](FxViewSettings& s) { s.dazzle = 2; });
    refuse("dazzleWhite", [](FxViewSettings& s) { s.dazzleWhite = 0.0f; });
    refuse("dazzleA", [](FxViewSettings& s) { s.dazzleB = 8.0f; }); // 1 < 8 exp(-2): not monotone
    refuse("dazzleA", [](FxViewSettings& s) { s.dazzleB = -1.5f; });
    refuse("dazzleC", [](FxViewSettings& s) { s.dazzleC = -1.0f; });
    refuse("dazzleRiseTime", [](FxViewSettings& s) { s.dazzleRiseTime = kNan; });
    refuse("dazzleFallTime", [](FxViewSettings& s) { s.dazzleFallTime = 61.0f; });
    refuse("billboardForm", [](FxViewSettings& s) { s.billboardForm = 3; });
    refuse("saveState", [](FxViewSettings& s) { s.saveState = 2; });
    refuse("detail", [](FxViewSettings& s) { s.detail = 2; });
    refuse("toneMap", [](FxViewSettings& s) { s.toneMap = 2; });
    refuse("layerOutputs", [](FxViewSettings& s) { s.layerOutputs = 2; });
    refuse("countOverdraw", [](FxViewSettings& s) { s.countOverdraw = 2; });
    refuse("lodBias", [](FxViewSettings& s) { s.lodBias = -1.0f; });
    refuse("lodBias", [](FxViewSettings& s) { s.lodBias = 257.0f; });
    refuse("lodBias", [](FxViewSettings& s) { s.lodBias = kNan; });
    refuse("lodImpostorPixels", [](FxViewSettings& s) { s.lodImpostorPixels = 14.0f; });
    refuse("lodImpostorPixels", [](FxViewSettings& s) { s.lodImpostorPixels = kNan; });
    refuse("blockParallax", [](FxViewSettings& s) { s.blockParallax = -0.1f; });
    refuse("blockParallax", [](FxViewSettings& s) { s.blockParallax = 16.5f; });
    refuse("blockError", [](FxViewSettings& s) { s.blockError = -0.1f; });
    refuse("blockError", [](FxViewSettings& s) { s.blockError = kNan; });
    refuse("layerScale", [](FxViewSettings& s) { s.layerScale = 0.3f; });
    refuse("layerScale", [](FxViewSettings& s) { s.layerScale = 0.0f; });
    refuse("layerScale", [](FxViewSettings& s) { s.layerScale = kNan; });
    refuse("budgetMilliseconds", [](FxViewSettings& s) { s.budgetMilliseconds = -1.0f; });
    refuse("budgetMilliseconds", [](FxViewSettings& s) { s.budgetMilliseconds = kNan; });
    refuse("budgetMilliseconds", [](FxViewSettings& s) { s.budgetMilliseconds = 1e5f; });
    refuse("budgetClock", [](FxViewSettings& s) { s.budgetClock = 2; });
    EXPECT_EQ(fxView_SetSettings(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    const FxViewSettings good = fxDefaultViewSettings();
    EXPECT_EQ(fxView_SetSettings(view_, &good), FX_OK) << fxGetLastErrorMessage();
}

TEST_F(ViewArguments, aFrameOutOfRangeIsRefusedByNameAndThePictureStays)
{
    update(30);
    const std::vector<float> before = picture();
    const auto refuse = [this](const char* member, void (*spoil)(FxFrameDef&)) {
        FxFrameDef def = frame();
        spoil(def);
        const FxResult result = fxView_Render(view_, &def);
        EXPECT_TRUE(result == FX_ERROR_INVALID_ARGUMENT || result == FX_ERROR_VERSION) << member;
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), member), nullptr) << fxGetLastErrorMessage();
    };
    refuse("structSize", [](FxFrameDef& f) { f.structSize = 0; });
    refuse("origin", [](FxFrameDef& f) { f.origin[0] = double(kNan); });
    refuse("view", [](FxFrameDef& f) { f.view[5] = kNan; });
    refuse("view", [](FxFrameDef& f) { f.view[0] = 2.0f; });
    refuse("view", [](FxFrameDef& f) { f.view[0] = -1.0f; }); // a mirror
    refuse("view", [](FxFrameDef& f) { // sheared, although every column fits the other two
        f.view[4] = 0.6f;
        f.view[5] = 0.8f;
        f.view[10] = 0.8f;
    });
    refuse("view", [](FxFrameDef& f) { f.view[15] = 0.0f; });
    refuse("projection", [](FxFrameDef& f) { f.projection[3] = kInf; });
    refuse("projection", [](FxFrameDef& f) { std::memset(f.projection, 0, sizeof f.projection); });
    refuse("depthConvention", [](FxFrameDef& f) { f.depthConvention = 2; });
    refuse("zeroToOne", [](FxFrameDef& f) { f.zeroToOne = 2; });
    refuse("upperLeftOrigin", [](FxFrameDef& f) { f.upperLeftOrigin = 2; });
    refuse("target", [](FxFrameDef& f) { f.target = 2; });
    refuse("colorTexture", [](FxFrameDef& f) { f.colorTexture = 0; });
    refuse("width", [](FxFrameDef& f) { f.width = 0; });
    refuse("height", [](FxFrameDef& f) { f.height = 16'385; });
    refuse("deltaTime", [](FxFrameDef& f) { f.deltaTime = -1.0; });
    refuse("deltaTime", [](FxFrameDef& f) { f.deltaTime = double(kNan); });
    refuse("holdQuality", [](FxFrameDef& f) { f.holdQuality = 2; });
    refuse("resetHistory", [](FxFrameDef& f) { f.resetHistory = 2; });
    EXPECT_EQ(picture(), before);
}

TEST_F(ViewArguments, nullIsRefusedByEveryFunction)
{
    const FxFrameDef def = frame();
    const FxViewSettings settings = fxDefaultViewSettings();
    FxView* view = nullptr;
    FxViewStatistics statistics{};
    FxLayerTextures layers{};
    FxOutputTextures outputs{};
    uint32_t count = 0;
    char name[8];
    EXPECT_EQ(fxCreateView(nullptr, scene_, &settings, &view), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxCreateView(context_, nullptr, &settings, &view), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxCreateView(context_, scene_, &settings, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxDestroyView(nullptr), FX_OK);
    EXPECT_EQ(fxView_SetSettings(nullptr, &settings), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_Render(nullptr, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_Render(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetStatistics(nullptr, &statistics), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetStatistics(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetStatistics(view_, &statistics), FX_ERROR_VERSION);
    EXPECT_EQ(fxView_GetLayerTextures(nullptr, &layers), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetLayerTextures(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetLayerTextures(view_, &layers), FX_ERROR_VERSION);
    EXPECT_EQ(fxView_GetOutputTextures(nullptr, &outputs), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetOutputTextures(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetOutputTextures(view_, &outputs), FX_ERROR_VERSION);
    EXPECT_EQ(fxView_GetPassCount(nullptr, &count), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetPassCount(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetPassName(nullptr, 0, name, sizeof name), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ViewArguments, everyFunctionRefusesAnotherThreadUntilItAdoptsGl)
{
    const FxFrameDef def = frame();
    std::thread([&] {
        const FxViewSettings settings = fxDefaultViewSettings();
        FxView* view = nullptr;
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        FxLayerTextures layers{};
        layers.structSize = sizeof layers;
        uint32_t count = 0;
        char name[8];
        EXPECT_EQ(fxContext_WarmUp(context_), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxCreateView(context_, scene_, &settings, &view), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxView_GetStatistics(view_, &statistics), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxView_GetLayerTextures(view_, &layers), FX_ERROR_WRONG_THREAD);
        FxOutputTextures outputs{};
        outputs.structSize = sizeof outputs;
        EXPECT_EQ(fxView_GetOutputTextures(view_, &outputs), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxView_GetPassCount(view_, &count), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxView_GetPassName(view_, 0, name, sizeof name), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxDestroyView(view_), FX_ERROR_WRONG_THREAD);
        EXPECT_EQ(fxDestroyContext(context_), FX_ERROR_WRONG_THREAD);
        ASSERT_EQ(fxContext_AdoptGlThread(context_), FX_OK);
        EXPECT_EQ(fxView_GetStatistics(view_, &statistics), FX_OK);
    }).join();
    EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_WRONG_THREAD);
    ASSERT_EQ(fxContext_AdoptGlThread(context_), FX_OK);
    EXPECT_EQ(fxView_Render(view_, &def), FX_OK);
}

TEST_F(ViewArguments, aSceneOutlivesItsViewsAndBelongsToItsContext)
{
    EXPECT_EQ(fxDestroyScene(scene_), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "view"), nullptr);

    FxContext* other = nullptr;
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl = {gl_->loader().user, gl_->loader().getProcAddress};
    ASSERT_EQ(fxCreateContext(&contextDef, &other), FX_OK) << fxGetLastErrorMessage();
    FxView* view = nullptr;
    EXPECT_EQ(fxCreateView(other, scene_, nullptr, &view), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxDestroyContext(other), FX_OK);

    ASSERT_EQ(fxDestroyView(view_), FX_OK);
    EXPECT_EQ(fxDestroyScene(scene_), FX_OK);
}
