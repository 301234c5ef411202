/// @file layer_distance_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerDistanceProgram{"layer distance", "shared/fullscreen.vert.glsl",
                                                   "frame/layer_distance.frag.glsl", nullptr, nullptr};

inline constexpr ProgramDesc kLayerSpreadProgram{"layer spread", "shared/fullscreen.vert.glsl",
                                                 "frame/layer_spread.frag.glsl", nullptr, nullptr};

/// [1] Largest relative range of 1 / distance in a block of pixels that counts as one surface.
inline constexpr float kFlatBlock = 0.02f;

/// [1] Relative difference of distance above which a neighboring block counts as another surface.
inline constexpr float kOtherSurface = 0.05f;

/// Reduces the scene distance to the texels of layers that are smaller than the picture. A texel covers a
/// block of divisor x divisor pixels. Runs once per frame, before all draws to layers.
///
/// reads   distance  R32F [m] along each pixel's ray, +inf without geometry, in the size of the picture
/// writes  far       R32F [m] largest distance of the block; the mean distance if the block is one surface
///         near      R32F [m] smallest distance of the block; 0 if `far` suffices for the block. The texture
///                   is invalid without depth
/// Both ends of the range are used, so that media in front of a thin pillar and media behind the pillar are
/// drawn. If a block of one surface is next to a block of another surface, the range includes the distance
/// of the other surface. The pass keeps no state.
class LayerDistancePass
{
public:
    struct Inputs
    {
        ResourceId distance;
        bool hasDepth;     ///< false: there is no depth buffer, and distance is +inf everywhere
        int width, height; ///< [texel] size of the layers
        int divisor;
    };
    struct Outputs
    {
        ResourceId far, near;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
