// OpenGL contexts that are lost: views say so, call OpenGL no more, and go on in another context.
#include "tests/api/fault_table.h"
#include "tests/api/gl_loss.h"
#include "tests/api/view_fixture.h"

#include <cstdio>
#include <memory>
#include <vector>

namespace {

using fx::test::GlLoss;
using fx::test::kFrame;

constexpr int kPictureSide = 64; ///< [pixel]

/// Fire and dust with light slices, shimmer, glare, sprites and a mesh, some of them computed by the GPU if
/// the build can.
constexpr const char* kMixed = R"({"version": 1, "name": "mixed", "ground": false, "emitters": [
    {"name": "fire", "layer": "fire", "shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1,
     "radius": 0.5, "temperature": 1700, "heat": 1, "fireShare": 0.5, "detailAmount": 0.5,
     "forces": {"gravity": 0}},
    {"name": "sparks", "compute": "gpu", "shape": "sphere", "size": [0.3, 0, 0], "speed": {"min": 1, "max": 2},
     "emission": {"rate": 400}, "lifetime": {"min": 0.3, "max": 0.8}, "radius": 0.03, "maxParticles": 500,
     "appearance": {"kind": "sprite", "order": "depth", "luminance": 5000}}]})";

/// A host whose window, and with it the OpenGL context, comes and goes.
class LosingHost : public ::testing::Test
{
protected:
    LosingHost()
    {
        openWindow();
        loss_ = std::make_unique<GlLoss>(gl_->loader());
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.allocator = memory_.hooks();
        def.gl = loss_->hooks();
        EXPECT_EQ(fxCreateContext(&def, &context_), FX_OK) << fxGetLastErrorMessage();
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene_), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = fx::test::loadText(context_, kMixed);
        EXPECT_EQ(fxScene_CreateInstance(scene_, &instance, &instance_), FX_OK);
        FxLight lamp = fxDefaultLight();
        lamp.position[1] = 2.0;
        lamp.intensity[0] = lamp.intensity[1] = lamp.intensity[2] = 2e5f;
        const FxViewSettings all = settings();
        EXPECT_EQ(fxCreateView(context_, scene_, &all, &view_), FX_OK);
        EXPECT_EQ(fxView_SetLights(view_, &lamp, 1), FX_OK);
        update(20);
    }
    ~LosingHost() override
    {
        EXPECT_EQ(fxDestroyContext(context_), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(memory_.blocks(), 0);
        losses_.blocks = memory_.blocks();
        if (losses_.injected > 0)
            fx::test::FaultTable::note(losses_);
    }

    void openWindow()
    {
        auto gl = fx::render::createEglContext({});
        ASSERT_TRUE(gl.ok()) << gl.status().message();
        gl_ = std::move(*gl);
        auto host = fx::render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource());
        ASSERT_TRUE(host.ok()) << host.status().message();
        host_ = std::move(*host);
        const auto make = [&](GLenum format) {
            auto texture = fx::render::GlTexture::create(*host_, kPictureSide, kPictureSide, format, "host");
            EXPECT_TRUE(texture.ok()) << texture.status().message();
            return std::move(*texture);
        };
        color_ = make(GL_RGBA32F);
        depth_ = make(GL_DEPTH_COMPONENT32F);
        const float far = 1.0f;
        host_->gl.ClearTexImage(depth_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
    }
    /// Destroys the OpenGL context with all objects in it.
    void closeWindow()
    {
        host_->reportLoss(); // the textures of the host end with the context
        color_ = {};
        depth_ = {};
        host_.reset();
        gl_.reset();
    }
    FxViewSettings settings() const
    {
        FxViewSettings all = fxDefaultViewSettings();
        all.composition = composition_;
        for (int i = 0; i < 3; ++i) {
            all.sunIlluminance[i] = 60'000.0f;
            all.skyLuminance[i] = 4'000.0f;
        }
        return all;
    }
    FxFrameDef frame() const { return fx::test::frameBefore(color_.name(), depth_.name(), kPictureSide); }
    FxResult draw(FxView* view)
    {
        const float gray[4] = {0.25f, 0.25f, 0.25f, 1.0f};
        host_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, gray);
        const FxFrameDef def = frame();
        return fxView_Render(view, &def);
    }
    std::vector<float> picture()
    {
        return fx::render::readTexture(*host_, color_.name(), kPictureSide, kPictureSide, 4);
    }
    void update(int frames)
    {
        for (int i = 0; i < frames; ++i)
            ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
    }
    uint64_t hash()
    {
        uint64_t value = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene_, &value), FX_OK);
        return value;
    }
    /// The first frame of a new view of the same scene.
    std::vector<float> freshPicture()
    {
        const FxViewSettings all = settings();
        FxLight lamp = fxDefaultLight();
        lamp.position[1] = 2.0;
        lamp.intensity[0] = lamp.intensity[1] = lamp.intensity[2] = 2e5f;
        FxView* fresh = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene_, &all, &fresh), FX_OK);
        EXPECT_EQ(fxView_SetLights(fresh, &lamp, 1), FX_OK);
        EXPECT_EQ(draw(fresh), FX_OK) << fxGetLastErrorMessage();
        std::vector<float> shown = picture();
        EXPECT_EQ(fxDestroyView(fresh), FX_OK);
        return shown;
    }
    /// All functions that could call OpenGL.
    void callEverything()
    {
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_GL_LOST);
        EXPECT_EQ(fxView_RenderStereo(view_, &def, &def), FX_ERROR_GL_LOST);
        EXPECT_EQ(fxView_PrepareLights(view_, &def), FX_ERROR_GL_LOST);
        EXPECT_EQ(fxContext_WarmUp(context_), FX_ERROR_GL_LOST);
        FxLayerTextures layers{};
        layers.structSize = sizeof layers;
        EXPECT_EQ(fxView_GetLayerTextures(view_, &layers), FX_OK);
        FxMediaShadow shadow{};
        shadow.structSize = sizeof shadow;
        EXPECT_EQ(fxView_GetMediaShadow(view_, FX_LIGHT_SUN, 0, &shadow), FX_OK);
        const FxViewSettings all = settings();
        EXPECT_EQ(fxView_SetSettings(view_, &all), FX_OK);
        FxView* other = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene_, &all, &other), FX_OK);
        EXPECT_EQ(fxView_Render(other, &def), FX_ERROR_GL_LOST);
        EXPECT_EQ(fxView_SetScene(other, scene_), FX_OK);
        EXPECT_EQ(fxDestroyView(other), FX_OK);
    }

    /// Draws a frame in which the context is lost at each call in turn, and restores it.
    /// @param stride 1: at each call  @param drawFrame draws a frame by `view_`
    template <class Draw>
    void sweep(uint64_t stride, Draw&& drawFrame)
    {
        uint64_t n = 1;
        const uint64_t before = hash();
        for (bool wasLost = true; wasLost && !HasFailure(); n += stride) {
            ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK) << fxGetLastErrorMessage();
            loss_->loseAt(n);
            const FxResult result = drawFrame();
            wasLost = loss_->isLost();
            SCOPED_TRACE("call " + std::to_string(n) + ", " + loss_->lostIn());
            if (!wasLost) {
                EXPECT_EQ(result, FX_OK) << fxGetLastErrorMessage();
                break;
            }
            // a loss behind the last error check is noticed by the next frame
            const bool isNoticed = result == FX_ERROR_GL_LOST;
            ASSERT_TRUE(isNoticed || result == FX_OK) << result << " " << fxGetLastErrorMessage();
            if (!isNoticed) {
                ASSERT_EQ(drawFrame(), FX_ERROR_GL_LOST) << fxGetLastErrorMessage();
            }
            const uint64_t calls = loss_->calls();
            callEverything();
            EXPECT_EQ(loss_->calls(), calls);
            loss_->loseAt(0);
            const bool isSameScene = hash() == before;
            EXPECT_TRUE(isSameScene);
            ++losses_.injected;
            losses_.refused += isNoticed;
            fx::test::FaultRow::add(losses_.scenes, !isSameScene);
        }
        std::printf("%llu calls, each %llu. of them lost the context\n", static_cast<unsigned long long>(n),
                    static_cast<unsigned long long>(stride));
        EXPECT_GT(n, 200u);
        loss_->loseAt(0);
        ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK);
    }

    uint32_t composition_ = FX_COMPOSITION_SORTED; ///< of settings()
    fx::test::FaultRow losses_{.fault = "context lost in a call"};
    fx::test::HostAllocator memory_;
    std::unique_ptr<fx::render::GlContext> gl_;
    std::unique_ptr<GlLoss> loss_;
    std::unique_ptr<fx::render::GlDevice> host_;
    fx::render::GlTexture color_, depth_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxInstanceId instance_{};
    FxView* view_ = nullptr;
};

} // namespace

