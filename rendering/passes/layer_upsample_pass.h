/// @file layer_upsample_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerUpsampleProgram{"layer upsample", "shared/fullscreen.vert.glsl",
                                                   "frame/layer_upsample.frag.glsl", nullptr, nullptr};

/// [1] relative difference of 1 / distance at which the weight of a neighboring texel becomes 0.
inline constexpr float kUpsampleReach = 0.1f;

/// Brings one layer target of reduced size to the picture's size. Each pixel takes the texel of its own block
/// at its own distance, between the block's near and far picture, and interpolates bilinearly with neighbors
/// of the same surface, so media do not leak across edges. Idea: joint bilateral upsampling, [KCLU07].
///
/// reads   sceneDistance  R32F [m] of the picture's size
///         far, near      of LayerDistancePass
///         farLight media up to `far`
///         nearLight media up to `near`; invalid without depth
/// writes  light          of the picture's size, in `format` Texels that are all equal give exactly that
/// value. Keeps no state.
class LayerUpsamplePass
{
public:
    struct Inputs
    {
        ResourceId sceneDistance;
        ResourceId far, near;
        ResourceId farLight, nearLight;
        int width, height; ///< of the picture
        int divisor;
        Format format;
        std::string_view name; ///< of the result
    };
    struct Outputs
    {
        ResourceId light;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
