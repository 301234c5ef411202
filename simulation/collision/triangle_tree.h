/// @file triangle_tree.h
/// A bounding-box hierarchy of triangles for the distance to the nearest triangle.
#pragma once

#include "simulation/collision/mesh_surface.h"
#include "simulation/collision/point_triangle.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

/// Number of points per query. The cost per point is lower if the points are closer to each other.
constexpr uint32_t kPacketPoints = 8;

struct PointPacket
{
    alignas(64) double x[kPacketPoints]; ///< [m]
    alignas(64) double y[kPacketPoints];
    alignas(64) double z[kPacketPoints];
};

/// Nearest triangle of each point of a packet.
struct PacketNearest
{
    static constexpr uint32_t kMaxEqualTriangles = 8;

    alignas(64) double squared[kPacketPoints]; ///< [m2] distance
    /// for each point: position in the tree of one of the nearest triangles
    uint32_t triangle[kPacketPoints];
    /// For each point: number of other triangles at exactly the same distance.
    uint32_t equals[kPacketPoints];
    /// For each point: positions in the tree of up to kMaxEqualTriangles triangles counted in `equals`.
    uint32_t equal[kPacketPoints * kMaxEqualTriangles];
};

class TriangleTree
{
public:
    /// Builds the tree. Throws std::bad_alloc.
    TriangleTree(std::span<const Triangle> triangles, std::pmr::memory_resource* memory);

    bool empty() const { return nodes_.empty(); }
    struct Nearest
    {
        double distance;   ///< [m]
        uint32_t triangle; ///< position in the tree; kNone if no triangle is nearer than the limit
        Feature feature;
        glm::dvec3 point; ///< [m] nearest point of the triangle
    };
    static constexpr uint32_t kNone = ~0u;

    /// Finds the triangle nearest to `p`. If no triangle is nearer than `within` [m], returns the distance
    /// `within` and kNone. [any thread]
    Nearest nearest(const glm::dvec3& p, double within) const;

    /// Finds the nearest triangles of eight points without a limit of distance. The distances have the same
    /// bits as the results of nearest() for one point. The tree must not be empty. [any thread]
    /// @param guess position in the tree of a triangle near the points; a nearer triangle makes the search
    ///         faster
    void nearest(const PointPacket& points, uint32_t guess, PacketNearest& out) const;

    /// Result of nearest() for one triangle, given by its position in the tree.
    Nearest at(uint32_t place, const glm::dvec3& p) const;

    struct Box
    {
        glm::vec3 low, high; ///< [m]
    };
    struct Node : Box
    {
        uint32_t first; ///< leaf: position of the first triangle; inner node: index of the second child
        /// Leaf: number of triangles; inner node: 0. The first child of an inner node is the next node.
        uint32_t count;
    };
    static constexpr size_t kDeepest = 64; ///< maximum depth; the halving of 2^22 triangles gives 21 levels

private:
    uint32_t build(std::span<const Triangle> triangles, uint32_t begin, uint32_t end);
    static double squaredDistance(const Box& box, const glm::dvec3& p);

    std::pmr::vector<uint32_t> order_;     ///< index in the mesh of the triangle at each position in the tree
    std::pmr::vector<Triangle> triangles_; ///< in tree order
    std::pmr::vector<Box> boxes_;          ///< boxes of triangles, in tree order
    std::pmr::vector<Node> nodes_;
};

} // namespace fx::sim
