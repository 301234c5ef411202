// Views draw on the GL thread while scenes are updated, read and loaded for on all other threads.
// Built with -fsanitize=thread, these tests find what is not ordered.
#include "rendering/gl/gl_messages.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "tests/api/api_fixture.h"
#include "tests/api/background_calls.h"
#include "tests/api/host_threads.h"
#include "tests/api/scene_script.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <latch>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fx::test {

namespace {

constexpr int kSize = 48;       ///< [pixel]
constexpr size_t kContexts = 2; ///< that share one GL thread
constexpr int kFrames = 40;     ///< updates of each scene

FxFrameDef frameOf(const render::GlTexture& color)
{
    FxFrameDef def = fxDefaultFrameDef();
    def.origin[1] = 1.0;
    def.origin[2] = 6.0;
    def.projection[0] = def.projection[5] = 1.0f;
    def.projection[10] = def.projection[11] = -1.0f;
    def.projection[14] = -0.2f;
    def.projection[15] = 0.0f;
    def.colorTexture = color.name();
    def.width = def.height = kSize;
    return def;
}

/// All ways to compose media in turn, in the light of sun and sky.
FxViewSettings settingsOf(uint32_t frame)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.activationOverlay = frame / 3 % 2; // marks are copied from the scene
    settings.composition = frame / 5 % 3;
    settings.voxels = 16;
    settings.slabs = 6;
    settings.lightSlicePlanes = 4;
    settings.lightSliceTexels = 16;
    settings.lightRefreshFrames = 1 + frame / 7 % 2;
    for (int i = 0; i < 3; ++i) {
        settings.sunIlluminance[i] = 1e4f;
        settings.skyLuminance[i] = 100.0f;
    }
    return settings;
}

/// A host with two contexts on one OpenGL, each with a scene on a thread of its own.
class ViewThreads : public ::testing::Test
{
protected:
    ViewThreads()
    {
        render::GlContextOptions options;
        options.debug = true;
        auto made = render::createEglContext(options);
        if (!made)
            throw std::runtime_error(made.status().message());
        gl_ = std::move(*made);
        auto device = render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource());
        if (!device)
            throw std::runtime_error(device.status().message());
        device_ = std::move(*device);
        messages_ = std::make_unique<render::GlMessages>(*device_);
        auto color = render::GlTexture::create(*device_, kSize, kSize, GL_RGBA32F, "host");
        EXPECT_TRUE(color.ok()) << color.status().message();
        color_ = std::move(*color);
        for (FxContext*& context : contexts_) {
            FxContextDef def = fxDefaultContextDef();
            def.allocator = memory_.hooks();
            def.parallelFor = loops_.hook();
            def.gl = {gl_->loader().user, gl_->loader().getProcAddress};
            EXPECT_EQ(fxCreateContext(&def, &context), FX_OK) << fxGetLastErrorMessage();
            EXPECT_EQ(fxContext_WarmUp(context), FX_OK) << fxGetLastErrorMessage();
        }
    }
    ~ViewThreads() override
    {
        for (FxContext* const context : contexts_)
            EXPECT_EQ(fxDestroyContext(context), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(memory_.blocks(), 0);
        EXPECT_EQ(messages_->serious(), 0u) << messages_->first();
    }

    /// Plays all scripts at once; `draw` is called again and again on this thread until they have ended.
    std::array<uint64_t, kContexts> play(const std::function<void()>& draw)
    {
        std::array<uint64_t, kContexts> hashes{};
        std::latch created(kContexts), begin(1);
        std::atomic<size_t> ended{0};
        std::vector<std::thread> threads;
        for (uint32_t i = 0; i < kContexts; ++i)
            threads.emplace_back([&, i] {
                SceneScript script(contexts_[i], i + 1);
                scenes_[i] = script.scene();
                created.count_down();
                begin.wait();
                script.play(kFrames);
                hashes[i] = script.stateHash();
                ++ended;
            });
        created.wait();
        makeViews();
        BackgroundCalls calls;
        for (size_t i = 0; i < kContexts; ++i) {
            calls.readSnapshots(scenes_[i]);
            calls.loadPresets(contexts_[i]);
            calls.readMemoryStatistics(contexts_[i]);
        }
        begin.count_down();
        do
            draw();
        while (ended < kContexts);
        for (std::thread& thread : threads)
            thread.join();
        calls.stop();
        draw(); // what the scripts have left
        return hashes;
    }

    /// Two of each scene.
    void makeViews()
    {
        for (size_t i = 0; i < 2 * kContexts; ++i) {
            FxView* view = nullptr;
            EXPECT_EQ(fxCreateView(contexts_[i % kContexts], scenes_[i % kContexts], nullptr, &view), FX_OK)
                << fxGetLastErrorMessage();
            views_.push_back(view);
        }
    }

    void prepare(FxView* view)
    {
        const FxFrameDef def = frameOf(color_);
        EXPECT_EQ(fxView_PrepareLights(view, &def), FX_OK) << fxGetLastErrorMessage();
        FxMediaShadow shadow{};
        shadow.structSize = sizeof shadow;
        EXPECT_EQ(fxView_GetMediaShadow(view, FX_LIGHT_SUN, 0, &shadow), FX_OK);
        shadows_ += shadow.texture != 0 ? 1 : 0;
    }

    void draw(FxView* view)
    {
        FxFrameDef def = frameOf(color_);
        def.visibilityMask = 1u + frames_++ % 3; // scripts give instances masks of 1 and 2
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        EXPECT_EQ(fxView_GetStatistics(view, &statistics), FX_OK);
        passes_ += statistics.passes;
    }

    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> device_; ///< the host's own function table
    std::unique_ptr<render::GlMessages> messages_;
    render::GlTexture color_;
    HostThreads loops_{1};
    HostAllocator memory_;
    std::array<FxContext*, kContexts> contexts_{};
    std::array<FxScene*, kContexts> scenes_{};
    std::vector<FxView*> views_;
    uint64_t passes_ = 0;
    uint32_t frames_ = 0;  ///< that were drawn
    uint32_t shadows_ = 0; ///< that were there
};

} // namespace

