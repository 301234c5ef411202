/// @file field_blocks.h
/// Voxel fields as the GPU gets them; shaders/field/field_blocks.glsl reads these layouts.
#pragma once

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

constexpr int kBrickCells = 8;                 ///< cells between samples along a side of a brick
constexpr int kBrickSamples = kBrickCells + 1; ///< those on the faces are in the neighbors as well
constexpr int kBrickColumns = 16;              ///< bricks of the textures along x and along y

/// A lattice of cubes, divided into bricks.
struct FieldBlock
{
    glm::vec4 corner;  ///< xyz [m] of the first sample relative to the eye; w side of a voxel [m]
    glm::ivec4 bricks; ///< xyz along each axis; w first entry in the table of bricks
    glm::vec4 limits;  ///< x least radius of a ball [m]; y no extinction is larger [1/m]; z number of its
                       ///< detail + 1, 0: none; w number of the grid of its glow + 1, 0: none
};
static_assert(sizeof(FieldBlock) == 48);

/// The detail of one field; shaders/field/field_detail.glsl reads this layout.
struct FieldDetailBlock
{
    /// Coordinates in cells of the generations, without the offsets of balls: dot(xyz, p) + w.
    glm::vec4 rows[6];
    glm::vec4 erosion; ///< x size of lumps [m]; y, z thinnest, densest; w ramp
    glm::vec4 noise;   ///< x gain; y weight of the second generation; z cooling; w glow
    glm::vec4 lumps;   ///< xy size of the generations' lumps [m]; z factor that keeps the whole; w octaves
    glm::vec4 soft;    ///< x softening as the medium thins
};
static_assert(sizeof(FieldDetailBlock) == 160);

constexpr int kGlowCells = 32;       ///< along a side of a grid
constexpr int kGlowRays[2] = {8, 4}; ///< grids beside each other that hold the rays of all directions

/// A grid in which the light that media emit is spread; shaders/field/field_glow.glsl reads this layout.
struct FieldGlowBlock
{
    glm::vec4 corner;       ///< xyz [m] relative to the eye; w side of a cell [m]
    glm::vec4 before{0.0f}; ///< the same of the grid whose light it goes on from; w 0: none
    glm::vec4 number{0.0f}; ///< x of that grid
};
static_assert(sizeof(FieldGlowBlock) == 48);

/// A brick that holds medium. Its number is its place in the textures.
struct FieldBrickBlock
{
    uint32_t field;
    uint32_t place; ///< in bricks of its field: x + 1024 y + 1024^2 z
    uint32_t first; ///< of its balls, in the list of numbers of balls
    uint32_t count; ///< of its balls
};
static_assert(sizeof(FieldBrickBlock) == 16);

/// A brick that balls near the eye touch; shaders/field/field_near.comp.glsl reads this layout and the next.
struct NearBrickBlock
{
    uint32_t brick; ///< number
    uint32_t first; ///< of its NearPartBlocks
    uint32_t count; ///< of them
    uint32_t unused;
};
static_assert(sizeof(NearBrickBlock) == 16);

/// A ball in a brick.
struct NearPartBlock
{
    uint32_t number; ///< of the ball
    float share;     ///< [1] that is taken out of the field
};
static_assert(sizeof(NearPartBlock) == 8);

constexpr int kFieldTileColumns = 32, kFieldTileRows = 18; ///< that the window is divided into
constexpr int kFieldTiles = kFieldTileColumns * kFieldTileRows;

/// The fields that are seen in a part of the window.
struct FieldTileBlock
{
    uint32_t first; ///< in the list of numbers of fields
    uint32_t count;
};
static_assert(sizeof(FieldTileBlock) == 8);

} // namespace fx::render
