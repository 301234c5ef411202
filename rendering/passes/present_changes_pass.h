/// @file present_changes_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/display_block.h"

namespace fx::render {

inline constexpr ProgramDesc kPresentChangesProgram{"present changes", "shared/fullscreen.vert.glsl",
                                                    "frame/present_changes.frag.glsl", nullptr, nullptr};

/// Writes the pixels that effects have changed to the host's target, in the encoding of the target. Formulas
/// of display encodings: tone-curve, then srgb-encoding or gamma-encoding.
///
/// reads   picture   the last color of the frame
///         before    the picture before any effect
///         original  the texels that `before` was decoded from; read only if unchanged pixels are written
/// writes  target    the host's texture or framebuffer; all samples of a pixel alike
/// The pass keeps no state.
class PresentChangesPass
{
public:
    struct Inputs
    {
        ResourceId picture;
        ResourceId before;
        ResourceId original;
        ResourceId target;
        DisplayBlock block;
    };
    struct Outputs
    {
        ResourceId target;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
