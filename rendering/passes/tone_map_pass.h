/// @file tone_map_pass.h
#pragma once

#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

inline constexpr ProgramDesc kToneMapProgram{"tone map", "shared/fullscreen.vert.glsl",
                                             "frame/tone_map.frag.glsl", nullptr, "FX_DITHER=0"};
inline constexpr ProgramDesc kToneMapDitherProgram{"tone map (8 bit)", "shared/fullscreen.vert.glsl",
                                                   "frame/tone_map.frag.glsl", nullptr, "FX_DITHER=1"};

/// Converts exposed radiance to display values. Formulas: film-crosstalk, then tone-curve and srgb-encoding,
/// each channel separately.
///
/// reads   color  RGBA32F exposed radiance writes  color  sRGB code values in [0, 1]: RGBA32F as they are, or
///                RGBA8 dithered by a fixed pattern that leaves exact 8-bit values alone; alpha unchanged
/// Keeps no state.
class ToneMapPass
{
public:
    struct Inputs
    {
        ResourceId color;
        int width, height;
        float white;                     ///< [1] radiance shown as 1; less than 1, or NaN, counts as 1
        Format format = Format::RGBA32F; ///< RGBA8 dithers
    };
    struct Outputs
    {
        ResourceId color;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
