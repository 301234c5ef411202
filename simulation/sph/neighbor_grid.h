/// @file neighbor_grid.h
/// Finds what is near: particles sorted into cells by counting, in an order that depends on nothing but
/// positions.
#pragma once

#include "foundation/memory/column.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

/// Positions of particles, one span an axis [m].
struct PositionSpans
{
    std::span<const float> x;
    std::span<const float> y;
    std::span<const float> z;
};

/// A uniform grid over the bounding box. Rebuilt whole; its memory is fixed by the capacity.
class NeighborGrid
{
public:
    NeighborGrid(std::pmr::memory_resource* memory, uint32_t capacity);

    /// Sorts the particles. Positions are finite.
    /// @param reach [m] > 0: forEachRun finds everything within this distance. Cells grow beyond it when the
    /// box would
    ///        need more of them than there is memory for.
    void build(const PositionSpans& positions, float reach);

    /// Particle numbers by cell; within a cell ascending.
    std::span<const uint32_t> order() const { return order_.first(count_); }

    /// Calls f(begin, end) for at most nine runs of places in order() that together hold every particle
    /// within `reach` of `position`, each particle once.
    template <class F>
    void forEachRun(const glm::vec3& position, F&& f) const
    {
        const int cx = cellAlong(0, position.x);
        const int cy = cellAlong(1, position.y);
        const int cz = cellAlong(2, position.z);
        const int x0 = cx > 0 ? cx - 1 : 0;
        const int x1 = cx + 1 < size_[0] ? cx + 1 : cx;
        for (int z = cz > 0 ? cz - 1 : 0; z <= cz + 1 && z < size_[2]; ++z)
            for (int y = cy > 0 ? cy - 1 : 0; y <= cy + 1 && y < size_[1]; ++y) {
                const int row = (z * size_[1] + y) * size_[0];
                f(start_[size_t(row + x0)], start_[size_t(row + x1 + 1)]);
            }
    }

private:
    int cellAlong(int axis, float coordinate) const
    {
        const int cell = int((coordinate - origin_[axis]) * perCell_);
        return cell < 0 ? 0 : (cell < size_[axis] ? cell : size_[axis] - 1);
    }
    void chooseCells(const PositionSpans& positions, float reach);

    uint32_t count_ = 0;
    float origin_[3] = {};
    float perCell_ = 1;
    int size_[3] = {1, 1, 1};
    uint32_t mostCells_;
    base::Column<uint32_t> cell_;  ///< of each particle
    base::Column<uint32_t> start_; ///< first place of each cell in order_, and one past the last
    base::Column<uint32_t> order_;
};

} // namespace fx::sim
