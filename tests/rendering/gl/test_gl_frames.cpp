// What happens from frame to frame: pooling, the host's own targets, no allocations, no queries.
#include "gl_test.h"
#include "tests/rendering/gl/heap_counter.h"

#include <cstring>

namespace fx::render {

using programs::kFill;
using programs::kSample;

class GlFramesTest : public GlTest
{
protected:
    /// A frame of `size`: fill, then filter into a second texture, which is kept.
    ResourceId declareFrame(int size)
    {
        graph.begin();
        ResourceId filled;
        graph.addPass("fill", [&](FrameGraph::Builder& builder) {
            filled = builder.write(builder.create(TextureDesc{"filled", size, size, Format::RGBA32F}));
            return [target = filled](Backend& to) {
                to.clear(target, {0, 0, 0, 0});
                to.draw({.program = &kFill,
                         .targets = {&target, 1},
                         .uniforms = asUniforms(FillBlock{{5, 0, 0, 0}, {}})});
            };
        });
        ResourceId sampled;
        graph.addPass("sample", [&](FrameGraph::Builder& builder) {
            builder.read(filled);
            sampled = builder.write(builder.create(TextureDesc{"sampled", size, size, Format::RGBA32F}));
            const ResourceId buffer = builder.write(builder.create(BufferDesc{"data", 64}));
            return [filled, sampled, buffer](Backend& to) {
                to.upload(buffer, asUniforms(FillBlock{}));
                const TextureBinding textures[] = {{0, filled}, {1, filled}, {2, filled}};
                const BufferBinding buffers[] = {{5, buffer}};
                to.draw({.program = &kSample,
                         .targets = {&sampled, 1},
                         .textures = textures,
                         .buffers = buffers});
            };
        });
        graph.keep(sampled);
        return sampled;
    }

