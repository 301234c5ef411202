/// @file post_pass_harness.h
/// Runs the passes after composition on a software OpenGL, and returns their pictures.
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_messages.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::test {

/// A picture of RGBA texels, row by row from texture coordinate 0.
struct Picture
{
    int width, height;
    std::vector<float> texels;

    Picture(int w, int h, std::array<float, 4> value = {0, 0, 0, 1});
    float* at(int x, int y) { return &texels[(size_t(y) * size_t(width) + size_t(x)) * 4]; }
};

/// Number of values whose bits differ.
size_t differentBits(std::span<const float> a, std::span<const float> b);

class PostPass : public testing::Test
{
protected:
    static void SetUpTestSuite();
    static void TearDownTestSuite();
    void SetUp() override;
    void TearDown() override;

    render::ResourceId import(const Picture& picture);
    render::ResourceId importScalar(int width, int height, std::span<const float> texels);
    render::ResourceId importTexels(int width, int height, render::Format format,
                                    std::span<const float> texels);
    render::ResourceId importBytes(std::span<const std::byte> bytes);

    /// Executes the graph. The resource `kept` stays valid after the execution. The results of the frame can
    /// be read until the next frame.
    void execute(render::ResourceId kept);
    std::vector<float> read(render::ResourceId texture, int channels = 4);
    /// Reads the content of the buffer that was imported last.
    template <class T>
    T readBuffer()
    {
        T value;
        device_->gl.GetNamedBufferSubData(buffers_.back().name(), 0, sizeof value, &value);
        return value;
    }

    std::pmr::memory_resource* memory_ = std::pmr::new_delete_resource();
    std::unique_ptr<render::FrameGraph> graph_;
    static std::unique_ptr<render::GlContext> context_;
    static std::unique_ptr<render::GlDevice> device_;

private:
    std::unique_ptr<render::GlBackend> backend_;
    std::unique_ptr<render::GlMessages> messages_;
    std::deque<render::GlTexture> textures_;
    std::deque<render::GlBuffer> buffers_;
};

} // namespace fx::test
