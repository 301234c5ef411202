// The host's state is what it was, and hostile state does not change what is drawn.
#include "gl_host_state.h"
#include "gl_test.h"

#include "rendering/gl/gl_asset_cache.h"
#include "rendering/gl/gl_draw_state.h"
#include "rendering/gl/gl_state_guard.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace fx::render {

using programs::kCompute;
using programs::kDepth;
using programs::kFill;
using programs::kSample;

class GlStateGuardTest : public GlTest
{
protected:
    void SetUp() override
    {
        GlTest::SetUp();
        auto created = GlTexture::create(*device, 4, 4, GL_DEPTH_COMPONENT32F, "depth");
        ASSERT_TRUE(created.ok());
        depth = std::move(*created);
        created = GlTexture::createVolume(*device, 4, 4, 4, GL_RGBA32F, "volume");
        ASSERT_TRUE(created.ok());
        volume = std::move(*created);
        host = std::make_unique<GlHost>(context->loader());
        host->makeHostile();
        ASSERT_EQ(device->gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    }

    void TearDown() override
    {
        depth = {};
        volume = {};
        host->release();
        GlTest::TearDown();
    }

    /// Draws in every way that there is: blending, depth, all texture units, all storage bindings, images,
    /// uniforms.
    void drawEverything()
    {
        const float half = 0.5f;
        device->gl.ClearTexImage(depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &half);
        graph.begin();
        const ResourceId volumeIn = graph.importTexture({"volume", 4, 4, Format::RGBA32F}, volume.name());
        const ResourceId depthIn = graph.importTexture({"depth", 4, 4, Format::R32F}, depth.name());
        ResourceId drawn;
        graph.addPass("draws", [&](FrameGraph::Builder& builder) {
            drawn = builder.write(builder.create(TextureDesc{"drawn", 4, 4, Format::RGBA32F}));
            const ResourceId depthOut = builder.write(depthIn);
            return [drawn, depthOut](Backend& to) {
                to.clear(drawn, {1, 1, 1, 1});
                to.draw({.program = &kDepth,
                         .targets = {&drawn, 1},
                         .uniforms = asUniforms(FillBlock{
                             {1, 2, 3, 0}, {0.25f, 0, 0, 0}}), // the host's clip space is zero to one
                         .blend = Blend::Additive,
                         .depthTarget = depthOut});
                to.draw({.program = &kFill,
                         .targets = {&drawn, 1},
                         .uniforms = asUniforms(FillBlock{{1, 1, 1, 0.5f}, {}}),
                         .blend = Blend::Premultiplied});
            };
        });
        graph.addPass("dispatch", [&](FrameGraph::Builder& builder) {
            builder.read(drawn);
            builder.read(volumeIn);
            std::array<ResourceId, GlBackend::kImageUnits> made;
            for (ResourceId& image : made)
                image = builder.write(builder.create(TextureDesc{"image", 4, 4, Format::RGBA32F}));
            result = made[1];
            const ResourceId buffer = builder.write(builder.create(BufferDesc{"buffer", 64}));
            return [drawn, volumeIn, made, buffer](Backend& to) {
                std::array<TextureBinding, 8> textures;
                std::array<TextureBinding, 8> volumes;
                std::array<ImageBinding, GlBackend::kImageUnits> images;
                std::array<BufferBinding, 8> buffers;
                for (uint32_t i = 0; i < 8; ++i) {
                    textures[i] = {i, drawn};
                    volumes[i] = {i, volumeIn};
                    buffers[i] = {i, buffer};
                }
                for (uint32_t i = 0; i < images.size(); ++i)
                    images[i] = {i, made[i]};
                to.upload(buffer, asUniforms(FillBlock{}));
                for (const auto& bound : {volumes, textures})
                    to.dispatch({.program = &kCompute,
                                 .textures = bound,
                                 .images = images,
                                 .buffers = buffers,
                                 .uniforms = asUniforms(FillBlock{})});
            };
        });
        graph.keep(result);
        ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    }

    /// 1 + (1, 2, 3, 0), of which half passes under (1, 1, 1, 0.5).
    void expectPicture()
    {
        const std::vector<float> texels = read(result, 4);
        const float wanted[] = {2, 2.5f, 3, 1};
        for (size_t i = 0; i < texels.size(); ++i)
            ASSERT_EQ(texels[i], wanted[i % 4]) << "component " << i;
    }

    GlTexture depth, volume;
    std::unique_ptr<GlHost> host;
    ResourceId result;
};

TEST_F(GlStateGuardTest, noStateDiffersAfterAGuardedFrame)
{
    const GlProbe before = host->probe();
    EXPECT_GT(before.size(), 400u);
    for (int frame = 0; frame < 2; ++frame) {
        {
            const GlStateGuard guard(*device);
            drawEverything();
        }
        const auto changed = differences(before, host->probe());
        EXPECT_TRUE(changed.empty()) << changed.size() << " states, first " << changed.front();
    }
    EXPECT_EQ(device->gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    expectPicture();
}

TEST_F(GlStateGuardTest, theProbeSeesWhatAnUnguardedFrameLeaves)
{
    const GlProbe before = host->probe();
    {
        const GlStateGuard guard(*device, false);
        drawEverything();
    }
    EXPECT_GT(differences(before, host->probe()).size(), 60u);
    expectPicture();
}

TEST_F(GlStateGuardTest, readingATextureLeavesNoTrace)
{
    {
        const GlStateGuard guard(*device);
        drawEverything();
    }
    GlFramebuffer framebuffer = createFramebuffer(*device);
    device->gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, backend->textureName(result),
                                       0);
    const GlProbe before = host->probe();
    expectPicture();
    EXPECT_EQ(readFramebuffer(*device, framebuffer.name(), 4, 4, 4), read(result, 4));
    const auto changed = differences(before, host->probe());
    EXPECT_TRUE(changed.empty()) << changed.front();
    EXPECT_EQ(readDepthTexture(*device, depth.name(), 4, 4), std::vector<float>(16, 0.25f));
}

/// The published list has no entry too many. That none is missing is what the first test shows.
TEST_F(GlStateGuardTest, everyPublishedStateIsReallyTouched)
{
    const auto snapshot = [this] {
        std::vector<GlSavedState> all(kGlSavedStates);
        size_t slot = 0;
        GLint active = 0;
        device->gl.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
        for (const GlTouchedState& state : glTouchedStates()) {
            for (uint32_t i = 0; i < state.count; ++i)
                state.save(device->gl, state.what, i, all[slot++] = {});
        }
        device->gl.ActiveTexture(static_cast<GLenum>(active));
        return all;
    };
    device->gl.Disable(GL_FRAMEBUFFER_SRGB); // frames that write light enable it
    device->gl.Disablei(GL_BLEND, 0);        // as the last draw blends
    const auto before = snapshot();
    drawEverything();
    GlAssetCache assets(*device, std::pmr::get_default_resource()); // frames of particles are texture arrays
    const auto atlas = assets.atlas(nullptr, 0, 1, 1);
    ASSERT_TRUE(atlas.ok()) << atlas.status().message();
    GlDrawState(*device).bindTexture(0, atlas->texture, Sampling::Trilinear);
    const auto arguments = GlBuffer::create(*device, 16, "arguments"); // of particles counted on the GPU
    ASSERT_TRUE(arguments.ok()) << arguments.status().message();
    device->gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, arguments->name());
    const auto after = snapshot();
    size_t slot = 0;
    for (const GlTouchedState& state : glTouchedStates()) {
        bool touched = state.what == GL_ACTIVE_TEXTURE; // by the guard itself
        for (uint32_t i = 0; i < state.count; ++i, ++slot)
            touched |= std::memcmp(&before[slot], &after[slot], sizeof(GlSavedState)) != 0;
        EXPECT_TRUE(touched) << state.name;
    }
}

TEST_F(GlStateGuardTest, thePublishedListNamesEveryEntryOnce)
{
    const auto names = touchedState();
    EXPECT_EQ(names.size(), kGlTouchedStates);
    std::vector<std::string> sorted(names.begin(), names.end());
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
}

} // namespace fx::render
