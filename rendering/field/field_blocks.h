/// @file field_blocks.h
/// Layouts of voxel fields on the GPU. shaders/field/field_blocks.glsl defines equal layouts.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fx::render {

constexpr int kBrickCells = 8; ///< number of cells along a side of a brick
/// Number of samples along a side of a brick. Samples on the faces of a brick are also stored in the
/// neighboring bricks.
constexpr int kBrickSamples = kBrickCells + 1;
constexpr int kBrickColumns = 16; ///< number of bricks in the textures along x and along y

/// A field: a lattice of cubic voxels, divided into bricks.
struct FieldBlock
{
    glm::vec4 corner; ///< xyz position of the first sample relative to the eye [m]; w side of a voxel [m]
    /// xyz number of bricks along each axis; w index of the field's first entry in the table of bricks.
    glm::ivec4 bricks;
    /// x least radius of a ball [m]; below 0: the field is filled from a volume, and -x is the radius of the
    /// balls that stand for the volume in the light slices; y upper bound of the extinction [1/m]; z index of
    /// the field's detail + 1, 0: no detail; w index of the field's FieldGlowBlock + 1, 0: no grid
    glm::vec4 limits;
};
static_assert(sizeof(FieldBlock) == 48);

/// Detail of one field; shaders/field/field_detail.glsl reads this layout.
struct FieldDetailBlock
{
    /// Rows of two affine maps from a point p [m] to noise coordinates [cell], three rows for each map. A
    /// coordinate is dot(xyz, p) + w. The offsets of balls are added to the result. The maps belong to two
    /// generations of the noise, which are blended.
    glm::vec4 rows[6];
    glm::vec4 erosion; ///< x size of lumps [m]; y, z, w thinnest, densest, ramp of FieldDetailNumbers
    /// x gain of FieldDetailNumbers; y weight of the second generation; z cooling and w glow of
    /// FieldDetailNumbers.
    glm::vec4 noise;
    /// xy size of the lumps of each generation [m]; z factor of formula detail-conservation; w number of
    /// octaves
    glm::vec4 lumps;
    /// x softening of FieldDetailNumbers. FieldTexels sets the others: y index of the first texel of the
    /// field's balls near the eye, z number of these balls, w distance from the eye beyond which there are
    /// none of them [m].
    glm::vec4 soft;
};
static_assert(sizeof(FieldDetailBlock) == 160);

constexpr int kGlowCells = 32; ///< number of cells along a side of a grid
/// Number of blocks along x and y in the texture GlowTextures::rays. Each direction has one block.
constexpr int kGlowRays[2] = {8, 4};

/// A grid in which the light that media emit is propagated; shaders/field/field_glow.glsl reads this layout.
struct FieldGlowBlock
{
    glm::vec4 corner; ///< xyz lowest corner relative to the eye [m]; w side of a cell [m]
    /// `corner` of a grid of the last frame. The propagation starts from the light of that grid. w 0: the
    /// propagation starts without light.
    glm::vec4 before{0.0f};
    /// xyz number of cells along each axis; w sum of the cells along z of the grids that precede this one.
    glm::ivec4 cells{kGlowCells, kGlowCells, kGlowCells, 0};
    glm::ivec4 cellsBefore{0}; ///< like `cells`, of the grid of `before` in the last frame
};
static_assert(sizeof(FieldGlowBlock) == 64);

/// Size of a block of texels that holds all grids, one above the other along z: largest numbers of cells
/// along x and y, sum of the numbers of cells along z.
inline glm::ivec3 glowExtent(std::span<const FieldGlowBlock> grids)
{
    glm::ivec3 extent{0};
    for (const FieldGlowBlock& grid : grids)
        extent = {std::max(extent.x, grid.cells.x), std::max(extent.y, grid.cells.y),
                  extent.z + grid.cells.z};
    return extent;
}

/// A brick that contains medium. The index of a brick in the list gives its position in the textures.
struct FieldBrickBlock
{
    uint32_t field;
    uint32_t place; ///< position of the brick in its field, in bricks: x + 1024 y + 1024^2 z
    uint32_t first; ///< index of the brick's first ball in the list of balls
    uint32_t count; ///< number of balls of the brick
};
static_assert(sizeof(FieldBrickBlock) == 16);

/// A brick that balls near the eye touch. shaders/field/field_near.comp.glsl reads the layouts of
/// NearBrickBlock and NearPartBlock.
struct NearBrickBlock
{
    uint32_t brick; ///< index of the brick
    uint32_t first; ///< index of the brick's first NearPartBlock
    uint32_t count; ///< number of NearPartBlocks of the brick
    uint32_t unused;
};
static_assert(sizeof(NearBrickBlock) == 16);

/// A ball that touches a brick.
struct NearPartBlock
{
    uint32_t number; ///< index of the ball
    float share;     ///< [1] fraction of the ball's extinction that is removed from the field
};
static_assert(sizeof(NearPartBlock) == 8);

/// Number of parts into which the window is divided along x and y.
constexpr int kFieldTileColumns = 32, kFieldTileRows = 18;
constexpr int kFieldTiles = kFieldTileColumns * kFieldTileRows;

/// Range of the list of fields: the fields that are visible in a part of the window.
struct FieldTileBlock
{
    uint32_t first; ///< index of the first entry in the list of fields
    uint32_t count;
};
static_assert(sizeof(FieldTileBlock) == 8);

} // namespace fx::render
