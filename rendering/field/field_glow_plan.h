/// @file field_glow_plan.h
/// Grids in which light is propagated through fields. Fields that overlap each other share one grid. Without
/// illumination networks, a grid is created only if one of its fields emits light.
///
/// Grids are fixed in the world, so that their cells do not move with the eye.
#pragma once

#include "rendering/field/field_blocks.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Largest number of grids per view. If more grids are needed, the fields that emit least get no grid.
constexpr size_t kMaxGlowGrids = 4;

/// Builds the list of grids of a frame. The memory is kept from frame to frame. Threads: one at a time.
class FieldGlowPlan
{
public:
    explicit FieldGlowPlan(std::pmr::memory_resource* memory);

    /// Builds the grids. Sets FieldBlock::limits.w of each field to the index of the field's grid + 1, or to
    /// 0 if the field has no grid.
    /// @param emitted [exposed m2] for each field: the sum of cross section times emitted light of its balls
    /// @param eye [m] world position to which fields are relative
    /// @param networkCells number of cells along a side of the grid of an illumination network. If it is not
    ///     0, all fields get grids, the largest fields on the picture first. If it is 0, only fields that
    ///     emit light get grids, of kGlowCells cells
    void build(std::span<FieldBlock> ioFields, std::span<const float> emitted, const glm::dvec3& eye,
               int networkCells = 0);
    void clear() { grids_.clear(); }

    std::span<const FieldGlowBlock> grids() const { return grids_; }

private:
    /// Overlapping fields that share a grid.
    struct Source
    {
        glm::vec3 low, high; ///< [m] corners of the fields' common box, relative to the eye
        float emitted;       ///< [exposed m2] emitted light; with networks, the size on the picture [sr]
    };

    /// True if `a` is sorted before `b`. Sources are sorted by decreasing `emitted`, and for equal `emitted`
    /// by position.
    static bool brighter(const Source& a, const Source& b);
    void listSources(std::span<const FieldBlock> fields, std::span<const float> emitted, bool all);
    void placeGrid(const Source& source, std::span<FieldBlock> ioFields, const glm::dvec3& eye);

    int cells_; ///< number of cells along a side of a grid
    std::pmr::vector<Source> sources_;
    std::pmr::vector<FieldGlowBlock> grids_;
};

} // namespace fx::render
