/// @file winding_rows.h
/// Finds the nodes of a grid that lie inside of closed surfaces.
#pragma once

#include "simulation/collision/distance_grid.h"
#include "simulation/collision/mesh_surface.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

class WindingRows
{
public:
    /// @param solids closed surfaces. Throws std::bad_alloc.
    WindingRows(std::span<const Triangle> solids, const DistanceGrid& grid,
                std::pmr::memory_resource* memory);

    /// True if the node at `x` [m] of the row (y, z) is inside of a closed surface. [any thread]
    bool isInside(double x, uint32_t y, uint32_t z) const;

private:
    struct Crossing
    {
        double x;     ///< [m]
        int32_t sign; ///< +1, -1
    };
    /// index of the first crossing of each row; the last element is the number of all crossings
    std::pmr::vector<size_t> first_;
    std::pmr::vector<Crossing> crossings_;
    uint32_t rowsInY_;
};

} // namespace fx::sim
