/// @file layer_sums_pass.h
/// Passes that process the layer targets of the media pass.
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerOverProgram{"layer over", "shared/fullscreen.vert.glsl",
                                               "frame/layer_sums.frag.glsl", nullptr, "FX_OVER=1"};
inline constexpr ProgramDesc kLayerResolveProgram{"layer resolve", "shared/fullscreen.vert.glsl",
                                                  "frame/layer_sums.frag.glsl", nullptr, "FX_OVER=0"};

/// Composites layer targets over others of the same size, as if both had been drawn into the same targets:
/// upsampled media over solid particles at full size.
///
/// reads   over   the six layer targets of the media pass writes  under  the same six, blended in place Keeps
/// no state.
class LayerOverPass
{
public:
    using Layers = std::array<ResourceId, MediaPass::LayerTargets>;
    /// @return `under` with everything over it
    [[nodiscard]] static Layers addTo(FrameGraph& graph, const Layers& over, const Layers& under);
};

/// Gives every layer its own share of opacity, adds the layers up, and turns the depth moment into a
/// distance.
///
/// reads   the media pass's layer targets but the optical depth writes  fire, smoke, dust, media  RGBA32F
///         exposed radiance reaching the eye, premultiplied depth R32F [m] mean distance weighted by seen
///         opacity, +inf where there are no media
/// The layers' colors and alphas sum to those of media exactly as floats are added. Keeps no state.
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
