/// @file heat_offset_pass.h
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kHeatOffsetProgram{"heat offset", "shimmer/heat_shimmer_offset.vert.glsl",
                                                "shimmer/heat_shimmer_offset.frag.glsl", nullptr, nullptr};

/// [s] Period of the motion of eddies in hot gas.
inline constexpr double kHeatPeriod = 8.0;

/// Returns the phase of `time` [s] in the period kHeatPeriod, [0, 1). A time that is not finite gives 0.
float heatPhase(double time);

/// Draws, for blobs with heat, the displacement [pixel] of a distant background by refraction. Formulas:
/// heat-stream and heat-refraction; kernel-optical-depth for the visible fraction of a blob.
///
/// reads   blobs     buffer of BlobInstance
///         distance  [m] along the ray to opaque geometry
/// writes  heat      RGBA32F sum over blobs: xy displacement [pixel]; z weight [1]; w weight * distance [m]
/// If no blob is hot or the settings allow no displacement, no pass is added and `heat` is invalid. The pass
/// keeps no state: the motion of eddies is a function of time.
class HeatOffsetPass
{
public:
    struct Inputs
    {
        ResourceId blobs;
        ResourceId distance;
        uint32_t count; ///< number of blobs, both hot and cold
        bool anyHeat;   ///< true: a blob has heat > 0
        int width, height;
        ViewBlock view;
        ShimmerSettings settings;
        double time; ///< [s] scene time
    };
    struct Outputs
    {
        ResourceId heat;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
