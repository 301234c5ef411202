/// @file view_fixture.h
/// A host with OpenGL: a headless context, a picture of 64 x 64 pixels, a burning scene and a view of it.
#pragma once

#include "rendering/gl/gl_messages.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "tests/api/api_fixture.h"

#include <memory>
#include <string>
#include <vector>

namespace fx::test {

class ViewApiTest : public ::testing::Test
{
protected:
    static constexpr int kSize = 64;            ///< [pixel]
    static constexpr float kBackground = 0.25f; ///< exposed value of the host's picture

    ViewApiTest();
    ~ViewApiTest() override; ///< fails the test if the driver reported a message

    FxFrameDef frame() const;
    void warmUp();                ///< compiles all programs
    void fillPicture();           ///< fills the host's picture with kBackground
    std::vector<float> picture(); ///< RGBA, row by row
    FxViewStatistics statistics() const;
    void update(int frames);

    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> host_; ///< function table for OpenGL calls of the host
    std::unique_ptr<render::GlMessages> messages_;
    render::GlTexture color_;
    render::GlTexture depth_; ///< depth texture with the depth of the far plane
    HostAllocator memory_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxView* view_ = nullptr;
};

/// A frame of 90 degrees, seen from 3 m along +z. @param depth 0: no depth  @param side [pixel]
FxFrameDef frameBefore(uint32_t color, uint32_t depth, int side);

/// Names of the passes of the last frame, in the order of execution.
std::vector<std::string> passNamesOf(FxView* view);

/// Largest difference of two pictures after values above 1 are cut, as a display does.
float largestShownDifference(const std::vector<float>& a, const std::vector<float>& b);

} // namespace fx::test
