/// @file ball_tree.h
/// A bounding-volume hierarchy over balls, rebuilt every frame, for queries of all balls that a ray or a tile
/// of rays intersects.
///
/// Balls are sorted along a Hilbert curve. Eight balls form a leaf, and eight boxes form a node, up to one
/// root. The tree is packed [KF93]: child indices are implicit, so that no pointers are stored. Every level
/// is built in parallel. Balls of different size are in different parts of the order, because one large ball
/// among small balls would enlarge the box of the small balls. Building needs one sort and one pass over the
/// balls. The result has the same bits for any number of workers.
///
/// Threads: one thread at a time may call build(); any thread may call const functions.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/reference/trace/curve_order.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace fx::render {

/// A ball as input of BallTree::build().
struct TraceBall
{
    glm::dvec3 center; ///< [m] finite
    double radius;     ///< [m] > 0, finite
};

class BallTree
{
public:
    static constexpr uint32_t kWidth = 8; ///< number of balls in a leaf, and number of children of a node

    /// Eight balls. Unused elements have a large negative radius, so that no ray hits them.
    struct alignas(64) Leaf
    {
        double x[kWidth]; ///< [m] position relative to the tree's origin
        double y[kWidth];
        double z[kWidth];
        double radius[kWidth]; ///< [m]
    };

    /// Boxes of eight children. The boxes are slightly enlarged, so that rounding in float never causes a
    /// missed intersection.
    struct alignas(64) Node
    {
        float center[3][kWidth]; ///< [m] center relative to the tree's origin
        float extent[3][kWidth]; ///< [m] half of the box's side; a large negative value for missing children
    };

    /// Builds the tree.
    /// @param origin [m] origin of rays and results. It should be the eye, so that the picture does not
    ///         depend on the position of the scene in the world
    void build(std::span<const TraceBall> balls, const glm::dvec3& origin, base::TaskRunner& tasks);

    uint32_t count() const { return count_; }
    const glm::dvec3& origin() const { return origin_; }
    /// The index, in the list passed to build(), of the ball at a place. A place is an index in the order of
    /// the tree; place 8 i + k is element k of leaf i.
    uint32_t ballAt(uint32_t place) const { return order_[place].index; }
    std::span<const Leaf> leaves() const { return leaves_; }
    /// Number of levels; 0 without balls. The highest level has one node. Child k of node i is node 8 i + k
    /// one level lower. On level 0, the child is leaf 8 i + k.
    uint32_t levels() const { return uint32_t(levelBegin_.size()); }
    const Node& node(uint32_t level, uint32_t index) const { return nodes_[levelBegin_[level] + index]; }

private:
    void sortBalls(std::span<const TraceBall> balls, base::TaskRunner& tasks);
    void fillLeaves(std::span<const TraceBall> balls, base::TaskRunner& tasks);
    void fillLevels(base::TaskRunner& tasks);

    uint32_t count_ = 0;
    glm::dvec3 origin_{0.0};
    std::vector<Leaf> leaves_;
    std::vector<Node> nodes_;
    std::vector<uint32_t> levelBegin_;
    std::vector<KeyedIndex> order_;
    std::vector<KeyedIndex> scratch_;
};

/// A node that a traversal has to visit.
struct TreePosition
{
    uint32_t level, index;
};
/// Size of the stack of a traversal. Each level adds at most seven nodes, and 11 levels contain 2^36 balls.
constexpr size_t kTreeStack = 11 * BallTree::kWidth;

} // namespace fx::render
