// Frames of two eyes, and views that change their scene.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

using fx::render::GlTexture;

constexpr float kEyes = 0.064f; ///< [m] distance of the eyes
/// Embers and sparks below a pixel are as wide and as bright for both eyes as for the first one.
constexpr float kEyesDiffer = 2.0f / 255.0f;

double totalDifference(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += double(std::abs(std::min(a[i], 1.0f) - std::min(b[i], 1.0f)));
    return sum;
}

class ViewStereo : public fx::test::ViewApiTest
{
protected:
    ViewStereo()
    {
        auto created = GlTexture::create(*host_, kSize, kSize, GL_RGBA32F, "other eye");
        EXPECT_TRUE(created.ok());
        other_ = std::move(*created);
    }

    FxScene* makeScene(const char* preset, int updates, double depth = 0.0)
    {
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        EXPECT_EQ(fxLoadPresetLibrary(context_, preset, &instance.preset), FX_OK) << fxGetLastErrorMessage();
        instance.position[2] = -depth;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        step(scene, updates);
        return scene;
    }
    static void step(FxScene* scene, int updates)
    {
        for (int i = 0; i < updates; ++i)
            EXPECT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
    }
    FxView* makeView(FxScene* scene, const FxViewSettings& settings)
    {
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        return view;
    }
    FxViewSettings sunny(uint32_t composition) const
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.composition = composition;
        settings.dazzle = 0; // its strength follows the first eye
        for (int i = 0; i < 3; ++i) {
            settings.sunIlluminance[i] = 60'000.0f;
            settings.skyLuminance[i] = 4'000.0f;
        }
        return settings;
    }
    /// Frame of the eye at `side` of the middle.
    FxFrameDef eye(float side, const GlTexture& color) const
    {
        FxFrameDef def = frame();
        def.origin[1] = 1.0;
        def.view[12] = -side; // the world moves to the other side
        def.colorTexture = color.name();
        return def;
    }
    void clear()
    {
        fillPicture();
        const float color[4] = {kBackground, kBackground, kBackground, 1.0f};
        host_->gl.ClearTexImage(other_.name(), 0, GL_RGBA, GL_FLOAT, color);
    }
    std::vector<float> otherPicture()
    {
        return fx::render::readTexture(*host_, other_.name(), kSize, kSize, 4);
    }

    GlTexture other_;
};

} // namespace

TEST_F(ViewStereo, eachEyeSeesThePictureOfAViewOfItsOwn)
{
    for (const uint32_t composition : {FX_COMPOSITION_SORTED, FX_COMPOSITION_SLABS, FX_COMPOSITION_VOLUME})
        for (const char* preset : {"campfire", "sparks", fx::test::kLargeEffect + std::strlen("library:")}) {
            SCOPED_TRACE(std::string(preset) + ", composition " + std::to_string(composition));
            FxScene* const scene = makeScene(preset, 60);
            const FxViewSettings settings = sunny(composition);
            FxView* const both = makeView(scene, settings);
            FxView* const single[2] = {makeView(scene, settings), makeView(scene, settings)};
            const FxFrameDef left = eye(-0.5f * kEyes, color_), right = eye(0.5f * kEyes, other_);
            const int frames = std::strcmp(preset, "sparks") == 0 ? 2 : 1;
            for (int i = 0; i < frames; ++i) {
                step(scene, 1);
                clear();
                const std::vector<float> empty = picture();
                ASSERT_EQ(fxView_Render(single[0], &left), FX_OK) << fxGetLastErrorMessage();
                ASSERT_EQ(fxView_Render(single[1], &right), FX_OK) << fxGetLastErrorMessage();
                const std::vector<float> wanted[2] = {picture(), otherPicture()};
                clear();
                ASSERT_EQ(fxView_RenderStereo(both, &left, &right), FX_OK) << fxGetLastErrorMessage();
                EXPECT_EQ(picture(), wanted[0]);
                EXPECT_LE(fx::test::largestShownDifference(otherPicture(), wanted[1]), kEyesDiffer);
                EXPECT_GT(fx::test::largestShownDifference(wanted[0], empty), 8.0f / 255.0f);
                EXPECT_GT(fx::test::largestShownDifference(wanted[0], wanted[1]),
                          8.0f / 255.0f); // the eyes are apart
            }
            for (FxView* view : {both, single[0], single[1]})
                ASSERT_EQ(fxDestroyView(view), FX_OK);
            ASSERT_EQ(fxDestroyScene(scene), FX_OK);
        }
}

