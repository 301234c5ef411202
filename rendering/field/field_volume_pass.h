/// @file field_volume_pass.h
/// The pass that fills the bricks of a field from a volume on voxels.
#pragma once

#include "rendering/field/field_textures.h"

#include <glm/vec4.hpp>

#include <cstdint>

namespace fx::render {

/// Numbers of one volume; shaders/field/field_volume.comp.glsl reads this layout.
struct FieldVolumeBlock
{
    glm::vec4 rows[3]; ///< from a place [m] relative to the eye to voxels: dot(xyz, p) + w
    glm::ivec4 low;    ///< xyz [brick] lower corner of the box of the index; w first brick of the field
    glm::ivec4 size;   ///< xyz [brick] size of the box of the index
    glm::vec4 factors; ///< x of the extinction; y of emitted light, with the exposure; z mean cosine
    glm::vec4 share;   ///< as in BlobInstance::layer, spread: fire, dust, 1 if of fire, 1 if of dust
};
static_assert(sizeof(FieldVolumeBlock) == 112);

/// Writes extinction, emitted light, albedo and phase function of the volume at the samples of the bricks.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  texture written by FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         brickBalls   buffer of indices of balls
///         index        buffer of base::BrickIndex::table()
///         voxels       buffer of MediumVolume::packed()
/// writes  textures     of FieldFillPass, which must have run before: medium, scatter, shares, table, and
///                      change: the extinction less that of the balls that stand for the volume in light
///                      slices. Formula for the balls: kernel-optical-depth (1).
class FieldVolumePass
{
public:
    struct Inputs
    {
        ResourceId balls, fieldTexels, bricks, brickBalls;
        ResourceId index, voxels;
        FieldTextures textures;
        FieldVolumeBlock block;
        uint32_t brickCount; ///< > 0
    };
    struct Outputs
    {
        FieldTextures textures;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

/// Returns the variant of the program with or without layers.
const ProgramDesc& fieldVolumeProgram(bool layers);

} // namespace fx::render
