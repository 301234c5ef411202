/// @file scene_distance_pass.h
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kSceneDistanceProgram{"scene distance", "shared/fullscreen.vert.glsl",
                                                   "frame/scene_distance.frag.glsl", nullptr, nullptr};

/// Converts the host's depth once a frame to the distance at which the ray of each pixel ends, for all later
/// passes.
///
/// reads depth the host's depth buffer, in its own convention writes distance R32F [m] along each pixel's ray
/// to the opaque surface, +inf without a surface Without a depth buffer the distance is +inf everywhere.
/// Keeps no state.
class SceneDistancePass
{
public:
    struct Inputs
    /// invalid: nothing occludes
    {
        ResourceId depth;
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
