/// @file field_light_pass.h
/// The pass that computes the light that each sample of the bricks scatters to the eye.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// Light of the sun, of points, of sky and ground, scattered once and again:
/// shaders/shared/scattered_light.glsl, shaders/shared/sky_light.glsl.
///
/// reads   fields, bricks  as in FieldFillPass
///         lights
///         network         light that an illumination network carries
///         glow, grids     mean radiance of what media emit, of FieldGlowPass, and buffer of FieldGlowBlock
/// writes  textures        without layers, adds the light to what the medium emits; with them keeps it in
/// `scatter`,
///                         rgb over the field's largest extinction. Albedos are lost: fill again to light
///                         again
class FieldLightPass
{
public:
    struct Inputs
    {
        ResourceId fields, bricks;
        FieldTextures textures;
        LightBindings lights;
        const ViewBlock* view;            ///< of the picture
        uint32_t brickCount;              ///< > 0
        ResourceId glow = {}, grids = {}; ///< invalid: no field has a grid
        ResourceId network = {};          ///< moments of NetworkPasses for the same grids, in place of `glow`
        int networkCells = 0;             ///< along a side of those
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// The program with or without layers and detail.
const ProgramDesc& fieldLightProgram(bool layers, bool detail, bool network = false);

} // namespace fx::render
