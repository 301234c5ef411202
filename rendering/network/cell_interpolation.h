/// @file cell_interpolation.h
/// Linear interpolation of several values between the centers of the cells of a grid.
#pragma once

#include "rendering/network/network_state.h"

#include <algorithm>
#include <array>

namespace fx::render {

/// The cell of lower index and its neighbor along an axis, and the weight of the neighbor.
struct BetweenCells
{
    /// @param place [cell] from the lowest corner; outside of the grid, its border counts
    BetweenCells(double place, int cells)
    {
        const double at = std::clamp(place - 0.5, 0.0, double(cells - 1));
        first = std::min(int(at), std::max(cells - 2, 0));
        second = std::min(first + 1, cells - 1);
        share = at - first;
    }

    int first, second;
    double share; ///< [1] 0..1
};

/// Interpolates `Values` values in single precision.
/// @param values the values of the first cell, then those of the next one
template <size_t Values>
std::array<float, Values> interpolatedCells(const float* values, const NetworkGrid& grid,
                                            const glm::dvec3& position)
{
    const glm::dvec3 place = (position - grid.corner) / grid.side;
    const BetweenCells x(place.x, grid.cells.x), y(place.y, grid.cells.y), z(place.z, grid.cells.z);
    std::array<float, Values> sum{};
    const auto add = [&](int j, int k, double share) {
        const float* const row = values + Values * grid.index({0, j, k});
        const float* const a = row + Values * size_t(x.first);
        const float* const b = row + Values * size_t(x.second);
        const float second = float(share * x.share), first = float(share) - second;
        for (size_t v = 0; v < Values; ++v)
            sum[v] += first * a[v] + second * b[v];
    };
    add(y.first, z.first, (1.0 - y.share) * (1.0 - z.share));
    add(y.second, z.first, y.share * (1.0 - z.share));
    add(y.first, z.second, (1.0 - y.share) * z.share);
    add(y.second, z.second, y.share * z.share);
    return sum;
}

} // namespace fx::render
