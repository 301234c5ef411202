/// @file sphere_hierarchy.h
/// A bounding-volume hierarchy of hidden instances. A search for the instances that come into view visits
/// only a part of the tree.
#pragma once

#include "fxsdk/activation/focus.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::activation {

/// A balanced binary tree of bounding spheres. Insertion and removal take logarithmic time. A query visits
/// the nodes in sight and their siblings. Incremental insertion with rotations is common in the broad phase
/// of physics engines; see Ericson, Real-Time Collision Detection, section 6.2.
class SphereHierarchy
{
public:
    using Leaf = uint32_t;
    static constexpr Leaf kNone = ~0u;

    explicit SphereHierarchy(std::pmr::memory_resource* memory) : nodes_(memory), stack_(memory) {}

    /// Adds a leaf. Strong exception guarantee.
    /// @param sight [m] largest distance at which the ball is seen, may be infinite
    Leaf insert(uint32_t key, const Ball& ball, double sight);
    void remove(Leaf leaf); ///< allocates nothing
    uint32_t size() const { return leaves_; }

    /// Calls found(key) for each leaf in the view of `focus`. @return number of nodes visited
    template <class F>
    uint32_t query(const FocusSet& focus, F&& found)
    {
        uint32_t visited = 0;
        stack_.clear();
        if (root_ != kNone)
            stack_.push_back(root_);
        while (!stack_.empty()) {
            const Node& node = nodes_[stack_.back()];
            stack_.pop_back();
            ++visited;
            if (focus.judge(node.ball, node.sight, false) != Sight::Seen)
                continue;
            if (node.height == 0) {
                found(node.key);
                continue;
            }
            stack_.push_back(node.child[0]); // insert() has reserved enough memory
            stack_.push_back(node.child[1]);
        }
        return visited;
    }

private:
    struct Node
    {
        Ball ball;
        double sight = 0; ///< [m] largest `sight` of the leaves below
        uint32_t parent = kNone;
        uint32_t child[2] = {kNone, kNone};
        uint32_t height = 0; ///< height of the subtree; 0: a leaf
        uint32_t key = 0;
    };
    uint32_t take();
    void giveBack(uint32_t node);
    uint32_t siblingFor(const Ball& ball) const;
    void enclose(uint32_t node);
    uint32_t balance(uint32_t node);
    void rotate(uint32_t node, int heavy);
    void replaceChild(uint32_t parent, uint32_t was, uint32_t is);
    void refit(uint32_t node);

    std::pmr::vector<Node> nodes_;
    std::pmr::vector<uint32_t> stack_;
    uint32_t root_ = kNone;
    /// index of the first unused node; `parent` of an unused node is the index of the next unused node
    uint32_t free_ = kNone;
    uint32_t unused_ = 0;
    uint32_t leaves_ = 0;
};

} // namespace fx::activation
