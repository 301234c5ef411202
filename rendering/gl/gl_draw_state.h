/// @file gl_draw_state.h
/// Sets all GL state for drawing: all states once per frame, then only differences between draws.
///
/// The state is cached from reset() on, so no other code may set state until the frame ends. The states that
/// it changes are listed in gl_touched_state.cpp.
#pragma once

#include "rendering/frame_graph/backend.h"
#include "rendering/gl/gl_name.h"

#include <array>
#include <cstdint>

namespace fx::render {

class GlDrawState
{
public:
    static constexpr uint32_t kUnits = 13; ///< texture units 0 to 12

    explicit GlDrawState(GlDevice& device);

    /// Sets every state that affects draws, independent of the host's state.
    /// @param encodeSrgb linear values are written to targets of an sRGB format
    void reset(bool encodeSrgb);

    void useProgram(uint32_t program);
    /// Sets the viewport to the whole framebuffer.
    void bindFramebuffer(uint32_t framebuffer, int width, int height);
    void drawToFirst(bool only); ///< `only`: color writes are disabled for draw buffers other than the first
    void setBlend(Blend blend);
    void setDepth(bool tested, bool reversed); ///< `tested` enables both depth test and depth writes
    void bindTexture(uint32_t unit, uint32_t texture, Sampling sampling);

private:
    static constexpr uint32_t kTargets = 8;
    static constexpr uint32_t kUnknown = ~0u; ///< not a GL name

    struct Unit
    {
        uint32_t texture;
        uint32_t sampler;
    };

    GlDevice& device_;
    GlVertexArray vertexArray_; ///< without attributes: shaders fetch their data
    std::array<GlSampler, 5> samplers_;
    uint32_t program_ = kUnknown;
    uint32_t framebuffer_ = kUnknown;
    int width_ = 0;
    int height_ = 0;
    Blend blend_ = Blend::None;
    bool onlyFirst_ = false;
    bool depthTested_ = false;
    bool depthReversed_ = false;
    std::array<Unit, kUnits> units_{};
};

} // namespace fx::render
