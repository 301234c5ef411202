/// @file network_state.h
/// Light in the cells of a grid, kept from frame to frame.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace fx::render {

/// Cubes of one size, x fastest, then y, then z.
struct NetworkGrid
/// [m] lowest of the first cell
{
    glm::dvec3 corner{0.0};
    double side = 1.0;   ///< [m] of a cell
    glm::ivec3 cells{0}; ///< along each axis

    size_t count() const { return size_t(cells.x) * size_t(cells.y) * size_t(cells.z); }
    size_t index(const glm::ivec3& c) const
    {
        return size_t(c.x) + size_t(cells.x) * (size_t(c.y) + size_t(cells.y) * size_t(c.z));
    }
    glm::dvec3 middle(const glm::ivec3& c) const { return corner + side * (glm::dvec3(c) + 0.5); }
    bool operator==(const NetworkGrid&) const = default;
};

/// Moments of the light in a cell: sums over directions of weight, harmonic and mean radiance in the cell.
/// All that a network needs of the last frame. Threads: one at a time.
struct NetworkState
{
    NetworkGrid grid;
    int moments = 0;          ///< 4 or 9; 0: nothing is known
    std::vector<float> light; ///< [cd/m2 sr] of the first moment all cells, then the next
};

/// The same light in another grid, by linear interpolation; beyond the old grid it is that of its border.
/// Moments that the state lacks are 0.
NetworkState resampled(const NetworkState& state, const NetworkGrid& grid, int moments);

/// Value at a place by linear interpolation between the middles of cells. @param values one a cell
double interpolated(const float* values, const NetworkGrid& grid, const glm::dvec3& position);

} // namespace fx::render
