/// @file tone_map_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kToneMapProgram{"tone map", "shared/fullscreen.vert.glsl",
                                             "frame/tone_map.frag.glsl", nullptr, "FX_DITHER=0"};
inline constexpr ProgramDesc kToneMapDitherProgram{"tone map (8 bit)", "shared/fullscreen.vert.glsl",
                                                   "frame/tone_map.frag.glsl", nullptr, "FX_DITHER=1"};

/// Converts exposed radiance to display values. Formulas: film-crosstalk, then tone-curve and srgb-encoding
/// for each channel separately.
///
/// reads   color  RGBA32F exposed radiance
/// writes  color  sRGB code values in [0, 1], as RGBA32F, or as RGBA8 with a fixed dither pattern that does
///                not change exact 8-bit values; alpha unchanged
/// The pass keeps no state.
class ToneMapPass
{
public:
    struct Inputs
    {
        ResourceId color;
        int width, height;
        /// [1] exposed radiance that is displayed as 1. Values less than 1, and NaN, are replaced by 1
        float white;
        Format format = Format::RGBA32F; ///< RGBA32F; or RGBA8, with dithering
    };
    struct Outputs
    {
        ResourceId color;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
