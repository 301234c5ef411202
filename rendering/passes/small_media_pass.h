/// @file small_media_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kReduceDistanceProgram{"reduce distance", "passes/fullscreen.vert.glsl",
                                                    "passes/reduce_distance.frag.glsl", nullptr, nullptr};
inline constexpr ProgramDesc kEnlargeMediaProgram{"enlarge media", "passes/fullscreen.vert.glsl",
                                                  "passes/enlarge_media.frag.glsl", nullptr, nullptr};

/// Size of a side that is drawn `divisor` times smaller.
constexpr int reducedSide(int side, int divisor)
{
    return (side + divisor - 1) / divisor;
}

/// Distances for media that are drawn smaller than the picture: in turn the nearest and the farthest of what
/// a texel covers.
///
/// reads   distance  [m] at full size
/// writes  distance  [m] `divisor` times smaller
class ReduceDistancePass
{
public:
    struct Inputs
    {
        ResourceId distance;
        int width, height; ///< full size [pixel]
        int divisor;       ///< 2 or 4
    };
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, const Inputs& in);
};

/// Brings media that were drawn small to full size: bilinear, but each of the four texels counts the less the
/// more its distance differs from that of the pixel, so that edges of solid things stay sharp.
///
/// reads   media, smallDistance  small; distance  full size
/// writes  media  RGBA32F full size, premultiplied
class EnlargeMediaPass
{
public:
    struct Inputs
    {
        ResourceId media;
        ResourceId smallDistance;
        ResourceId distance;
        int width, height; ///< full size [pixel]
        int divisor;
    };
    [[nodiscard]] static ResourceId addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
