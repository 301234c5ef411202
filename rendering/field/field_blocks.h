/// @file field_blocks.h
/// Layouts of voxel fields on the GPU; shaders/field/field_blocks.glsl reads them.
#pragma once

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr int kBrickCells = 8; ///< cells along a side of a brick
/// samples along a side; those on faces are also in the neighboring bricks
constexpr int kBrickSamples = kBrickCells + 1;
constexpr int kBrickColumns = 16; ///< bricks in the textures along x and along y

/// A field: a lattice of cubic voxels, divided into bricks.
struct FieldBlock
{
    glm::vec4 corner;  ///< xyz first sample relative to the eye [m]; w side of a voxel [m]
    glm::ivec4 bricks; ///< xyz number of bricks along each axis; w first entry in the table of bricks
    /// x least radius of a ball [m]; y upper bound of the extinction [1/m]; z number of the field's detail +
    /// 1, 0: none; w number of the field's grid of glow + 1, 0: none
    glm::vec4 limits;
};
static_assert(sizeof(FieldBlock) == 48);

/// The detail of one field; shaders/field/field_detail.glsl reads this layout.
struct FieldDetailBlock
{
    /// Affine maps from a point p [m] to noise coordinates [cell], dot(xyz, p) + w: three rows for each
    /// generation. The offsets of balls are added to the result.
    glm::vec4 rows[6];
    glm::vec4 erosion; ///< x size of lumps [m]; y, z thinnest, densest; w ramp
    glm::vec4 noise;   ///< x gain; y weight of the second generation; z cooling; w glow
    /// xy size of lumps of each generation [m]; z factor of detail-conservation; w octaves
    glm::vec4 lumps;
    glm::vec4 soft; ///< x softening as the medium thins
};
static_assert(sizeof(FieldDetailBlock) == 160);

constexpr int kGlowCells = 32;       ///< cells along a side of a grid
constexpr int kGlowRays[2] = {8, 4}; ///< blocks along x and y in the texture of rays; one block per direction

/// A grid in which the light that media emit is propagated; shaders/field/field_glow.glsl reads this layout.
struct FieldGlowBlock
{
    glm::vec4 corner; ///< xyz [m] relative to the eye; w side of a cell [m]
    /// Like `corner`, for the grid of the last frame whose light is the start; w 0: none.
    glm::vec4 before{0.0f};
    glm::vec4 number{0.0f}; ///< x number of the grid of the last frame
};
static_assert(sizeof(FieldGlowBlock) == 48);

/// A brick that contains medium. Its index in the list gives its position in the textures.
struct FieldBrickBlock
{
    uint32_t field;
    uint32_t place; ///< position in the field, in bricks: x + 1024 y + 1024^2 z
    uint32_t first; ///< first entry of the brick in the list of numbers of balls
    uint32_t count; ///< number of its balls
};
static_assert(sizeof(FieldBrickBlock) == 16);

/// A brick that balls near the eye touch. shaders/field/field_near.comp.glsl reads this layout and that of
/// NearPartBlock.
struct NearBrickBlock
{
    uint32_t brick; ///< index of the brick
    uint32_t first; ///< index of its first NearPartBlock
    uint32_t count; ///< number of its NearPartBlocks
    uint32_t unused;
};
static_assert(sizeof(NearBrickBlock) == 16);

/// A ball in a brick.
struct NearPartBlock
{
    uint32_t number; ///< index of the ball
    float share;     ///< [1] share of the ball that is taken out of the field
};
static_assert(sizeof(NearPartBlock) == 8);

constexpr int kFieldTileColumns = 32, kFieldTileRows = 18; ///< division of the window into parts
constexpr int kFieldTiles = kFieldTileColumns * kFieldTileRows;

/// The fields that are visible in a part of the window.
struct FieldTileBlock
{
    uint32_t first; ///< first entry in the list of numbers of fields
    uint32_t count;
};
static_assert(sizeof(FieldTileBlock) == 8);

} // namespace fx::render
