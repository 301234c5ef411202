/// @file field_near_pass.h
/// The pass that subtracts shares of balls near the eye from the samples of fields.
#pragma once

#include "rendering/field/field_textures.h"

#include <cstdint>

namespace fx::render {

/// Subtracts shares of balls near the eye from fields, because these shares are drawn as loose balls. It runs
/// after the passes that propagate light through fields, because these need the whole medium, and before
/// FieldLightPass.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  of FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         nearBricks   buffer of NearBrickBlock
///         nearParts    buffer of NearPartBlock
/// writes  textures     filled, not yet lit; but not the material of detail: fields with detail keep their
///                      balls. Equal inputs give equal bits.
/// Formula: voxel-kernel.
class FieldNearPass
{
public:
    struct Inputs
    {
        ResourceId balls, fieldTexels, bricks, nearBricks, nearParts;
        FieldTextures textures;
        uint32_t nearBrickCount; ///< > 0
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// The program of the pass, with or without layers.
const ProgramDesc& fieldNearProgram(bool layers);

} // namespace fx::render
