/// @file present_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kPresentProgram{"present", "shared/fullscreen.vert.glsl",
                                             "frame/present.frag.glsl", nullptr, nullptr};

/// Copies the finished picture to the host's target, texel for texel.
///
/// reads   picture  the last color of the frame
/// writes  target   the host's texture or framebuffer
/// The pass keeps no state.
class PresentPass
{
public:
    struct Inputs
    {
        ResourceId picture;
        ResourceId target;
    };
    struct Outputs
    {
        ResourceId target;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
