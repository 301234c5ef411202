/// @file field_light_pass.h
/// The pass that computes the light that each sample of the bricks scatters to the eye.
#pragma once

#include "rendering/field/field_textures.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/light_bindings.h"

#include <cstdint>

namespace fx::render {

/// Computes single and multiple scattering of the light of the sun, of point lights, and of sky and ground.
/// Shader code: shaders/shared/scattered_light.glsl and shaders/shared/sky_light.glsl.
///
/// reads   fields, bricks  buffers of FieldBlock and FieldBrickBlock
///         lights          all lights, with light slices
///         network         moments of the light in illumination networks
///         glow            result of FieldGlowPass: mean radiance of the light that media emit
///         grids           buffer of FieldGlowBlock
/// writes  textures        `medium`: emitted plus scattered light. With layers or detail, instead `scatter`:
///                         scattered light over the field's largest extinction
/// The pass overwrites its inputs. FieldFillPass must run before this pass can run again.
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
        /// Moments of the light in illumination networks on `grids`, from NetworkPasses. If valid, they
        /// replace `glow`.
        ResourceId network = {};
        int networkBlock = 0; ///< [texel] size of a block of moments along x
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Returns the variant of the program with or without layers, detail and illumination networks.
const ProgramDesc& fieldLightProgram(bool layers, bool detail, bool network = false);

} // namespace fx::render
