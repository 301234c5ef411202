/// @file composite_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/display_block.h"

#include <optional>

namespace fx::render {

inline constexpr ProgramDesc kCompositeBlendProgram{"composite (blend)", "shared/fullscreen.vert.glsl",
                                                    "frame/composite.frag.glsl", nullptr,
                                                    "FX_BLEND=1 FX_DISPLAY=0 FX_OFFSET=0"};
inline constexpr ProgramDesc kCompositeOffsetProgram{
    "composite (blend, offset)", "shared/fullscreen.vert.glsl", "frame/composite.frag.glsl", nullptr,
    "FX_BLEND=1 FX_DISPLAY=0 FX_OFFSET=1"};
inline constexpr ProgramDesc kCompositeProgram{"composite", "shared/fullscreen.vert.glsl",
                                               "frame/composite.frag.glsl", nullptr,
                                               "FX_BLEND=0 FX_DISPLAY=0 FX_OFFSET=0"};
inline constexpr ProgramDesc kCompositeDisplayProgram{"composite (display)", "shared/fullscreen.vert.glsl",
                                                      "frame/composite.frag.glsl", nullptr,
                                                      "FX_BLEND=0 FX_DISPLAY=1 FX_OFFSET=0"};

/// Blends the media over the host's picture: result = media + (1 - media alpha) * picture.
///
/// reads   media    RGBA32F premultiplied
///         picture  the host's opaque picture, exposed radiance
/// writes  the picture by blending in place, or a new RGBA32F texture
/// The pass keeps no state.
class CompositePass
{
public:
    struct Inputs
    {
        ResourceId media;
        ResourceId picture;
        int width, height;
        bool inPlace; ///< true: blend into `picture`; false: create a new texture
        /// Uniforms for a picture that is not at (0, 0) of its target, and for a decoded one, in which the
        /// formula film-crosstalk is applied to the media; empty: neither.
        std::optional<DisplayBlock> display{};
    };
    struct Outputs
    {
        ResourceId color;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
