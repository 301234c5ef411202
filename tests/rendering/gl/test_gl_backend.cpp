// Pixels that draws and dispatches give, exactly.
#include "gl_test.h"

#include <array>
#include <cstring>

namespace fx::render {

using programs::kCompute;
using programs::kCount;
using programs::kDepth;
using programs::kEightTargets;
using programs::kFill;
using programs::kSample;

class GlBackendTest : public GlTest
{
protected:
    static constexpr int kSize = 4;

    /// A texture cleared to `below` over which `color` is drawn.
    ResourceId drawOver(std::array<float, 4> below, std::array<float, 4> color, Blend blend,
                        Format format = Format::RGBA32F)
    {
        ResourceId target;
        graph.addPass("draw over", [&](FrameGraph::Builder& builder) {
            target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, format}));
            return [target, below, color, blend](Backend& to) {
                FillBlock block;
                std::copy(color.begin(), color.end(), block.color);
                to.clear(target, {below[0], below[1], below[2], below[3]});
                to.draw({.program = &kFill,
                         .targets = {&target, 1},
                         .uniforms = asUniforms(block),
                         .blend = blend});
            };
        });
        graph.keep(target);
        return target;
    }

    void expectEverywhere(ResourceId texture, std::array<float, 4> wanted)
    {
        const std::vector<float> texels = read(texture, 4);
        ASSERT_EQ(texels.size(), static_cast<size_t>(4 * kSize * kSize));
        for (size_t i = 0; i < texels.size(); ++i)
            ASSERT_EQ(texels[i], wanted[i % 4]) << "component " << i;
    }
};

TEST_F(GlBackendTest, aDrawWithoutBlendingReplaces)
{
    const ResourceId target = drawOver({1, 2, 3, 4}, {0.5f, 0.25f, 0.125f, 0.75f}, Blend::None);
    ASSERT_TRUE(runGraph().ok());
    expectEverywhere(target, {0.5f, 0.25f, 0.125f, 0.75f});
}

TEST_F(GlBackendTest, premultipliedBlendingAddsWhatTheSourceLetsThrough)
{
    const ResourceId target = drawOver({4, 8, 16, 1}, {1, 0.5f, 0.25f, 0.75f}, Blend::Premultiplied);
    ASSERT_TRUE(runGraph().ok());
    expectEverywhere(target, {2, 2.5f, 4.25f, 1});
}

TEST_F(GlBackendTest, additiveBlendingAddsColorAndAlpha)
{
    const ResourceId target = drawOver({4, 8, 16, 1}, {1, 0.5f, 0.25f, 0.75f}, Blend::Additive);
    ASSERT_TRUE(runGraph().ok());
    expectEverywhere(target, {5, 8.5f, 16.25f, 1.75f});
}

TEST_F(GlBackendTest, valuesFarAboveOneSurviveInFloatTargets)
{
    const ResourceId target = drawOver({0, 0, 0, 0}, {1e6f, 3e38f, -2, 1e-30f}, Blend::None);
    ASSERT_TRUE(runGraph().ok());
    expectEverywhere(target, {1e6f, 3e38f, -2, 1e-30f});
}

TEST_F(GlBackendTest, eightTargetsOfDifferentFormatsReceiveTheirOwnOutputs)
{
    std::array<ResourceId, GlBackend::kColorTargets> targets;
    graph.addPass("eight", [&](FrameGraph::Builder& builder) {
        for (size_t i = 0; i < targets.size(); ++i) {
            const Format format = i == 7 ? Format::R32F : i % 2 ? Format::RGBA16F : Format::RGBA32F;
            targets[i] = builder.write(builder.create(TextureDesc{"target", kSize, kSize, format}));
        }
        return [targets](Backend& to) {
            to.draw({.program = &kEightTargets,
                     .targets = targets,
                     .uniforms = asUniforms(FillBlock{{1, 2, 3, 4}, {}})});
        };
    });
    for (const ResourceId target : targets)
        graph.keep(target);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    for (size_t i = 0; i < 7; ++i) {
        const auto f = static_cast<float>(i);
        expectEverywhere(targets[i], {1 + f, 2 + f, 3 + f, 4 + f});
    }
    EXPECT_EQ(read(targets[7], 1), std::vector<float>(kSize * kSize, 8.0f));
}

TEST_F(GlBackendTest, samplersClampInterpolateAndRepeat)
{
    auto picture = GlTexture::create(*device, 2, 1, GL_R32F, "picture");
    ASSERT_TRUE(picture.ok());
    bytesOfTheTest = 8;
    const float texels[2] = {1, 3};
    device->gl.TextureSubImage2D(picture->name(), 0, 0, 0, 2, 1, GL_RED, GL_FLOAT, texels);
    const ResourceId host = graph.importTexture({"picture", 2, 1, Format::R32F}, picture->name());
    ResourceId target;
    graph.addPass("sample", [&](FrameGraph::Builder& builder) {
        builder.read(host);
        target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA32F}));
        return [host, target](Backend& to) {
            const std::array textures = {TextureBinding{0, host, Sampling::Nearest},
                                         TextureBinding{1, host, Sampling::Linear},
                                         TextureBinding{2, host, Sampling::LinearRepeat}};
            to.draw({.program = &kSample, .targets = {&target, 1}, .textures = textures});
        };
    });
    graph.keep(target);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    expectEverywhere(target, {3, 2, 3, 2});
    bytesOfTheTest = 0;
}

