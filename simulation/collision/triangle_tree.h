/// @file triangle_tree.h
/// A tree of boxes around triangles that finds the distance to the nearest one.
#pragma once

#include "simulation/collision/mesh_surface.h"
#include "simulation/collision/point_triangle.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

class TriangleTree
{
public:
    /// @param triangles outlive the tree. Throws std::bad_alloc.
    TriangleTree(std::span<const Triangle> triangles, std::pmr::memory_resource* memory);

    bool empty() const { return triangles_.empty(); }
    struct Nearest
    {
        double distance;   ///< [m]
        uint32_t triangle; ///< kNone when none is near
        Feature feature;
        glm::dvec3 point; ///< [m] of the triangle
    };
    static constexpr uint32_t kNone = ~0u;

    /// The triangle nearest to `p`; `within` [m] and kNone when none is nearer than that. Any thread.
    Nearest nearest(const glm::dvec3& p, double within) const;

private:
    struct Node
    {
        glm::vec3 low, high; ///< [m]
        uint32_t first;      ///< of its triangles in order_ when `count` > 0, else its second child
        uint32_t count;      ///< triangles of a leaf; 0: children are the next node and `first`
    };
    uint32_t build(uint32_t begin, uint32_t end);
    static double squaredDistance(const Node& node, const glm::dvec3& p);

    std::span<const Triangle> triangles_;
    std::pmr::vector<uint32_t> order_;
    std::pmr::vector<Node> nodes_;
};

} // namespace fx::sim
