/// @file field_plan.h
/// Layout of the voxels in which the balls of each effect are summed: lattices, occupied bricks, balls of
/// each brick, and rectangles of fields in the window.
///
/// Lattices are fixed in the world, so that voxels do not move with the effect or the eye. The sides of
/// voxels are powers of 2^(1/4) m. A brick exists if a ball touches the brick and the brick may be visible.
/// The balls of a brick are summed in the order of the list of balls, so that equal inputs give
/// bit-identical results.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field/field_glow_plan.h"
#include "rendering/field/field_near_plan.h"
#include "rendering/field/network_choice.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A medium on voxels, from which the field of an effect is filled instead of from its balls. Each ball of
/// the effect is concentric with a brick of 8 x 8 x 8 cells, and each brick with medium has a ball.
struct FieldVolume
{
    glm::dvec3 origin{0.0}; ///< [m] center of the voxel (0, 0, 0) relative to the eye; a corner of a brick
    double side = 1.0;      ///< [m] side of a voxel
    bool isAligned = true;  ///< true: the axes of voxels are those of the world
    float largest = 0.0f;   ///< [1/m] largest extinction
    bool isFine = false;    ///< true: there are no coarser voxels yet
};

constexpr uint32_t kVolumeBudget = 8; ///< see FieldPlanInputs::mostBricks

/// A field that is filled from a volume.
struct PlacedVolume
{
    uint32_t field;
    uint32_t volume;     ///< index in FieldPlanInputs::volumes
    int level;           ///< voxels of the field have 2^level times the side of those of the volume
    uint32_t firstBrick; ///< range of the field's bricks
    uint32_t brickCount;
    bool wantsCoarser; ///< true: coarser voxels than those of `level` would be drawn if they were there
};

struct FieldPlanInputs
{
    std::span<const BlobInstance> balls; ///< the balls that may be visible
    std::span<const BlobEffect> effects; ///< effects of all balls, in the order of the balls
    const CameraGeometry* camera;
    int width, height;   ///< [pixel] size of the picture
    int resolution = 96; ///< number of voxels along 16 radii of an effect's balls, 16..256
    /// Largest number of bricks of all fields together. 0: the number of bricks of a cube with `resolution`
    /// voxels along a side. Fields of volumes may have kVolumeBudget times as many together, and all fields
    /// as many as fit into a texture of 2048 texels along each axis.
    uint32_t mostBricks = 0;
    bool glows = true; ///< true: emitted light is propagated in grids, see FieldPlan::glows()
    /// Side of the cube of as many cells as the grid of an illumination network may have; 0: no networks.
    int networkCells = 0;
    /// True: only media that gain from a network have one, see networkUse(); without any such medium, emitted
    /// light is propagated as with networkCells 0.
    bool choosesNetworks = false;
    std::span<const FieldVolume> volumes = {}; ///< volumes of effects, by BlobEffect::volume
};

/// Builds the layout of a frame. The memory is kept from frame to frame. Threads: one at a time.
class FieldPlan
{
public:
    explicit FieldPlan(std::pmr::memory_resource* memory);

    /// @return false: a volume without coarser voxels needs them; there are no fields
    bool build(const FieldPlanInputs& in);
    void clear();

    std::span<const FieldBlock> fields() const { return fields_; }
    std::span<const FieldBrickBlock> bricks() const { return bricks_; }
    /// Table of bricks: one entry for each possible brick in the box of each field, x fastest. An entry is
    /// the index of the brick + 1, or 0 if there is no brick.
    std::span<const uint32_t> table() const { return table_; }
    std::span<const uint32_t> balls() const { return balls_; } ///< indices of the balls of all bricks
    /// One entry for each part of the window, beginning at clip position -1, -1, x fastest; empty without
    /// bricks.
    std::span<const FieldTileBlock> tiles() const { return tiles_; }
    /// Indices of the fields, for all tiles. FieldTileBlock gives the range of a tile.
    std::span<const uint32_t> tileFields() const { return tileFields_; }
    /// Indices of the balls that are too small for the voxels of their effect, in ascending order. Bricks do
    /// not contain these balls.
    std::span<const uint32_t> loose() const { return loose_; }
    /// Balls near the eye, which FieldNearPass subtracts from the bricks.
    const FieldNearPlan& near() const { return near_; }
    /// Grids in which light is propagated. FieldBlock::limits.w gives the grid of each field.
    std::span<const FieldGlowBlock> glows() const { return glow_.grids(); }
    bool hasNetworks() const { return hasNetworks_; } ///< true: glows() are grids of illumination networks
    std::span<const PlacedVolume> volumes() const { return volumes_; } ///< in the order of fields
    bool isEmpty() const { return bricks_.empty(); }

