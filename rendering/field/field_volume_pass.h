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
    /// A volume, or a frame of a sequence.
    struct Frame
    {
        glm::ivec4 low;  ///< xyz [brick] lower corner of the box of the index; w number of bricks
        glm::ivec4 size; ///< xyz [brick] size of the box of the index
        glm::vec4 light; ///< x [cd/m3] light that is stored as 1
        /// From voxels of the field's lattice to those of the volume: w times the place, plus xyz [voxel].
        glm::vec4 place{0.0f, 0.0f, 0.0f, 1.0f};
    };
    glm::vec4 rows[3]; ///< from a place [m] relative to the eye to voxels: dot(xyz, p) + w
    Frame frames[2];
    glm::vec4 factors; ///< x of the extinction; y of emitted light, with the exposure; z mean cosine
    glm::vec4 tint;    ///< rgb factor of albedo and emitted light
    glm::vec4 share;   ///< as in BlobInstance::layer, spread: fire, dust, 1 if of fire, 1 if of dust
    glm::vec4 moment;  ///< x share of the second frame; y, z [s] since the first and until the second frame
    glm::ivec4 first;  ///< x first brick of the field
};
static_assert(sizeof(FieldVolumeBlock) == 256);

/// Writes extinction, emitted light, albedo and phase function of the volume at the samples of the bricks.
///
/// reads   balls        buffer of BlobInstance
///         fieldTexels  texture written by FieldTexelPass
///         bricks       buffer of FieldBrickBlock
///         brickBalls   buffer of indices of balls
///         index        buffer of base::BrickIndex::table()
///         voxels       texture of MediumVolume::packedWithVelocities(), see voxel_texture.h
///         index[1], voxels[1]  those of the second frame; invalid unless the moment is between two frames
/// writes  textures     of FieldFillPass, which must have run before: medium, scatter, shares, table, and
///                      change: the extinction less that of the balls that stand for the volume in light
///                      slices. Formula for the balls: kernel-optical-depth (1). With detail also material:
///                      no offsets, as coordinates are fixed in the volume, and the thinning of each voxel
///                      by itself.
class FieldVolumePass
{
public:
    struct Inputs
    {
        ResourceId balls, fieldTexels, bricks, brickBalls;
        ResourceId index[2], voxels[2];
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

/// Returns the variant of the program with or without layers, for one frame or for a moment between two, and
/// with or without fields with detail.
const ProgramDesc& fieldVolumeProgram(bool layers, bool between, bool detail);

} // namespace fx::render