TEST_F(ViewStereo, ofEqualCamerasHasEqualPictures)
{
    FxScene* const scene = makeScene("campfire", 60);
    FxView* const view = makeView(scene, sunny(FX_COMPOSITION_SORTED));
    const FxFrameDef first = eye(0.0f, color_), second = eye(0.0f, other_);
    clear();
    ASSERT_EQ(fxView_RenderStereo(view, &first, &second), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(picture(), otherPicture());
}

TEST_F(ViewStereo, theSecondEyeSeesWhatIsBesideTheViewOfTheFirst)
{
    FxScene* const scene = makeScene("smoke-column", 60);
    const FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    const FxFrameDef first = eye(-8.0f, color_), second = eye(0.0f, other_);
    clear();
    const std::vector<float> empty = picture();
    ASSERT_EQ(fxView_Render(makeView(scene, settings), &second), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> wanted = otherPicture();
    EXPECT_GT(fx::test::largestShownDifference(wanted, empty), 8.0f / 255.0f);
    clear();
    ASSERT_EQ(fxView_RenderStereo(makeView(scene, settings), &first, &second), FX_OK);
    EXPECT_EQ(picture(), empty);
    // not equal: blobs of less than a pixel of the first eye, which is far away, have been enlarged
    EXPECT_LE(totalDifference(otherPicture(), wanted), 0.1 * totalDifference(wanted, empty));
}

TEST_F(ViewStereo, bothEyesOfOneTargetLieBesideEachOther)
{
    FxScene* const scene = makeScene("campfire", 60);
    FxView* const view = makeView(scene, sunny(FX_COMPOSITION_SORTED));
    FxFrameDef halves[2] = {eye(-0.5f * kEyes, color_), eye(0.5f * kEyes, color_)};
    for (FxFrameDef& half : halves) {
        half.width = half.height = kSize / 2;
        half.depthTexture = 0;
    }
    halves[1].viewportX = kSize / 2;
    ASSERT_EQ(fxView_RenderStereo(view, &halves[0], &halves[1]), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> both = picture();
    clear();
    for (const FxFrameDef& half : halves)
        ASSERT_EQ(fxView_Render(view, &half), FX_OK) << fxGetLastErrorMessage();
    EXPECT_LE(fx::test::largestShownDifference(both, picture()), kEyesDiffer);
}

TEST_F(ViewStereo, fillsLightSlicesOnceAndPrintsWhatItSaves)
{
    FxScene* const scene = makeScene(fx::test::kLargeEffect + std::strlen("library:"), 60);
    const FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    FxView* const both = makeView(scene, settings);
    FxView* const single[2] = {makeView(scene, settings), makeView(scene, settings)};
    const FxFrameDef left = eye(-0.5f * kEyes, color_), right = eye(0.5f * kEyes, other_);
    const auto countsOf = [](FxView* view) {
        FxViewStatistics counts{};
        counts.structSize = sizeof counts;
        EXPECT_EQ(fxView_GetStatistics(view, &counts), FX_OK);
        return counts;
    };
    const auto seconds = [&](const auto& draw) {
        const auto start = std::chrono::steady_clock::now();
        draw();
        host_->gl.Finish();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    double apart = 1e9, together = 1e9; // [s] the shortest: other programs disturb
    for (int i = 0; i < 4; ++i) {
        step(scene, 1);
        apart = std::min(apart, seconds([&] {
                             ASSERT_EQ(fxView_Render(single[0], &left), FX_OK);
                             ASSERT_EQ(fxView_Render(single[1], &right), FX_OK);
                         }));
        together =
            std::min(together, seconds([&] { ASSERT_EQ(fxView_RenderStereo(both, &left, &right), FX_OK); }));
        const std::vector<std::string> second = fx::test::passNamesOf(both);
        EXPECT_EQ(std::ranges::count(second, std::string("light slices")), 0);
        const std::vector<std::string> alone = fx::test::passNamesOf(single[1]);
        EXPECT_GE(std::ranges::count(alone, std::string("light slices")), 1); // one for some thousand balls
        const FxViewStatistics a = countsOf(single[0]), b = countsOf(single[1]), c = countsOf(both);
        EXPECT_LT(c.drawCalls, a.drawCalls + b.drawCalls);
        EXPECT_LT(c.glCalls, a.glCalls + b.glCalls);
        EXPECT_LT(c.textureBytes, a.textureBytes + b.textureBytes);
    }
    std::printf("two views %.2f ms, both eyes in one call %.2f ms, ratio %.2f\n", 1e3 * apart, 1e3 * together,
                together / apart);
}

TEST_F(ViewStereo, refusesWhatBelongsToOneEyeAndNamesTheEye)
{
    FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    FxView* const view = makeView(scene_, settings);
    update(30);
    const FxFrameDef left = eye(-0.5f * kEyes, color_), right = eye(0.5f * kEyes, other_);
    const std::vector<float> before = picture();
    FxFrameDef wrong = right;
    wrong.width = 0;
    EXPECT_EQ(fxView_RenderStereo(view, &left, &wrong), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("second: frame.width"), std::string::npos);
    wrong = right;
    wrong.colorTexture = 99'999;
    EXPECT_EQ(fxView_RenderStereo(view, &left, &wrong), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_RenderStereo(view, &left, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_RenderStereo(nullptr, &left, &right), FX_ERROR_INVALID_ARGUMENT);
    settings.layerOutputs = 1;
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    EXPECT_EQ(fxView_RenderStereo(view, &left, &right), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(picture(), before);
}

TEST_F(ViewStereo, aViewShowsTheSceneThatItIsGiven)
{
    const FxFrameDef def = eye(0.0f, color_);
    const auto show = [&](FxView* view) {
        clear();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    };
    FxScene* const scenes[] = {makeScene("campfire", 60), makeScene("sparks", 60, 1.0),
                               makeScene("rain", 60)};
    const FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    FxView* const view = makeView(scenes[0], settings);
    for (const int shown : {0, 1, 2, 0, 2, 1}) {
        FxView* const fresh = makeView(scenes[shown], settings);
        ASSERT_EQ(fxView_SetScene(view, scenes[shown]), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(show(view), show(fresh)) << shown;
        ASSERT_EQ(fxDestroyView(fresh), FX_OK);
    }
    EXPECT_EQ(fxDestroyScene(scenes[1]), FX_ERROR_INVALID_ARGUMENT); // the view shows it
    EXPECT_EQ(fxDestroyScene(scenes[0]), FX_OK);
    EXPECT_EQ(fxView_SetScene(view, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_SetScene(nullptr, scenes[2]), FX_ERROR_INVALID_ARGUMENT);
    const FxContextDef other = fxDefaultContextDef();
    FxContext* context = nullptr;
    FxScene* foreign = nullptr;
    ASSERT_EQ(fxCreateContext(&other, &context), FX_OK);
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context, &sceneDef, &foreign), FX_OK);
    EXPECT_EQ(fxView_SetScene(view, foreign), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}

TEST_F(ViewStereo, theOverlayFollowsTheViewToAnotherScene)
{
    FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    settings.activationOverlay = 1;
    FxScene* const scene = makeScene("campfire", 30);
    FxView* const view = makeView(scene_, settings);
    ASSERT_EQ(fxView_SetScene(view, scene), FX_OK);
    step(scene, 1);
    const FxFrameDef left = eye(-0.5f * kEyes, color_), right = eye(0.5f * kEyes, other_);
    const auto boxes = [&](bool overlay) {
        settings.activationOverlay = overlay;
        EXPECT_EQ(fxView_SetSettings(view, &settings), FX_OK);
        step(scene, 1);
        clear();
        EXPECT_EQ(fxView_RenderStereo(view, &left, &right), FX_OK) << fxGetLastErrorMessage();
        const std::vector<std::string> passes = fx::test::passNamesOf(view);
        return std::ranges::count(passes, std::string("activation overlay"));
    };
    EXPECT_EQ(boxes(true), 1);
    EXPECT_EQ(boxes(false), 0);
}
