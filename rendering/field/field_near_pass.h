/// @file field_near_pass.h
/// The pass that takes shares of balls near the eye out of the samples of fields.
#pragma once

#include "rendering/field/field_textures.h"

#include <cstdint>

namespace fx::render {

/// Comes between the passes that spread light through fields, which need all of the medium, and
/// FieldLightPass.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  of FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         nearBricks   buffer of NearBrickBlock
///         nearParts    buffer of NearPartBlock
/// writes  textures     filled, not yet lit; without the material of detail, as fields with detail keep their
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

/// The program with or without layers.
const ProgramDesc& fieldNearProgram(bool layers);

} // namespace fx::render