    /// An imported texture (or framebuffer) that is filled with `value`.
    void fillImported(ResourceId host, float value)
    {
        ResourceId written;
        graph.addPass("fill host", [&](FrameGraph::Builder& builder) {
            written = builder.write(host);
            return [written, value](Backend& to) {
                to.draw({.program = &kFill,
                         .targets = {&written, 1},
                         .uniforms = asUniforms(FillBlock{{value, value, value, value}, {}})});
            };
        });
        graph.keep(written);
    }
};

TEST_F(GlFramesTest, aSteadyFrameUsesTheSameTexturesAndAllocatesNothing)
{
    ResourceId kept = declareFrame(8);
    ASSERT_TRUE(runGraph().ok());
    const uint32_t name = backend->textureName(kept);
    const uint64_t bytes = backend->pooledBytes();
    declareFrame(8);
    ASSERT_TRUE(runGraph().ok());

    // Only the library's own allocations count, so GL calls are swallowed while it is measured.
    device->gl.monitor.hook = [](const char* function) {
        EXPECT_EQ(std::strstr(function, "Create"), nullptr) << function << " in a steady frame";
        return false;
    };
    HeapCounter heap;
    kept = declareFrame(8);
    const base::Status status = runGraph();
    const int allocations = heap.stop();
    device->gl.monitor.hook = nullptr;
    EXPECT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(allocations, 0);
    EXPECT_EQ(backend->textureName(kept), name);
    EXPECT_EQ(backend->pooledBytes(), bytes);
    EXPECT_EQ(device->lateCompiles(), 2u);
}

TEST_F(GlFramesTest, aSteadyFrameAsksGlNothingPerDraw)
{
    declareFrame(8);
    ASSERT_TRUE(runGraph().ok());
    declareFrame(8);
    int queries = 0;
    device->gl.monitor.hook = [&queries](const char* function) {
        queries += std::strncmp(function, "glGet", 5) == 0 || std::strncmp(function, "glIs", 4) == 0 ||
                   std::strncmp(function, "glCheck", 7) == 0;
        return true;
    };
    ASSERT_TRUE(runGraph().ok());
    device->gl.monitor.hook = nullptr;
    EXPECT_EQ(queries, 2); // per frame: error before, error after; views ask for the reset status
}

TEST_F(GlFramesTest, anotherSizeGetsOtherTexturesAndTheOldOnesGoAfterAWhile)
{
    declareFrame(8);
    ASSERT_TRUE(runGraph().ok());
    const uint64_t small = device->textureBytes();
    for (int frame = 0; frame < 12; ++frame) {
        declareFrame(16);
        ASSERT_TRUE(runGraph().ok());
        EXPECT_EQ(device->textureBytes(), frame < 8 ? 5 * small : 4 * small) << "frame " << frame;
    }
    backend->releasePool();
    EXPECT_EQ(device->textureBytes(), 0u);
}

TEST_F(GlFramesTest, resourcesHaveNoNamesWithoutAFrameOrWhenCulled)
{
    EXPECT_EQ(backend->textureName({}), 0u);
    EXPECT_EQ(backend->width({}), 0);
    ResourceId unused;
    graph.addPass("unused", [&](FrameGraph::Builder& builder) {
        unused = builder.write(builder.create(TextureDesc{"unused", 4, 4, Format::R32F}));
        return [](Backend&) {};
    });
    ASSERT_TRUE(runGraph().ok());
    EXPECT_EQ(backend->textureName(unused), 0u);
    EXPECT_EQ(device->textureBytes(), 0u);
}

TEST_F(GlFramesTest, theHostsTextureIsDrawnToEvenWhenItsNameReturnsForAnotherTexture)
{
    for (const float value : {1.0f, 2.0f, 3.0f}) {
        auto host = GlTexture::create(*device, 4, 4, GL_RGBA32F, "host");
        ASSERT_TRUE(host.ok());
        graph.begin();
        fillImported(graph.importTexture({"host", 4, 4, Format::RGBA32F}, host->name()), value);
        ASSERT_TRUE(runGraph().ok()) << backend->status().message();
        EXPECT_EQ(readTexture(*device, host->name(), 4, 4, 1), std::vector<float>(16, value));
    }
}

TEST_F(GlFramesTest, theHostsTextureIsAttachedOnceAFrameAndOurOwnOnce)
{
    auto host = GlTexture::create(*device, 4, 4, GL_RGBA32F, "host");
    ASSERT_TRUE(host.ok());
    int attached = 0;
    device->gl.monitor.hook = [&attached](const char* name) {
        attached += std::strcmp(name, "glNamedFramebufferTexture") == 0;
        return true;
    };
    std::vector<int> perFrame;
    for (int frame = 0; frame < 3; ++frame) {
        attached = 0;
        declareFrame(8); // two targets of ours
        const ResourceId imported = graph.importTexture({"host", 4, 4, Format::RGBA32F}, host->name());
        fillImported(imported, 1.0f);
        ASSERT_TRUE(runGraph().ok());
        perFrame.push_back(attached);
    }
    EXPECT_EQ(perFrame, (std::vector<int>{3, 1, 1}));
    device->gl.monitor.hook = nullptr;
}

TEST_F(GlFramesTest, theHostsFramebufferIsDrawnToAndCopiedFrom)
{
    auto host = GlTexture::create(*device, 4, 4, GL_RGBA32F, "host");
    ASSERT_TRUE(host.ok());
    bytesOfTheTest = host->bytes();
    GlFramebuffer framebuffer = createFramebuffer(*device);
    device->gl.NamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, host->name(), 0);
    const ResourceId window = graph.importFramebuffer({"window", 4, 4, Format::RGBA32F}, framebuffer.name());
    ResourceId copy;
    fillImported(window, 6.0f);
    graph.begin();
    const ResourceId again = graph.importFramebuffer({"window", 4, 4, Format::RGBA32F}, framebuffer.name());
    ResourceId written;
    graph.addPass("fill and copy", [&](FrameGraph::Builder& builder) {
        written = builder.write(again);
        copy = builder.write(builder.create(TextureDesc{"copy", 4, 4, Format::RGBA32F}));
        return [written, copy](Backend& to) {
            to.clear(written, {2, 2, 2, 2});
            to.draw({.program = &kFill,
                     .targets = {&written, 1},
                     .uniforms = asUniforms(FillBlock{{6, 6, 6, 6}, {}}),
                     .blend = Blend::Additive});
            to.copyTexture(written, copy);
        };
    });
    graph.keep(written);
    graph.keep(copy);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    EXPECT_EQ(read(copy, 1), std::vector<float>(16, 8.0f));
    EXPECT_EQ(readFramebuffer(*device, framebuffer.name(), 4, 4, 1), std::vector<float>(16, 8.0f));
    EXPECT_EQ(backend->textureName(written), 0u);
    bytesOfTheTest = 0;
}

} // namespace fx::render
