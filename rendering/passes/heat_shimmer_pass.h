/// @file heat_shimmer_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/view/view_types.h"

namespace fx::render {

inline constexpr ProgramDesc kHeatShimmerProgram{"heat shimmer", "passes/fullscreen.vert.glsl",
                                                 "passes/heat_shimmer.frag.glsl", nullptr, nullptr};

/// Displaces the composed picture, media included, by what HeatOffsetPass has found.
///
/// reads   color     RGBA32F exposed radiance
///         distance  [m] along the ray to opaque geometry
///         heat      of HeatOffsetPass
/// writes  color     RGBA32F, bilinear. A pixel keeps its bits where there is no heat or no displacement, and
/// where a
///                   texel it would need stands before the gas or is not finite. No texel outside the image
///                   is read: the displacement fades to 0 over the last settings.maxOffset pixels before the
///                   border.
/// Adds nothing when heat is invalid or the settings allow no displacement. Keeps no state.
class HeatShimmerPass
{
public:
    struct Inputs
    {
        ResourceId color;
        ResourceId distance;
        ResourceId heat; ///< invalid: nothing is hot
        int width, height;
        ShimmerSettings settings;
    };
    struct Outputs
    {
        ResourceId color;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
