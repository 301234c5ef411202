/// @file field_fill_pass.h
/// The pass that sums the balls of each brick at the samples of the brick.
#pragma once

#include "rendering/field/field_textures.h"

#include <cstdint>

namespace fx::render {

/// Sums emission, absorption and scattering of balls.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  texture written by FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         brickBalls   buffer of indices of balls
///         materials    buffer of BlobMaterial, one per ball
///         lumpTile     texture written by LumpTilePass
/// writes  textures     emission, absorption and scattering of the balls, and the table of bricks
/// Each sample is written by one invocation, which adds the balls of the brick in the order of the list.
/// Therefore equal inputs give bit-identical results. Formula: kernel-optical-depth (1).
class FieldFillPass
{
public:
    struct Inputs
    {
        ResourceId balls, fieldTexels, bricks, brickBalls;
        FieldTextures textures;
        uint32_t brickCount;                      ///< > 0
        ResourceId materials = {}, lumpTile = {}; ///< inputs for detail; invalid: no field has detail
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Returns the variant of the program with or without layers and detail.
const ProgramDesc& fieldFillProgram(bool layers, bool detail);

} // namespace fx::render