    /// [m] Least radius of a ball in a field. A smaller ball could fall between samples. Therefore its
    /// radius is increased to the least radius. Its cross section does not change.
    static float leastRadius(float voxel) { return 2.0f * voxel; }

private:
    struct Lattice
    {
        float voxel = 0.0f;        ///< [m]
        glm::vec3 low{0.0f};       ///< [m] lower corner of the visible balls, relative to the eye
        glm::vec3 high{0.0f};      ///< [m] upper corner
        uint32_t field = 0;        ///< index among the fields with balls
        float wanted = 0.0f;       ///< [m] of a volume: side of a voxel before it is rounded to a level
        int level = 0;             ///< of a volume
        bool wantsCoarser = false; ///< see PlacedVolume

        bool hasBalls() const { return low.x <= high.x; }
    };

    void chooseVoxels(const FieldPlanInputs& in);
    static void bound(Lattice& lattice, const FieldPlanInputs& in, const BlobEffect& effect);
    void buildGlow(const FieldPlanInputs& in);
    void enlargeVoxels(const FieldPlanInputs& in, bool smoothOnly);
    bool place(const FieldPlanInputs& in); ///< returns false if there are too many bricks
    bool placeField(Lattice& lattice, const BlobEffect& effect, const FieldPlanInputs& in);
    void enlarge(Lattice& lattice, const BlobEffect& effect, const FieldPlanInputs& in);
    static void chooseLevel(Lattice& lattice, const FieldVolume& volume);
    static float reachOf(const BlobInstance& ball, const BlobEffect& effect, const Lattice& lattice,
                         const FieldPlanInputs& in);
    static bool isLoose(const BlobInstance& ball, const BlobEffect& effect, float voxel);
    bool countBalls(const FieldPlanInputs& in); ///< returns false if there are too many bricks
    void listBalls(const FieldPlanInputs& in);
    void listNear(const FieldPlanInputs& in);
    void listBall(const FieldBlock& field, const BlobInstance& ball, float reach, uint32_t number);
    void listVolumes(const FieldPlanInputs& in);
    void listBricks();
    void listTiles(const FieldPlanInputs& in);
    void markTiles(const FieldPlanInputs& in, const FieldBrickBlock& brick);
    /// [m] Position of the brick's center relative to the eye.
    glm::vec3 middleOf(const FieldBrickBlock& brick) const;

    std::pmr::vector<Lattice> lattices_; ///< lattice of each effect
    std::pmr::vector<FieldBlock> fields_;
    std::pmr::vector<FieldBrickBlock> bricks_;
    std::pmr::vector<uint32_t> table_;
    std::pmr::vector<uint32_t> balls_;
    std::pmr::vector<uint32_t> loose_;
    std::pmr::vector<PlacedVolume> volumes_;
    bool isOverBalls_ = false, isOverVolumes_ = false; ///< whether a budget of bricks is exceeded
    bool lacksLevels_ = false;                         ///< see build()
    std::pmr::vector<float> peaks_;   ///< [1/m] for each brick: sum of the central extinctions of its balls
    std::pmr::vector<float> emitted_; ///< [exposed m2] for each field: emitted light
    /// for each field; empty unless networks are chosen by medium
    std::pmr::vector<MediumMoments> media_;
    FieldGlowPlan glow_;
    bool hasNetworks_ = false;
    FieldNearPlan near_;
    std::pmr::vector<uint32_t> stamps_; ///< for each tile: index + 1 of the last field that was listed
    /// Pairs of a tile and a field visible in the tile, in the order of fields.
    std::pmr::vector<uint32_t> seen_;
    std::pmr::vector<FieldTileBlock> tiles_;
    std::pmr::vector<uint32_t> tileFields_;
};

} // namespace fx::render