TEST_F(LosingHost, goesOnInAnotherContextWithThePictureOfANewView)
{
    ASSERT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    update(3);
    ASSERT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    closeWindow();
    ASSERT_EQ(fxContext_ReportGlLoss(context_), FX_OK);
    loss_->loseAt(0);
    callEverything();
    EXPECT_EQ(loss_->calls(), 0u);
    update(5); // the simulation goes on
    ASSERT_EQ(fxScene_SetVisibilityMask(scene_, instance_, 2), FX_OK);

    openWindow();
    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK) << fxGetLastErrorMessage();
    FxFrameDef hidden = frame();
    hidden.visibilityMask = 4;
    host_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, nullptr);
    ASSERT_EQ(fxView_Render(view_, &hidden), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(picture(),
              std::vector<float>(size_t(4) * kPictureSide * kPictureSide, 0.0f)); // masks are as before
    ASSERT_EQ(fxScene_SetVisibilityMask(scene_, instance_, 0xFFFFFFFFu), FX_OK);

    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK); // without the history of the hidden frame
    ASSERT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> restored = picture();
    EXPECT_EQ(restored, freshPicture());
    float most = 0.0f;
    for (const float value : restored)
        most = std::max(most, value);
    EXPECT_GT(most, 1.0f); // something burns
}

