/// @file field_light_pass.h
/// The pass that computes the light that each sample of the bricks scatters to the eye.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// Computes single and multiple scattering of the light of the sun, of point lights, of sky and ground; see
/// shaders/shared/scattered_light.glsl and shaders/shared/sky_light.glsl.
///
/// reads   fields, bricks  as in FieldFillPass
///         lights          all lights, with light slices
///         network         light of an illumination network
///         glow            mean radiance of the light that media emit, of FieldGlowPass
///         grids           buffer of FieldGlowBlock
/// writes  textures        without layers, the light is added to the emitted light of the medium; with
///                         layers, it is written to `scatter`, rgb over the field's largest extinction
/// The albedos are overwritten: before this pass can run again, FieldFillPass must run.
class FieldLightPass
{
public:
    struct Inputs
    {
        ResourceId fields, bricks;
        FieldTextures textures;
        LightBindings lights;
        const ViewBlock* view;            ///< view block of the picture
        uint32_t brickCount;              ///< > 0
        ResourceId glow = {}, grids = {}; ///< inputs for emitted light; invalid: no field has a grid
        /// Moments of the light in illumination networks on the same grids, from NetworkPasses; used instead
        /// of `glow`.
        ResourceId network = {};
        int networkCells = 0; ///< number of cells along a side of the network's grids
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// The program of the pass, with or without layers, detail and illumination networks.
const ProgramDesc& fieldLightProgram(bool layers, bool detail, bool network = false);

} // namespace fx::render
