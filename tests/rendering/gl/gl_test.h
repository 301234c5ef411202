/// @file gl_test.h
/// A test with a separate OpenGL context without a window. Every message of the driver fails the test.
#pragma once

#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_messages.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/platform/gl_context.h"
#include "tests/rendering/frame_graph/add_pass.h"

#include <gtest/gtest.h>

#include <memory>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

namespace fx::render {

class GlTest : public ::testing::Test
{
protected:
    void SetUp() override
    {
        auto created = createEglContext({.debug = true});
        ASSERT_TRUE(created.ok()) << created.status().message();
        context = std::move(*created);
        auto made = GlDevice::create(context->loader(), std::pmr::get_default_resource());
        ASSERT_TRUE(made.ok()) << made.status().message();
        device = std::move(*made);
        device->setSourceOverride([](std::string_view name, std::string_view) { return testShader(name); });
        messages = std::make_unique<GlMessages>(*device);
        backend = std::make_unique<GlBackend>(*device, std::pmr::get_default_resource());
        graph.begin();
    }

    void TearDown() override
    {
        if (!device)
            return;
        EXPECT_EQ(device->gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        EXPECT_EQ(messages->serious(), expectedMessages) << messages->first();
        backend.reset();
        messages.reset();
        EXPECT_EQ(device->textureBytes() + device->bufferBytes(), bytesOfTheTest);
    }

    /// Compiles and executes the declared passes of the graph.
    base::Status runGraph()
    {
        graph.compile();
        if (base::Status status = backend->beginFrame(graph); !status)
            return status;
        graph.execute(*backend);
        return backend->endFrame();
    }

    std::vector<float> read(ResourceId texture, int channels)
    {
        return readTexture(*device, backend->textureName(texture), backend->width(texture),
                           backend->height(texture), channels);
    }

    /// GLSL source of the test programs by name; empty if the name is unknown.
    static std::optional<std::string> testShader(std::string_view name);

    std::unique_ptr<GlContext> context;
    std::unique_ptr<GlDevice> device;
    std::unique_ptr<GlMessages> messages;
    std::unique_ptr<GlBackend> backend;
    FrameGraph graph{std::pmr::get_default_resource()};
    /// Number of expected driver messages, for tests that cause errors intentionally.
    uint32_t expectedMessages = 0;
    /// [byte] Memory of textures and buffers that the test still owns at its end.
    uint64_t bytesOfTheTest = 0;
};

namespace programs {
inline constexpr ProgramDesc kFill = {"fill", "fullscreen.vert", "fill.frag", nullptr, nullptr};
inline constexpr ProgramDesc kEightTargets = {"eight targets", "fullscreen.vert", "eight.frag", nullptr,
                                              nullptr};
inline constexpr ProgramDesc kSample = {"sample", "fullscreen.vert", "sample.frag", nullptr, nullptr};
inline constexpr ProgramDesc kDepth = {"depth", "depth.vert", "fill.frag", nullptr, nullptr};
inline constexpr ProgramDesc kCount = {"count", "fullscreen.vert", "count.frag", nullptr, nullptr};
inline constexpr ProgramDesc kCompute = {"sums", nullptr, nullptr, "sums.comp", nullptr};
} // namespace programs

/// Uniform block of the test programs.
struct FillBlock
{
    float color[4] = {0, 0, 0, 0};
    float depth[4] = {0, 0, 0, 0};
};

} // namespace fx::render
