/// @file layer_resolve_pass.h
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerResolveProgram{"layer resolve", "shared/fullscreen.vert.glsl",
                                                  "frame/layer_resolve.frag.glsl", nullptr, nullptr};

/// Gives every layer its own share of opacity, adds the layers up, and turns the depth moment into a
/// distance.
///
/// reads   the media pass's layer targets
/// writes  fire, smoke, dust, media  RGBA32F exposed radiance reaching the eye, premultiplied
///         depth                     R32F [m] mean distance weighted by seen opacity, +inf where there are no
///         media
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