TEST_F(LosingHost, simulatesTheSameWhetherOrNotItsContextIsLost)
{
    FxScene* other = nullptr;
    const FxSceneDef def = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &def, &other), FX_OK);
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = fx::test::loadText(context_, kMixed);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(other, &instance, &id), FX_OK);
    for (int i = 0; i < 30; ++i)
        ASSERT_EQ(fxScene_Update(other, kFrame), FX_OK);
    ASSERT_EQ(draw(view_), FX_OK);
    update(4);
    ASSERT_EQ(fxContext_ReportGlLoss(context_), FX_OK);
    EXPECT_EQ(draw(view_), FX_ERROR_GL_LOST);
    update(6);
    uint64_t expected = 0;
    ASSERT_EQ(fxScene_GetSimulationHash(other, &expected), FX_OK);
    EXPECT_EQ(hash(), expected);
}

TEST_F(LosingHost, callsNothingAfterALossAtAnyCallOfAFrame)
{
    sweep(3, [&] { return draw(view_); });
    ASSERT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> restored = picture();
    EXPECT_EQ(restored, freshPicture());
}

TEST_F(LosingHost, callsNothingAfterALossInAPreparedFrame)
{
    composition_ = FX_COMPOSITION_SLABS;
    const FxViewSettings all = settings();
    ASSERT_EQ(fxView_SetSettings(view_, &all), FX_OK);
    sweep(11, [&] {
        const FxFrameDef def = frame();
        const FxResult prepared = fxView_PrepareLights(view_, &def);
        return prepared == FX_OK ? draw(view_) : prepared;
    });
}

TEST_F(LosingHost, callsNothingAfterALossInAFrameOfTwoEyesAndLayers)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = fx::test::loadText(context_, kMixed);
    def.position[0] = 0.5;
    def.layer = 1;
    FxInstanceId upper{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &upper), FX_OK);
    update(10);
    sweep(23, [&] {
        const FxFrameDef first = frame();
        FxFrameDef second = first;
        second.origin[0] = 0.06;
        return fxView_RenderStereo(view_, &first, &second);
    });
    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK);
    ASSERT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    const std::vector<float> restored = picture();
    EXPECT_EQ(restored, freshPicture());
}

TEST_F(LosingHost, asksOnceAFrameWhetherAContextThatReportsResetsIsLost)
{
    loss_->loseAt(0);
    ASSERT_EQ(draw(view_), FX_OK);
    EXPECT_EQ(loss_->polls(), 0u);
    loss_->setReportsReset(true);
    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK);
    loss_->loseAt(0);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(draw(view_), FX_OK);
    EXPECT_EQ(loss_->polls(), 1u);
    loss_->loseAt(1);
    EXPECT_EQ(draw(view_), FX_ERROR_GL_LOST);
    EXPECT_EQ(loss_->lostIn(), "glGetGraphicsResetStatus");
    EXPECT_EQ(loss_->calls(), 1u);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("fxContext_RestoreGl"), std::string::npos);
}

