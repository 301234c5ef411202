/// @file scene_distance_pass.h
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kSceneDistanceProgram{"scene distance", "shared/fullscreen.vert.glsl",
                                                   "frame/scene_distance.frag.glsl", nullptr, nullptr};

/// Converts the host's depth buffer to the distance along the ray of each pixel, once per frame. All later
/// passes use this distance.
///
/// reads   depth     the host's depth buffer, in the DepthConvention of the camera
/// writes  distance  R32F [m] along each pixel's ray to the opaque surface, +inf without a surface
/// Without a depth buffer the distance is +inf everywhere. The pass keeps no state.
class SceneDistancePass
{
public:
    struct Inputs
    {
        ResourceId depth; ///< the host's depth buffer; invalid: no surface occludes media
        int width, height;
        ViewBlock view;
    };
    struct Outputs
    {
        ResourceId distance;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
