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

/// Points of one query. The closer they are to each other, the cheaper is each.
constexpr uint32_t kPacketPoints = 8;

struct PointPacket
{
    alignas(64) double x[kPacketPoints]; ///< [m]
    alignas(64) double y[kPacketPoints];
    alignas(64) double z[kPacketPoints];
};

/// Nearest triangles of each point of a packet.
struct PacketNearest
{
    static constexpr uint32_t kMaxEqualTriangles = 8;

    alignas(64) double squared[kPacketPoints]; ///< [m2] distance
    uint32_t triangle[kPacketPoints];          ///< place in the tree of one that is as near
    /// Number of other triangles at exactly the same distance.
    uint32_t equals[kPacketPoints];
    uint32_t equal[kPacketPoints * kMaxEqualTriangles]; ///< positions of the first of them, by point
};

class TriangleTree
{
public:
    /// Throws std::bad_alloc.
    TriangleTree(std::span<const Triangle> triangles, std::pmr::memory_resource* memory);

    bool empty() const { return nodes_.empty(); }
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

    /// The same distances, bit for bit, of eight points, without a limit. Not of a tree without triangles.
    /// Any thread.
    /// @param guess place in the tree of a triangle that may be near: the better it is, the faster
    void nearest(const PointPacket& points, uint32_t guess, PacketNearest& out) const;

    /// Result of nearest() for a given triangle, by position in the tree.
    Nearest at(uint32_t place, const glm::dvec3& p) const;

    struct Box
    {
        glm::vec3 low, high; ///< [m]
    };
    struct Node : Box
    {
        uint32_t first; ///< position of its triangles when `count` > 0, otherwise its second child
        uint32_t count; ///< triangles of a leaf; 0: children are the next node and `first`
    };
    static constexpr size_t kDeepest = 64; ///< levels; halving 2^22 triangles takes 21

private:
    uint32_t build(std::span<const Triangle> triangles, uint32_t begin, uint32_t end);
    static double squaredDistance(const Box& box, const glm::dvec3& p);

    std::pmr::vector<uint32_t> order_;     ///< number of the triangle at each place
    std::pmr::vector<Triangle> triangles_; ///< by place
    std::pmr::vector<Box> boxes_;          ///< of triangles, by place
    std::pmr::vector<Node> nodes_;
};

} // namespace fx::sim
