#include "simulation/collision/winding_rows.h"

#include "simulation/collision/row_crossings.h"

namespace fx::sim {

WindingRows::WindingRows(std::span<const Triangle> solids, const DistanceGrid& grid,
                         std::pmr::memory_resource* memory)
    : first_(size_t(grid.nodes.y) * grid.nodes.z + 1, memory), crossings_(memory), rowsInY_(grid.nodes.y)
{
    for (const Triangle& triangle : solids)
        forEachCrossing(triangle, grid, 0,
                        [&](uint32_t y, uint32_t z, double, int) { ++first_[y + size_t(rowsInY_) * z]; });
    size_t sum = 0;
    for (size_t& count : first_)
        count = sum += count; // the end of each row; filling from there leads back to its beginning
    crossings_.resize(sum);
    for (const Triangle& triangle : solids)
        forEachCrossing(triangle, grid, 0, [&](uint32_t y, uint32_t z, double x, int sign) {
            crossings_[--first_[y + size_t(rowsInY_) * z]] = {x, sign};
        });
}

bool WindingRows::isInside(double x, uint32_t y, uint32_t z) const
{
    const size_t row = y + size_t(rowsInY_) * z;
    int32_t w = 0;
    for (size_t k = first_[row]; k < first_[row + 1]; ++k)
        if (crossings_[k].x > x)
            w += crossings_[k].sign; // (1)
    return w > 0;                    // (4)
}

} // namespace fx::sim
