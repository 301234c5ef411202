/// @file packet_search.h
/// The triangles nearest to eight points at once, in the vectors of each instruction set.
#pragma once

#include "simulation/collision/triangle_tree.h"

#include <span>

namespace fx::sim {

/// A tree as it lies in memory.
struct TreeView
{
    std::span<const TriangleTree::Node> nodes;
    std::span<const Triangle> triangles;      ///< by place
    std::span<const TriangleTree::Box> boxes; ///< of triangles, by place
};

/// See TriangleTree::nearest().
void searchPacket(const TreeView& tree, const PointPacket& points, uint32_t guess, PacketNearest& out);

} // namespace fx::sim
