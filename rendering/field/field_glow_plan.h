/// @file field_glow_plan.h
/// Grids in which light is spread over fields: one for all fields that overlap each other, of which one emits
/// or all are carried by an illumination network.
///
/// A grid is fixed in the world as lattices of fields are, so that cells do not swim.
#pragma once

#include "rendering/field/field_blocks.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

constexpr size_t kMaxGlowGrids = 4; ///< of a view; fields that emit least have none

/// Keeps its memory from frame to frame. Threads: one at a time.
class FieldGlowPlan
{
public:
    explicit FieldGlowPlan(std::pmr::memory_resource* memory);

    /// Writes the number of its grid + 1 into FieldBlock::limits.w of each field, 0 for fields without a
    /// grid.
    /// @param emitted [exposed m2] of each field: cross section times light of its balls
    /// @param eye [m] world position that fields are relative to
    /// @param networkCells along a side of a grid, for all fields, the largest on the picture first; 0: grids
    /// of kGlowCells for fields that emit
    void build(std::span<FieldBlock> ioFields, std::span<const float> emitted, const glm::dvec3& eye,
               int networkCells = 0);
    void clear() { grids_.clear(); }

    std::span<const FieldGlowBlock> grids() const { return grids_; }

private:
    /// Fields that emit and overlap.
    struct Source
    {
        glm::vec3 low, high; ///< [m] relative to the eye
        float emitted;       ///< [exposed m2]; of a network: its size on the picture [sr]
    };

    static bool brighter(const Source& a, const Source& b); ///< or, of the same, in any fixed order
    void listSources(std::span<const FieldBlock> fields, std::span<const float> emitted, bool all);
    void placeGrid(const Source& source, std::span<FieldBlock> ioFields, const glm::dvec3& eye);

    int cells_; ///< along a side of a grid
    std::pmr::vector<Source> sources_;
    std::pmr::vector<FieldGlowBlock> grids_;
};

} // namespace fx::render
