/// @file field_near_pass.h
/// The pass that subtracts balls near the eye from the samples of fields.
#pragma once

#include "rendering/field/field_textures.h"

#include <cstdint>

namespace fx::render {

/// Subtracts balls near the eye from fields, completely or in part, because FieldMarchPass integrates the
/// subtracted part exactly. The pass runs after the passes that propagate light through fields: light
/// propagation needs the whole medium. Of fields without detail, it runs before FieldLightPass, since near
/// balls are lit as balls. Of fields with detail it runs after it, and changes extinction and emitted light
/// only: the ratios of the other textures to the whole extinction, which FieldLightPass stores, stay.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  texture written by FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         nearBricks   buffer of NearBrickBlock
///         nearParts    buffer of NearPartBlock
/// writes  textures     textures of FieldFillPass
/// Equal inputs give bit-identical results. Formula: voxel-kernel.
class FieldNearPass
{
public:
    struct Inputs
    {
        ResourceId balls, fieldTexels, bricks, nearBricks, nearParts;
        FieldTextures textures;
        uint32_t nearBrickCount; ///< > 0
        bool detail;             ///< true: only fields with detail change; false: only fields without
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Returns the program for fields without detail, with or without layers.
const ProgramDesc& fieldNearProgram(bool layers);
/// Program for fields with detail.
extern const ProgramDesc kFieldNearDetailProgram;

} // namespace fx::render