TEST_F(LosingHost, noticesALossInAViewWithNothingToDraw)
{
    FxViewSettings all = settings();
    all.dazzle = 0; // or the glare would change the picture of the host
    ASSERT_EQ(fxView_SetSettings(view_, &all), FX_OK);
    loss_->setReportsReset(true);
    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK);
    ASSERT_EQ(fxScene_DestroyAllInstances(scene_), FX_OK);
    const FxFrameDef def = frame();
    for (int i = 0; i < 100; ++i) { // until textures of the last effects are gone
        update(1);
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    }
    loss_->loseAt(0);
    ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
    EXPECT_EQ(loss_->calls(), 1u); // of glGetGraphicsResetStatus
    loss_->loseAt(1);
    EXPECT_EQ(fxView_Render(view_, &def), FX_ERROR_GL_LOST);
    for (int function = 0; function < 2; ++function) {
        loss_->loseAt(0);
        ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK);
        loss_->loseAt(1);
        EXPECT_EQ(function == 0 ? fxView_PrepareLights(view_, &def) : fxView_RenderStereo(view_, &def, &def),
                  FX_ERROR_GL_LOST);
    }
}

TEST_F(LosingHost, callsNothingOfAPreparedFrameWhenItIsRestored)
{
    FxViewSettings all = settings();
    all.budgetMilliseconds = 8.0f; // the frame is measured
    ASSERT_EQ(fxView_SetSettings(view_, &all), FX_OK);
    const FxFrameDef def = frame();
    for (int i = 0; i < 3; ++i)
        ASSERT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    update(3); // lights are filled anew, and their time is asked for when the frame ends
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK) << fxGetLastErrorMessage();
    loss_->loseAt(0);
    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK);
    const uint64_t calls = loss_->calls();
    loss_->loseAt(0);
    ASSERT_EQ(fxContext_RestoreGl(context_, nullptr), FX_OK); // without a prepared frame
    EXPECT_EQ(calls, loss_->calls());
    EXPECT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
}

TEST_F(LosingHost, keepsItsFramesWhenRestoringRunsOutOfMemory)
{
    FxFrameDef first = frame();
    first.rangePart = FX_RANGE_FIRST;
    first.rangeNear = 3.0f;
    FxFrameDef last = frame();
    last.rangePart = FX_RANGE_LAST;
    last.rangeFar = 3.0f;
    FxResult result = FX_ERROR_OUT_OF_MEMORY;
    uint64_t n = 1;
    for (; result == FX_ERROR_OUT_OF_MEMORY && n < 1000; ++n) {
        ASSERT_EQ(fxView_Render(view_, &first), FX_OK) << fxGetLastErrorMessage();
        memory_.failFrom(n);
        result = fxContext_RestoreGl(context_, nullptr);
        memory_.failFrom(0);
        if (result == FX_ERROR_OUT_OF_MEMORY) {
            ASSERT_EQ(fxView_Render(view_, &last), FX_OK) << n << " " << fxGetLastErrorMessage();
        }
    }
    EXPECT_EQ(result, FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(n, 2u);
    EXPECT_EQ(fxView_Render(view_, &last), FX_ERROR_INVALID_ARGUMENT); // the frame has ended
}

TEST_F(LosingHost, keepsItsViewsWhenRestoringFails)
{
    ASSERT_EQ(draw(view_), FX_OK);
    const FxGlLoader nothing{nullptr, [](void*, const char*) -> void* { return nullptr; }};
    EXPECT_EQ(fxContext_RestoreGl(context_, &nothing), FX_ERROR_GL_UNSUPPORTED);
    const FxGlLoader empty{};
    EXPECT_EQ(fxContext_RestoreGl(context_, &empty), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxContext_RestoreGl(nullptr, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxContext_ReportGlLoss(nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxContext_ReportGlLoss(context_), FX_OK);
    FxResult result = FX_ERROR_OUT_OF_MEMORY;
    uint64_t n = 1;
    for (; result == FX_ERROR_OUT_OF_MEMORY && n < 1000; ++n) {
        EXPECT_EQ(draw(view_), FX_ERROR_GL_LOST);
        memory_.failFrom(n);
        result = fxContext_RestoreGl(context_, nullptr);
        memory_.failFrom(0);
    }
    EXPECT_EQ(result, FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(n, 2u);
    EXPECT_EQ(draw(view_), FX_OK) << fxGetLastErrorMessage();
    FxContext* withoutGl = nullptr;
    const FxContextDef def = fxDefaultContextDef();
    ASSERT_EQ(fxCreateContext(&def, &withoutGl), FX_OK);
    EXPECT_EQ(fxContext_RestoreGl(withoutGl, nullptr), FX_ERROR_NO_GL);
    EXPECT_EQ(fxContext_ReportGlLoss(withoutGl), FX_ERROR_NO_GL);
    EXPECT_EQ(fxDestroyContext(withoutGl), FX_OK);
}
