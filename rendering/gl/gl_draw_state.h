/// @file gl_draw_state.h
/// Sets the GL state for drawing: all states once per frame, then only the states that differ between draws.
///
/// From reset() on, the state is cached. Therefore no other code may set GL state until the frame ends.
/// gl_touched_state.cpp lists the states that this class changes.
#pragma once

#include "rendering/frame_graph/backend.h"
#include "rendering/gl/gl_name.h"

#include <array>
#include <cstdint>

namespace fx::render {

class GlDrawState
{
public:
    static constexpr uint32_t kUnits = 13; ///< number of texture units, 0 to 12

    /// [pixel] The part of a framebuffer that a draw covers.
    struct Viewport
    {
        int x = 0, y = 0, width = 0, height = 0;
        bool isHosts = false; ///< the framebuffer has a target of the host

        bool operator==(const Viewport&) const = default;
    };

    explicit GlDrawState(GlDevice& device);

    /// Sets the states that affect all draws, independent of the host's state. Switches that GlStateGuard
    /// knows to be off are not set.
    /// @param encodeSrgb true: OpenGL encodes linear values that are written to targets of an sRGB format
    /// @param keepScissor true: the host's scissor test, if it is enabled, applies to draws to its targets
    void reset(bool encodeSrgb, bool keepScissor = false);

    void useProgram(uint32_t program);
    /// Binds a framebuffer and sets the viewport.
    void bindFramebuffer(uint32_t framebuffer, const Viewport& viewport);
    /// Disables the scissor test, which a draw to a target of the host may have enabled. To be called before
    /// clears and copies.
    void openScissor();
    /// If `only` is true, color writes are disabled for draw buffers other than the first.
    void drawToFirst(bool only);
    /// Sets the states of the first `count` draw buffers, which the next draw uses.
    void useTargets(uint32_t count);
    void setBlend(Blend blend);
    /// If `tested` is true, both depth test and depth writes are enabled.
    void setDepth(bool tested, bool reversed);
    void bindTexture(uint32_t unit, uint32_t texture, Sampling sampling);

private:
    void setBlendAt(uint32_t target);

    static constexpr uint32_t kTargets = 8;
    static constexpr uint32_t kUnknown = ~0u; ///< marks an unknown GL name

    struct Unit
    {
        uint32_t texture;
        uint32_t sampler;
    };

    GlDevice& device_;
    GlVertexArray vertexArray_; ///< vertex array without attributes; shaders fetch their data from buffers
    std::array<GlSampler, 5> samplers_;
    uint32_t program_ = kUnknown;
    uint32_t framebuffer_ = kUnknown;
    Viewport viewport_;
    bool hasScissor_ = false; ///< the host's scissor test is enabled and applies to its targets
    uint32_t targets_ = 0;    ///< number of draw buffers whose states have been set
    Blend blend_ = Blend::None;
    bool onlyFirst_ = false;
    bool depthTested_ = false;
    bool depthReversed_ = false;
    std::array<Unit, kUnits> units_{};
};

} // namespace fx::render
