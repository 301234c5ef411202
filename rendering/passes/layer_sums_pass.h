/// @file layer_sums_pass.h
/// Passes that process the layer targets of the media pass.
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerOverProgram{"layer over", "shared/fullscreen.vert.glsl",
                                               "frame/layer_sums.frag.glsl", nullptr, "FX_OVER=1"};
inline constexpr ProgramDesc kLayerResolveProgram{"layer resolve", "shared/fullscreen.vert.glsl",
                                                  "frame/layer_sums.frag.glsl", nullptr, "FX_OVER=0"};

/// Composites the layer targets `over` over the layer targets `under`. The result is as if all elements had
/// been drawn to `under`. The pass is used for upsampled media over opaque particles at full size.
///
/// reads   over   the six layer targets of the media pass
/// writes  under  six layer targets of equal size, blended in place
/// The pass keeps no state.
class LayerOverPass
{
public:
    using Layers = std::array<ResourceId, MediaPass::LayerTargets>;
    /// Adds the pass. @return new versions of `under`
    [[nodiscard]] static Layers addTo(FrameGraph& graph, const Layers& over, const Layers& under);
};

/// Computes the opacity of each layer, the sum of layers, and the mean distance from the depth moment.
///
/// reads   layers                    targets of the media pass, except the optical depth
/// writes  fire, smoke, dust, media  RGBA32F exposed radiance reaching the eye, premultiplied
///         depth                     R32F [m] mean distance weighted by visible opacity, +inf without media
/// Colors and alphas of `media` are exactly the float sums of fire, smoke and dust. The pass keeps no state.
class LayerResolvePass
{
public:
    struct Inputs
    {
        std::array<ResourceId, MediaPass::LayerTargets> layers;
        int width, height;
    };
    struct Outputs
    {
        ResourceId fire, smoke, dust, media, depth;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