TEST_F(GlBackendTest, depthIsTestedAndWrittenInBothConventions)
{
    auto depth = GlTexture::create(*device, kSize, kSize, GL_DEPTH_COMPONENT32F, "depth");
    ASSERT_TRUE(depth.ok());
    for (const bool reversed : {false, true}) {
        const float start = 0.5f;
        device->gl.ClearTexImage(depth->name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &start);
        graph.begin();
        const ResourceId host = graph.importTexture({"depth", kSize, kSize, Format::R32F}, depth->name());
        ResourceId target;
        ResourceId depthOut;
        graph.addPass("depth", [&](FrameGraph::Builder& builder) {
            target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA32F}));
            depthOut = builder.write(host);
            return [target, depthOut, reversed](Backend& to) {
                to.clear(target, {0, 0, 0, 0});
                // Window depth 0.25, then 0.75, then 0.5, each visible or not against what stands before it.
                const float zs[] = {-0.5f, 0.5f, 0.0f};
                for (int i = 0; i < 3; ++i) {
                    const FillBlock block{
                        {i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f, 1},
                        {zs[i], 0, 0, 0}};
                    to.draw({.program = &kDepth,
                             .targets = {&target, 1},
                             .uniforms = asUniforms(block),
                             .blend = Blend::Additive,
                             .depthTarget = depthOut,
                             .reversedDepth = reversed});
                }
            };
        });
        graph.keep(target);
        ASSERT_TRUE(runGraph().ok()) << backend->status().message();
        expectEverywhere(target,
                         reversed ? std::array<float, 4>{0, 1, 0, 1} : std::array<float, 4>{1, 0, 0, 1});
        for (const float value : readDepthTexture(*device, depth->name(), kSize, kSize))
            EXPECT_EQ(value, reversed ? 0.75f : 0.25f);
    }
}

TEST_F(GlBackendTest, aDispatchReadsDrawsAndWritesImagesAndBuffers)
{
    const ResourceId drawn = drawOver({0, 0, 0, 0}, {1, 2, 3, 4}, Blend::None);
    ResourceId image;
    ResourceId buffer;
    ResourceId copy;
    graph.addPass("sums", [&](FrameGraph::Builder& builder) {
        builder.read(drawn);
        image = builder.write(builder.create(TextureDesc{"image", kSize, kSize, Format::RGBA32F}));
        buffer = builder.write(builder.create(BufferDesc{"buffer", 12}));
        return [drawn, image, buffer](Backend& to) {
            const uint32_t zeros[3] = {0, 0, 0};
            to.upload(buffer, std::as_bytes(std::span(zeros)));
            const std::array textures = {TextureBinding{0, drawn}};
            const std::array images = {ImageBinding{1, image}};
            const std::array buffers = {BufferBinding{3, buffer}};
            to.dispatch({.program = &kCompute,
                         .textures = textures,
                         .images = images,
                         .buffers = buffers,
                         .uniforms = asUniforms(FillBlock{{10, 20, 30, 40}, {}})});
        };
    });
    graph.addPass("copy", [&](FrameGraph::Builder& builder) {
        builder.read(image);
        copy = builder.write(builder.create(TextureDesc{"copy", kSize, kSize, Format::RGBA32F}));
        return [image, copy](Backend& to) { to.copyTexture(image, copy); };
    });
    graph.keep(copy);
    graph.keep(buffer);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    expectEverywhere(copy, {11, 22, 33, 44});
    uint32_t values[3] = {9, 9, 9};
    device->gl.GetNamedBufferSubData(backend->bufferName(buffer), 0, sizeof values, values);
    EXPECT_EQ(values[0], 0u);
    EXPECT_EQ(values[2], static_cast<uint32_t>(kSize * kSize))
        << "length() must be that of the resource, not the pool's";
    EXPECT_EQ(backend->drawCalls(), 2u);
}

