// Drawing: what a view does to the host's picture, and to nothing else.
#include "rendering/gl/gl_read_texture.h"
#include "tests/api/counting_new.h"
#include "tests/api/view_fixture.h"
#include "tests/rendering/gl/gl_host_state.h"

#include <cmath>
#include <cstring>
#include <thread>

using fx::render::differences;
using fx::render::GlHost;
using fx::render::GlProbe;
using fx::test::kFrame;
using fx::test::newCallsOfThisThread;
using ViewApi = fx::test::ViewApiTest;

TEST_F(ViewApi, fireIsSeenInTheMiddleAndTheCornerStaysTheHosts)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> texels = picture();
    const float* middle = &texels[size_t(kSize / 2 * kSize + kSize / 2) * 4];
    EXPECT_GT(std::abs(middle[0] - kBackground), 0.05f);
    EXPECT_GT(middle[0], middle[2]); // fire is redder than gray
    EXPECT_EQ(texels[0], kBackground);
    for (const float value : texels)
        EXPECT_TRUE(std::isfinite(value));
    EXPECT_GT(statistics().blobs, 50u);
    EXPECT_GT(statistics().passes, 0u);
    EXPECT_EQ(statistics().blobsNonFinite, 0u);
}

TEST_F(ViewApi, withoutParticlesAndGlareNeitherPictureNorGlIsTouched)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const std::vector<float> before = picture();
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(picture(), before);
    EXPECT_EQ(statistics().drawCalls, 0u);
    EXPECT_EQ(statistics().glCalls, 0u);
}

TEST_F(ViewApi, noGlStateDiffersAfterwards)
{
    update(60);
    GlHost host(gl_->loader());
    host.makeHostile();
    FxFrameDef def = frame();
    def.upperLeftOrigin = 1; // as its clip control
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    const GlProbe before = host.probe();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(differences(before, host.probe()), std::vector<std::string>());

    FxViewSettings settings = fxDefaultViewSettings();
    settings.saveState = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_FALSE(differences(before, host.probe()).empty()); // the probe can see
    host.release();
}

TEST(TouchedGlState, isAListThatEnds)
{
    ASSERT_NE(fxGetTouchedGlState(0), nullptr);
    uint32_t count = 0;
    for (; fxGetTouchedGlState(count); ++count)
        EXPECT_GT(std::strlen(fxGetTouchedGlState(count)), 0u);
    EXPECT_GT(count, 10u);
    EXPECT_EQ(fxGetTouchedGlState(0xFFFFFFFFu), nullptr);
}

TEST_F(ViewApi, aWarmFrameCompilesAndAllocatesNothing)
{
    warmUp();
    const FxFrameDef def = frame();
    for (int i = 0; i < 90; ++i) {
        update(1);
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(statistics().programsCompiled, 0u);
    }
    for (int i = 0; i < 20; ++i) {
        update(1);
        const uint64_t before = newCallsOfThisThread();
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
        EXPECT_EQ(newCallsOfThisThread() - before, 0u) << "frame " << i;
        EXPECT_EQ(statistics().allocations, 0u) << "frame " << i;
    }
}

TEST_F(ViewApi, outputsNameInstancesAsTheSceneDoes)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.outputs = FX_OUTPUT_INSTANCE_ID | FX_OUTPUT_FIRST_DEPTH;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    warmUp();
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(statistics().programsCompiled, 0u) << "they were warmed up for the view";
    FxOutputTextures outputs{};
    outputs.structSize = sizeof outputs;
    ASSERT_EQ(fxView_GetOutputTextures(view_, &outputs), FX_OK);
    EXPECT_EQ(outputs.motion, 0u) << "only what is asked for";
    ASSERT_NE(outputs.instanceId, 0u);
    const auto words = fx::render::readUintTexture(*host_, outputs.instanceId, kSize, kSize, 2);
    const size_t middle = size_t(kSize / 2 * kSize + kSize / 2);
    FxInstanceId instance{};
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetInstances(scene_, &instance, 1, &count), FX_OK);
    EXPECT_EQ(words[2 * middle] | uint64_t(words[2 * middle + 1]) << 32, instance.bits);
    EXPECT_EQ(words[0] | words[1], 0u) << "nothing is in the corner";
    const auto first = fx::render::readTexture(*host_, outputs.firstDepth, kSize, kSize, 1);
    EXPECT_GT(first[middle], 0.0f);
    EXPECT_TRUE(std::isinf(first[0]));

    settings.outputs = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    ASSERT_EQ(fxView_GetOutputTextures(view_, &outputs), FX_OK);
    EXPECT_EQ(outputs.instanceId | outputs.firstDepth, 0u);
    settings.outputs = 32;
    EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ViewApi, layersAreKeptOnRequestAndPassesHaveNames)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.layerOutputs = 1;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    FxLayerTextures layers{};
    layers.structSize = sizeof layers;
    ASSERT_EQ(fxView_GetLayerTextures(view_, &layers), FX_OK);
    for (const uint32_t name : {layers.fire, layers.smoke, layers.dust, layers.depth, layers.opticalDepth})
        EXPECT_NE(name, 0u);
    const std::vector<float> depths = fx::render::readTexture(*host_, layers.opticalDepth, kSize, kSize, 1);
    EXPECT_GT(depths[size_t(kSize / 2 * kSize + kSize / 2)], 0.1f);
    EXPECT_EQ(depths[0], 0.0f);

    uint32_t count = 0;
    ASSERT_EQ(fxView_GetPassCount(view_, &count), FX_OK);
    EXPECT_EQ(count, statistics().passes);
    char name[64];
    for (uint32_t i = 0; i < count; ++i) {
        ASSERT_EQ(fxView_GetPassName(view_, i, name, sizeof name), FX_OK);
        EXPECT_GT(std::strlen(name), 0u);
    }
    char little[3] = "zz";
    ASSERT_EQ(fxView_GetPassName(view_, 0, little, sizeof little), FX_OK);
    EXPECT_EQ(std::strlen(little), 2u);
    EXPECT_EQ(fxView_GetPassName(view_, count, name, sizeof name), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetPassName(view_, 0, nullptr, 8), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetPassName(view_, 0, name, 0), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ViewApi, aFramebufferIsDrawnLikeATextureWithoutShimmerAndGlare)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    settings.shimmerStrength = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    FxFrameDef def = frame();
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    const std::vector<float> asTexture = picture();
    fillPicture();
    GLuint framebuffer = 0;
    host_->gl.CreateFramebuffers(1, &framebuffer);
    host_->gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color_.name(), 0);
    def.target = FX_TARGET_FRAMEBUFFER;
    def.colorTexture = 0;
    def.framebuffer = framebuffer;
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> asFramebuffer = picture();
    host_->gl.DeleteFramebuffers(1, &framebuffer);
    for (size_t i = 0; i < asTexture.size(); ++i)
        ASSERT_NEAR(asFramebuffer[i], asTexture[i], 1e-4f + 1e-4f * std::abs(asTexture[i])) << "value " << i;
}

