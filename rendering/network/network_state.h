/// @file network_state.h
/// State of an illumination network: the light in the cells of a grid, kept from frame to frame.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace fx::render {

/// A grid of equal cubes. In arrays of cells, x changes fastest, then y, then z.
struct NetworkGrid
{
    glm::dvec3 corner{0.0}; ///< [m] lowest corner of the first cell
    double side = 1.0;      ///< [m] side of a cell
    glm::ivec3 cells{0};    ///< number of cells along each axis

    size_t count() const { return size_t(cells.x) * size_t(cells.y) * size_t(cells.z); }
    size_t index(const glm::ivec3& c) const
    {
        return size_t(c.x) + size_t(cells.x) * (size_t(c.y) + size_t(cells.y) * size_t(c.z));
    }
    glm::dvec3 middle(const glm::ivec3& c) const { return corner + side * (glm::dvec3(c) + 0.5); }
    bool operator==(const NetworkGrid&) const = default;
};

/// Moments of the light in all cells: sums over directions of weight * harmonic * mean radiance in the cell.
/// A network needs no other data from the last frame. Threads: one at a time.
struct NetworkState
{
    NetworkGrid grid;
    int moments = 0; ///< number of moments, 4 or 9; 0: no light
    /// [cd/m2 sr] Values of the first moment in all cells, then the values of the second moment, and so on.
    std::vector<float> light;
};

/// Resamples the light to another grid, by linear interpolation. Outside of the old grid, the light at the
/// nearest point of its border is used. Moments that `state` does not have are set to 0.
NetworkState resampled(const NetworkState& state, const NetworkGrid& grid, int moments);

/// Returns the value at a point, interpolated linearly between the centers of cells.
/// @param values one value per cell
double interpolated(const float* values, const NetworkGrid& grid, const glm::dvec3& position);

} // namespace fx::render
