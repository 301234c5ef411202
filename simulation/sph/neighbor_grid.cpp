#include "simulation/sph/neighbor_grid.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

NeighborGrid::NeighborGrid(std::pmr::memory_resource* memory, uint32_t capacity)
    : mostCells_(4 * capacity + 64), cell_(memory, capacity), start_(memory, mostCells_ + 1),
      order_(memory, capacity)
{}

void NeighborGrid::chooseCells(const PositionSpans& positions, float reach)
{
    const std::span<const float> axes[3] = {positions.x, positions.y, positions.z};
    double extent[3];
    for (int a = 0; a < 3; ++a) {
        const auto [low, high] = std::minmax_element(axes[a].begin(), axes[a].end());
        origin_[a] = *low;
        extent[a] = double(*high) - double(*low);
    }
    // Slightly larger than the reach, so that rounding in cellAlong never hides a neighbor two cells away.
    double cell = double(reach) * 1.0001;
    const auto cellsNeeded = [&] {
        double cells = 1;
        for (const double e : extent)
            cells *= std::floor(e / cell) + 1.0;
        return cells;
    };
    while (cellsNeeded() > double(mostCells_))
        cell *= 1.26; // about twice the volume
    perCell_ = float(1.0 / cell);
    for (int a = 0; a < 3; ++a)
        size_[a] = int(extent[a] / cell) + 1;
}

void NeighborGrid::build(const PositionSpans& positions, float reach)
{
    count_ = uint32_t(positions.x.size());
    if (count_ == 0)
        return;
    chooseCells(positions, reach);

    const uint32_t cells = uint32_t(size_[0]) * uint32_t(size_[1]) * uint32_t(size_[2]);
    std::fill_n(start_.data(), cells + 1, 0u);
    for (uint32_t i = 0; i < count_; ++i) {
        const int x = cellAlong(0, positions.x[i]);
        const int y = cellAlong(1, positions.y[i]);
        const int z = cellAlong(2, positions.z[i]);
        cell_[i] = uint32_t((z * size_[1] + y) * size_[0] + x);
        ++start_[cell_[i] + 1];
    }
    for (uint32_t c = 0; c < cells; ++c)
        start_[c + 1] += start_[c];
    for (uint32_t i = 0; i < count_; ++i)
        order_[start_[cell_[i]]++] = i;
    for (uint32_t c = cells; c > 0; --c) // each start has moved to its cell's end
        start_[c] = start_[c - 1];
    start_[0] = 0;
}

} // namespace fx::sim
