/// @file layer_upsample_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerUpsampleProgram{"layer upsample", "shared/fullscreen.vert.glsl",
                                                   "frame/layer_upsample.frag.glsl", nullptr, nullptr};

/// [1] Relative difference of 1 / distance at which the weight of a neighboring texel becomes 0.
inline constexpr float kUpsampleReach = 0.1f;

/// Upsamples one layer target of reduced size to the size of the picture. For each pixel, the texel of its
/// block is interpolated between nearLight and farLight, depending on the pixel's distance. The result is
/// interpolated bilinearly with neighboring texels of the same surface, so that media do not leak across
/// edges. Based on joint bilateral upsampling, [KCLU07].
///
/// reads   sceneDistance  R32F [m] in the size of the picture
///         far, near      outputs of LayerDistancePass
///         farLight       media up to `far`
///         nearLight      media up to `near`; invalid without depth
/// writes  light          `format`, in the size of the picture
/// Where all texels are equal, pixels get exactly the value of the texels. The pass keeps no state.
class LayerUpsamplePass
{
public:
    struct Inputs
    {
        ResourceId sceneDistance;
        ResourceId far, near;
        ResourceId farLight, nearLight;
        int width, height; ///< [pixel] size of the picture
        int divisor;
        Format format;
        std::string_view name; ///< name of the resulting texture
    };
    struct Outputs
    {
        ResourceId light;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
