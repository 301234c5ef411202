/// @file heat_shimmer_pass.h
#pragma once

#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"

#include <cstdint>
#include <span>

namespace fx::render {

inline constexpr ProgramDesc kHeatShimmerProgram{"heat shimmer", "shimmer/heat_shimmer.vert.glsl",
                                                 "shimmer/heat_shimmer.frag.glsl", nullptr, nullptr};
inline constexpr ProgramDesc kHeatShimmerBackProgram{"heat shimmer back", "shimmer/heat_shimmer.vert.glsl",
                                                     "frame/present.frag.glsl", nullptr, nullptr};

/// A rectangle of the picture that hot gas may cover. heat_shimmer.vert.glsl reads this layout.
struct HotArea
{
    uint32_t left, low;   ///< [pixel] first column and first row
    uint32_t right, high; ///< [pixel] last column + 1 and last row + 1
};
static_assert(sizeof(HotArea) == 16);

/// Displaces the pixels of the composed picture, including media, by the displacement of HeatOffsetPass.
///
/// reads   distance  [m] along the ray to opaque geometry
///         heat      output of HeatOffsetPass
/// writes  color     RGBA32F exposed radiance, bilinear. Only pixels of `areas` are drawn: first
///                   to a temporary texture, then to the picture. A pixel does not change without heat or
///                   displacement, or if a required texel is nearer than the gas or not finite. No texel
///                   outside of the image is read: the displacement decreases to 0 over the last
///                   settings.maxOffset pixels before the border.
/// No pass is added if `heat` is invalid, if there are no areas, or if the settings allow no displacement.
/// The pass keeps no state.
class HeatShimmerPass
{
public:
    struct Inputs
    {
        ResourceId color;
        ResourceId distance;
        ResourceId heat; ///< invalid if no blob is hot
        /// Areas that together cover every pixel with heat; must stay valid until the graph has executed.
        std::span<const HotArea> areas;
        int width, height;
        bool upperLeftOrigin; ///< see CameraView
        ShimmerSettings settings;
    };
    struct Outputs
    {
        ResourceId color;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
