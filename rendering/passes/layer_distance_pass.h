/// @file layer_distance_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerDistanceProgram{"layer distance", "shared/fullscreen.vert.glsl",
                                                   "frame/layer_distance.frag.glsl", nullptr, nullptr};

inline constexpr ProgramDesc kLayerSpreadProgram{"layer spread", "shared/fullscreen.vert.glsl",
                                                 "frame/layer_spread.frag.glsl", nullptr, nullptr};

/// [1] relative span of 1 / distance up to which a block of pixels counts as one surface.
inline constexpr float kFlatBlock = 0.02f;

/// [1] relative difference of distance from which a neighboring block shows another surface.
inline constexpr float kOtherSurface = 0.05f;

/// Reduces the scene's distance to the texels of layers that are smaller than the picture; each covers a
/// block of divisor x divisor pixels. Executed once a frame for all draws into the layers.
///
/// reads   distance  R32F [m] along each pixel's ray, +inf for nothing, of the picture's size writes  far
/// R32F [m] largest distance of the block; the middle where the block is flat near R32F [m] smallest distance
/// of the block; 0 where one surface suffices, and nothing is drawn. Invalid without depth. Both ends of a
/// block's range are kept: media before a thin pillar and behind it are both drawn. A flat block beside
/// another surface has that surface's distance as its other end. Keeps no state.
class LayerDistancePass
{
public:
    struct Inputs
    {
        ResourceId distance;
        bool hasDepth;     ///< false: distance is +inf everywhere
        int width, height; ///< of the layers
        int divisor;
    };
    struct Outputs
    {
        ResourceId far, near;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