TEST_F(ViewApi, aFramebufferGetsThePictureThoughTheSceneHasLongShownNothing)
{
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    FxView* view = nullptr;
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
    ASSERT_EQ(fxCreateView(context_, scene, nullptr, &view), FX_OK);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0; // which goes on while there is nothing to be seen
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    fillPicture();
    FxFrameDef def = frame();
    for (int i = 0; i < 8; ++i) {
        ASSERT_EQ(fxScene_Update(scene, kFrame), FX_OK);
        ASSERT_EQ(fxView_Render(view, &def), FX_OK);
    }
    auto target = fx::render::GlTexture::create(*host_, kSize, kSize, GL_RGBA16F, "target");
    ASSERT_TRUE(target.ok());
    GLuint framebuffer = 0;
    host_->gl.CreateFramebuffers(1, &framebuffer);
    host_->gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target->name(), 0);
    def.target = FX_TARGET_FRAMEBUFFER;
    def.framebuffer = framebuffer;
    ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fx::render::readTexture(*host_, target->name(), kSize, kSize, 4), picture());
    host_->gl.DeleteFramebuffers(1, &framebuffer);
}

TEST_F(ViewApi, whatIsShownLiesBetweenTheLastTwoSteps)
{
    update(60);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0; // nothing but the particles' places changes with time
    settings.shimmerStrength = 0;
    settings.detail = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const FxFrameDef def = frame();
    std::vector<std::vector<float>> pictures;
    for (int quarter = 0; quarter < 2; ++quarter) {
        fillPicture();
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
        pictures.push_back(picture());
        ASSERT_EQ(fxScene_Update(scene_, 0.5 * kFrame), FX_OK); // no step: only the moment shown moves
    }
    EXPECT_NE(pictures[0], pictures[1]);
}

TEST_F(ViewApi, theSceneThreadUpdatesWhileTheGlThreadDraws)
{
    update(60);
    std::thread updater([this] {
        ASSERT_EQ(fxScene_AdoptThread(scene_), FX_OK);
        update(100);
    });
    const FxFrameDef def = frame();
    for (int i = 0; i < 20; ++i) {
        if (i % 2 == 0) { // the frame keeps its snapshot until it is drawn, whatever the scene does
            EXPECT_EQ(fxView_PrepareLights(view_, &def), FX_OK) << fxGetLastErrorMessage();
            FxMediaShadow shadow{};
            shadow.structSize = sizeof shadow;
            EXPECT_EQ(fxView_GetMediaShadow(view_, FX_LIGHT_SUN, 0, &shadow), FX_OK);
        }
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
    }
    updater.join();
    ASSERT_EQ(fxScene_AdoptThread(scene_), FX_OK);
}

TEST_F(ViewApi, runningOutOfMemoryFailsCleanlyAndTheNextFrameWorks)
{
    update(60);
    FxView* view = nullptr;
    const FxFrameDef def = frame();
    FxResult result = FX_ERROR_OUT_OF_MEMORY;
    for (uint64_t n = 1; n < 2000 && result != FX_OK; ++n) {
        fillPicture();
        memory_.failFrom(n);
        result = fxCreateView(context_, scene_, nullptr, &view);
        if (result == FX_OK)
            result = fxView_Render(view, &def);
        memory_.failFrom(0);
        if (result != FX_OK) {
            EXPECT_EQ(result, FX_ERROR_OUT_OF_MEMORY)
                << "allocation " << n << ": " << fxGetLastErrorMessage();
            EXPECT_EQ(picture()[size_t(kSize / 2 * kSize + kSize / 2) * 4], kBackground)
                << "allocation " << n;
        }
        if (view && result != FX_OK) {
            EXPECT_EQ(fxView_Render(view, &def), FX_OK)
                << "allocation " << n << ": " << fxGetLastErrorMessage();
        }
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        view = nullptr;
    }
    EXPECT_EQ(result, FX_OK);
}