TEST_F(ViewThreads, viewsDrawWhileTheirScenesAreChangedReadAndLoadedFor)
{
    uint32_t frame = 0;
    const auto hashes = play([&] {
        FxView* const view = views_[frame % views_.size()];
        const FxViewSettings settings = settingsOf(frame);
        EXPECT_EQ(fxView_SetSettings(view, &settings), FX_OK) << fxGetLastErrorMessage();
        if (frame % 2 == 0)
            prepare(view);
        draw(view);
        ++frame;
    });
    EXPECT_GT(passes_, 0u);
    EXPECT_GT(shadows_, 0u);
    for (const float value : render::readTexture(*device_, color_.name(), kSize, kSize, 4))
        ASSERT_TRUE(std::isfinite(value));
    for (uint32_t i = 0; i < kContexts; ++i) { // neither drawing nor reading changes the state
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        FxContext* context = nullptr;
        ASSERT_EQ(fxCreateContext(&def, &context), FX_OK) << fxGetLastErrorMessage();
        SceneScript alone(context, i + 1);
        alone.play(kFrames);
        EXPECT_EQ(alone.stateHash(), hashes[i]) << i;
        EXPECT_EQ(fxDestroyContext(context), FX_OK);
    }
}

TEST_F(ViewThreads, viewsComeAndGoWhileTheirScenesAreUpdated)
{
    uint32_t turn = 0;
    (void)play([&] {
        FxView*& view = views_[turn++ % views_.size()];
        draw(view);
        EXPECT_EQ(fxDestroyView(view), FX_OK) << fxGetLastErrorMessage();
        const size_t owner = size_t(&view - views_.data()) % kContexts;
        EXPECT_EQ(fxCreateView(contexts_[owner], scenes_[owner], nullptr, &view), FX_OK)
            << fxGetLastErrorMessage();
    });
    EXPECT_GT(turn, 0u);
}

} // namespace fx::test
