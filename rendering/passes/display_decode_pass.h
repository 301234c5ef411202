/// @file display_decode_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"
#include "rendering/passes/display_block.h"

namespace fx::render {

inline constexpr ProgramDesc kDisplayDecodeProgram{"display decode", "shared/fullscreen.vert.glsl",
                                                   "frame/display_decode.frag.glsl", nullptr, nullptr};

/// Converts display codes to exposed radiance. Formulas: srgb-decoding or gamma-decoding, then
/// tone-curve-inverse, for each channel separately.
///
/// reads   picture  codes of the host's picture; values outside of [0, 1] are clamped, NaN is 0
/// writes  color    RGBA32F exposed radiance in [0, white]; alpha unchanged, but at least 0
/// The pass keeps no state.
class DisplayDecodePass
{
public:
    struct Inputs
    {
        ResourceId picture;
        int width, height;
        DisplayBlock block;
    };
    struct Outputs
    {
        ResourceId color;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
