/// @file overlay_pass.h
#pragma once

#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"

#include <span>

namespace fx::render {

inline constexpr ProgramDesc kOverlayProgram{"activation overlay", "frame/overlay.vert.glsl",
                                             "frame/overlay.frag.glsl", nullptr, nullptr};

/// Draws debug lines over the picture: the edges of boxes, each box in its color.
///
/// reads   boxes    boxes, relative to the origin of the camera
/// writes  picture  the finished picture, by blending; lines are not occluded
/// The pass is added only if the overlay of the view is enabled and has boxes. The pass keeps no state.
class OverlayPass
{
public:
    struct Inputs
    {
        ResourceId picture;
        std::span<const OverlayBox> boxes; ///< boxes, which must stay valid until the graph has executed
        const CameraView* camera;
        int width, height; ///< [pixel]
    };
    struct Outputs
    {
        ResourceId picture;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
