/// @file layer_over_pass.h
#pragma once

#include "rendering/passes/media_pass.h"

namespace fx::render {

inline constexpr ProgramDesc kLayerOverProgram{"layer over", "shared/fullscreen.vert.glsl",
                                               "frame/layer_over.frag.glsl", nullptr, nullptr};

/// Puts layer targets over others of the same size, as if both had been drawn into the same: media that were
/// drawn small and enlarged, over solid particles that were drawn at full size.
///
/// reads   over   the six layer targets of the media pass
/// writes  under  the same six, blended in place
/// Keeps no state.
class LayerOverPass
{
public:
    using Layers = std::array<ResourceId, MediaPass::LayerTargets>;
    /// @return `under` with everything over it
    [[nodiscard]] static Layers addTo(FrameGraph& graph, const Layers& over, const Layers& under);
};

} // namespace fx::render
