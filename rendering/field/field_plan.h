/// @file field_plan.h
/// Layout of the voxels in which the balls of each effect are summed: lattices, their occupied bricks, the
/// balls of each brick, and the rectangle of each field in the window.
///
/// Lattices are fixed in the world, so that voxels do not move with the effect or the eye. The sides of
/// voxels are powers of 2^(1/4) m. A brick exists if a ball touches it and it may be visible. A sample sums
/// the balls of its brick in the order of the list of balls, so that equal inputs give equal bits.
#pragma once

#include "rendering/field/field_blocks.h"
#include "rendering/field/field_glow_plan.h"
#include "rendering/field/field_near_plan.h"
#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

struct FieldPlanInputs
{
    std::span<const BlobInstance> balls; ///< the balls that may be visible
    std::span<const BlobEffect> effects; ///< effects of all balls, in the order of the balls
    const CameraGeometry* camera;
    int width, height;   ///< [pixel] size of the picture
    int resolution = 96; ///< number of voxels along 16 radii of an effect's balls, 16..256
    /// Largest number of bricks of all fields together; 0: as many as a full cube with `resolution` voxels
    /// along a side has.
    uint32_t mostBricks = 0;
    bool glows = true; ///< true: emitted light is propagated in grids, see FieldPlan::glows()
    /// Number of cells along a side of each grid of an illumination network, for all fields; 0: no networks.
    int networkCells = 0;
};

/// Builds the layout of a frame. The memory is kept from frame to frame. Threads: one at a time.
class FieldPlan
{
public:
    explicit FieldPlan(std::pmr::memory_resource* memory);

    void build(const FieldPlanInputs& in);
    void clear();

    std::span<const FieldBlock> fields() const { return fields_; }
    std::span<const FieldBrickBlock> bricks() const { return bricks_; }
    /// One entry for each possible brick in the box of each field, x fastest: the index of the brick + 1, or
    /// 0 if there is no brick.
    std::span<const uint32_t> table() const { return table_; }
    std::span<const uint32_t> balls() const { return balls_; } ///< indices of the balls of all bricks
    /// One entry for each part of the window, beginning at clip position -1, -1, x fastest; empty without
    /// bricks.
    std::span<const FieldTileBlock> tiles() const { return tiles_; }
    /// Indices of the fields of all tiles.
    std::span<const uint32_t> tileFields() const { return tileFields_; }
    /// Indices of the balls that are too small for the voxels of their effect, in ascending order. They are
    /// in no brick.
    std::span<const uint32_t> loose() const { return loose_; }
    /// Balls near the eye. FieldNearPass subtracts their shares from the bricks.
    const FieldNearPlan& near() const { return near_; }
    /// Grids in which light is propagated. FieldBlock::limits.w gives the grid of each field.
    std::span<const FieldGlowBlock> glows() const { return glow_.grids(); }
    bool isEmpty() const { return bricks_.empty(); }

    /// [m] Least radius of a ball in a field. A smaller ball would fall between samples: its radius is
    /// increased to this, with the same cross section.
    static float leastRadius(float voxel) { return 2.0f * voxel; }

private:
    struct Lattice
    {
        float voxel = 0.0f;   ///< [m]
        glm::vec3 low{0.0f};  ///< [m] lower corner of the visible balls, relative to the eye
        glm::vec3 high{0.0f}; ///< [m] upper corner
        uint32_t field = 0;   ///< index among the fields with balls

        bool hasBalls() const { return low.x <= high.x; }
    };

    void chooseVoxels(const FieldPlanInputs& in);
    static void bound(Lattice& lattice, const FieldPlanInputs& in, const BlobEffect& effect);
    void enlargeVoxels(const FieldPlanInputs& in, bool smoothOnly);
    bool place(const FieldPlanInputs& in); ///< returns false if there are too many bricks
    bool placeField(Lattice& lattice, int detail, const CameraGeometry& camera);
    static bool isLoose(const BlobInstance& ball, const BlobEffect& effect, float voxel);
    uint32_t countBalls(const FieldPlanInputs& in);
    void listBalls(const FieldPlanInputs& in);
    void listNear(const FieldPlanInputs& in);
    void listBall(const FieldBlock& field, const BlobInstance& ball, uint32_t number);
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
    std::pmr::vector<float> peaks_;   ///< [1/m] by brick: sum of the central extinctions of its balls
    std::pmr::vector<float> emitted_; ///< [exposed m2] by field: emitted light
    FieldGlowPlan glow_;
    FieldNearPlan near_;
    std::pmr::vector<uint32_t> stamps_; ///< by tile: index of the last field that marked it + 1
    /// Pairs of a tile and a field that is visible in it, in the order of fields.
    std::pmr::vector<uint32_t> seen_;
    std::pmr::vector<FieldTileBlock> tiles_;
    std::pmr::vector<uint32_t> tileFields_;
};

} // namespace fx::render
