/// @file packet_search.h
/// Finds the triangles nearest to eight points at once, with SIMD instructions.
#pragma once

#include "simulation/collision/triangle_tree.h"

#include <span>

namespace fx::sim {

/// Read access to the memory of a tree.
struct TreeView
{
    std::span<const TriangleTree::Node> nodes;
    std::span<const Triangle> triangles;      ///< in tree order
    std::span<const TriangleTree::Box> boxes; ///< boxes of triangles, in tree order
};

/// Implements TriangleTree::nearest() for eight points.
void searchPacket(const TreeView& tree, const PointPacket& points, uint32_t guess, PacketNearest& out);

} // namespace fx::sim
