/// @file field_near_pass.h
/// The pass that subtracts balls near the eye from the samples of fields.
#pragma once

#include "rendering/field/field_textures.h"

#include <cstdint>

namespace fx::render {

/// Subtracts balls near the eye from fields, completely or in part, because FieldMarchPass integrates the
/// subtracted part exactly. The pass runs before FieldLightPass, and after the passes that propagate light
/// through fields. Light propagation needs the whole medium.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  texture written by FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         nearBricks   buffer of NearBrickBlock
///         nearParts    buffer of NearPartBlock
/// writes  textures     textures of FieldFillPass, before FieldLightPass. Fields with detail do not change.
/// Equal inputs give bit-identical results. Formula: voxel-kernel.
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

/// Returns the variant of the program with or without layers.
const ProgramDesc& fieldNearProgram(bool layers);

} // namespace fx::render