TEST_F(GlBackendTest, whatADrawWritesToABufferIsSeenByTheNextDispatch)
{
    const ResourceId drawn = drawOver({0, 0, 0, 0}, {0, 0, 0, 0}, Blend::None);
    ResourceId counted;
    ResourceId image;
    graph.addPass("count", [&](FrameGraph::Builder& builder) {
        const ResourceId target =
            builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA8}));
        counted = builder.write(builder.create(BufferDesc{"counter", 4}));
        return [counted = counted, target](Backend& to) {
            const uint32_t zero = 0;
            to.upload(counted, asUniforms(zero));
            const std::array buffers = {BufferBinding{1, counted}};
            to.draw({.program = &kCount, .targets = {&target, 1}, .buffers = buffers, .instances = 3});
        };
    });
    graph.addPass("sums", [&](FrameGraph::Builder& builder) {
        builder.read(drawn);
        image = builder.write(builder.create(TextureDesc{"image", kSize, kSize, Format::RGBA32F}));
        counted = builder.write(counted);
        return [drawn, image, counted = counted](Backend& to) {
            const std::array textures = {TextureBinding{0, drawn}};
            const std::array images = {ImageBinding{1, image}};
            const std::array buffers = {BufferBinding{3, counted}};
            to.dispatch({.program = &kCompute,
                         .textures = textures,
                         .images = images,
                         .buffers = buffers,
                         .uniforms = asUniforms(FillBlock{})});
        };
    });
    graph.keep(counted);
    std::vector<std::string>
        order; // software renderers are coherent without barriers, so the calls are looked at
    device->gl.monitor.hook = [&order](const char* name) {
        for (const char* wanted : {"glDrawArraysInstanced", "glDispatchCompute", "glMemoryBarrier"}) {
            if (std::strcmp(name, wanted) == 0)
                order.push_back(name);
        }
        return true;
    };
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    device->gl.monitor.hook = nullptr;
    EXPECT_EQ(order, (std::vector<std::string>{"glDrawArraysInstanced", "glDrawArraysInstanced",
                                               "glMemoryBarrier", "glDispatchCompute", "glMemoryBarrier"}));
    uint32_t count = 0;
    device->gl.GetNamedBufferSubData(backend->bufferName(counted), 0, sizeof count, &count);
    EXPECT_EQ(count, static_cast<uint32_t>(4 * kSize * kSize));
}

TEST_F(GlBackendTest, integerTexturesAreClearedExactly)
{
    ResourceId target;
    graph.addPass("clear", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::R32UI}));
        return [target](Backend& to) { to.clear(target, {7, 0, 0, 0}); };
    });
    graph.keep(target);
    ASSERT_TRUE(runGraph().ok());
    for (const uint32_t value : readUintTexture(*device, backend->textureName(target), kSize, kSize))
        EXPECT_EQ(value, 7u);
}

TEST_F(GlBackendTest, aThousandDrawsEachSeeTheirOwnUniformsWhenTheRingWrapsAround)
{
    ResourceId target;
    constexpr int kDraws = 3000; // at 256 bytes a block almost three times around
    static_assert(kDraws * 256 > 2 * GlUniformRing::kCapacity);
    graph.addPass("sum", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA32F}));
        return [target](Backend& to) {
            to.clear(target, {0, 0, 0, 0});
            for (int i = 0; i < kDraws; ++i) {
                FillBlock blocks[8]; // 256 bytes
                blocks[0].color[0] = static_cast<float>(i);
                blocks[0].color[1] = 1;
                to.draw({.program = &kFill,
                         .targets = {&target, 1},
                         .uniforms = std::as_bytes(std::span(blocks)),
                         .blend = Blend::Additive});
            }
        };
    });
    graph.keep(target);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    expectEverywhere(target, {kDraws * (kDraws - 1) / 2.0f, kDraws, 0, 0});
}

TEST_F(GlBackendTest, blocksOfOddSizesAreAligned)
{
    ResourceId target;
    graph.addPass("odd", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA32F}));
        return [target](Backend& to) {
            to.clear(target, {0, 0, 0, 0});
            for (const size_t bytes : {36u, 52u, 300u, 1028u}) {
                std::array<float, 257> data{};
                data[0] = 1;
                to.draw({.program = &kFill,
                         .targets = {&target, 1},
                         .uniforms = std::as_bytes(std::span(data)).first(bytes),
                         .blend = Blend::Additive});
            }
        };
    });
    graph.keep(target);
    ASSERT_TRUE(runGraph().ok()) << backend->status().message();
    expectEverywhere(target, {4, 0, 0, 0}); // the driver reports misaligned offsets
}

TEST_F(GlBackendTest, drawsOfNothingMakeNoCall)
{
    ResourceId target;
    uint64_t calls = 1;
    graph.addPass("nothing", [&](FrameGraph::Builder& builder) {
        target = builder.write(builder.create(TextureDesc{"target", kSize, kSize, Format::RGBA32F}));
        return [target, &calls, gl = device.get()](Backend& to) {
            const uint64_t before = gl->callCount();
            to.draw({.program = &kFill, .targets = {&target, 1}, .instances = 0});
            to.draw({.program = &kFill, .targets = {&target, 1}, .vertices = 0});
            to.dispatch({.program = &kCompute, .groups = {0, 1, 1}});
            to.upload(target, {});
            calls = gl->callCount() - before;
        };
    });
    graph.keep(target);
    ASSERT_TRUE(runGraph().ok());
    EXPECT_EQ(calls, 0u);
    EXPECT_EQ(backend->drawCalls(), 0u);
}

} // namespace fx::render
