/// @file distance_grid.h
/// Grid of the nodes of a distance field.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/result/status.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::sim {

constexpr size_t kMaxFieldNodes = size_t(1) << 24; ///< maximum number of nodes; each node takes 4 bytes
/// maximum number of nodes for an automatic cell size
constexpr size_t kAutomaticFieldNodes = size_t(1) << 22;
constexpr float kFieldMargin = 4.0f; ///< [cell] minimum margin around the mesh

/// Grid of cubic cells around a mesh.
struct DistanceGrid
{
    glm::vec3 low{0.0f};   ///< [m] position of the first node, relative to the mesh's origin
    float cell = 1.0f;     ///< [m] edge of a cell
    glm::uvec3 nodes{0u};  ///< number of nodes along each axis
    base::Bounds bounds{}; ///< bounds of the mesh

    size_t count() const { return size_t(nodes.x) * nodes.y * nodes.z; }
    size_t index(uint32_t x, uint32_t y, uint32_t z) const
    {
        return x + size_t(nodes.x) * (y + size_t(nodes.y) * z);
    }
    glm::dvec3 place(uint32_t x, uint32_t y, uint32_t z) const
    {
        return glm::dvec3(low) + double(cell) * glm::dvec3(x, y, z);
    }
};

/// Plans the grid of a mesh with the given bounds.
/// @param cell [m] edge of a cell; 0: the smallest edge that needs at most kAutomaticFieldNodes, but at least
///          a thousandth of the size of the mesh
/// @return Capacity if more than kMaxFieldNodes are needed
base::Result<DistanceGrid> planGrid(const base::Bounds& bounds, float cell);

} // namespace fx::sim
