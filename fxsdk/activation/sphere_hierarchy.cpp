#include "fxsdk/activation/sphere_hierarchy.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fx::activation {

namespace {

/// The smallest ball around two.
Ball around(const Ball& a, const Ball& b)
{
    const glm::dvec3 way = b.center - a.center;
    const double distance = glm::length(way);
    if (distance + b.radius <= a.radius)
        return a;
    if (distance + a.radius <= b.radius)
        return b;
    const double radius = 0.5 * (distance + a.radius + b.radius);
    return {a.center + way * ((radius - a.radius) / distance), radius * (1.0 + 1e-12)};
}

} // namespace

uint32_t SphereHierarchy::take()
{
    const uint32_t node = free_;
    free_ = nodes_[node].parent;
    nodes_[node] = Node{};
    --unused_;
    return node;
}

void SphereHierarchy::giveBack(uint32_t node)
{
    nodes_[node].parent = free_;
    free_ = node;
    ++unused_;
}

SphereHierarchy::Leaf SphereHierarchy::insert(uint32_t key, const Ball& ball, double sight)
{
    nodes_.reserve(nodes_.size() + 2 <= nodes_.capacity() ? 0 : 2 * nodes_.size() + 2);
    stack_.reserve(nodes_.capacity());
    while (unused_ < 2) { // a leaf and its parent; nothing can fail any more
        nodes_.push_back({});
        giveBack(uint32_t(nodes_.size() - 1));
    }
    const uint32_t leaf = take();
    nodes_[leaf].ball = ball;
    nodes_[leaf].sight = sight;
    nodes_[leaf].key = key;
    ++leaves_;
    if (root_ == kNone) {
        root_ = leaf;
        return leaf;
    }
    const uint32_t sibling = siblingFor(ball);
    const uint32_t joint = take();
    const uint32_t parent = nodes_[sibling].parent;
    nodes_[joint].parent = parent;
    nodes_[joint].child[0] = sibling;
    nodes_[joint].child[1] = leaf;
    replaceChild(parent, sibling, joint);
    nodes_[sibling].parent = nodes_[leaf].parent = joint;
    refit(joint);
    return leaf;
}

void SphereHierarchy::remove(Leaf leaf)
{
    const uint32_t joint = nodes_[leaf].parent;
    if (joint == kNone) {
        root_ = kNone;
    } else {
        const Node& node = nodes_[joint];
        const uint32_t sibling = node.child[0] == leaf ? node.child[1] : node.child[0];
        const uint32_t parent = node.parent;
        replaceChild(parent, joint, sibling);
        nodes_[sibling].parent = parent;
        giveBack(joint);
        refit(parent);
    }
    giveBack(leaf);
    --leaves_;
}

/// The node beside which a ball makes the balls on the way down grow least.
uint32_t SphereHierarchy::siblingFor(const Ball& ball) const
{
    uint32_t at = root_;
    while (nodes_[at].height > 0) {
        const Node& node = nodes_[at];
        const double here = around(node.ball, ball).radius;
        double growth[2];
        for (int i = 0; i < 2; ++i) {
            const Node& child = nodes_[node.child[i]];
            growth[i] = around(child.ball, ball).radius - (child.height > 0 ? child.ball.radius : 0.0);
        }
        if (here < std::min(growth[0], growth[1]))
            break; // beside this node, not below it
        at = node.child[growth[1] < growth[0] ? 1 : 0];
    }
    return at;
}

void SphereHierarchy::replaceChild(uint32_t parent, uint32_t was, uint32_t is)
{
    if (parent == kNone)
        root_ = is;
    else
        nodes_[parent].child[nodes_[parent].child[0] == was ? 0 : 1] = is;
}

void SphereHierarchy::enclose(uint32_t at)
{
    Node& node = nodes_[at];
    const Node& a = nodes_[node.child[0]];
    const Node& b = nodes_[node.child[1]];
    node.ball = around(a.ball, b.ball);
    node.sight = std::max(a.sight, b.sight);
    node.height = 1 + std::max(a.height, b.height);
}

/// Balances and encloses from `node` up to the root.
void SphereHierarchy::refit(uint32_t node)
{
    while (node != kNone) {
        node = balance(node);
        enclose(node);
        node = nodes_[node].parent;
    }
}

/// @return the node that stands where `at` stood
uint32_t SphereHierarchy::balance(uint32_t at)
{
    const uint32_t h0 = nodes_[nodes_[at].child[0]].height;
    const uint32_t h1 = nodes_[nodes_[at].child[1]].height;
    if (h0 <= h1 + 1 && h1 <= h0 + 1)
        return at;
    const int heavy = h1 > h0 ? 1 : 0;
    rotate(at, heavy);
    return nodes_[at].parent;
}

/// The heavy child rises above `at`, which takes over the lower of its children.
void SphereHierarchy::rotate(uint32_t at, int heavy)
{
    const uint32_t rising = nodes_[at].child[heavy];
    const uint32_t parent = nodes_[at].parent;
    const int lower = nodes_[nodes_[rising].child[0]].height < nodes_[nodes_[rising].child[1]].height ? 0 : 1;
    const uint32_t given = nodes_[rising].child[lower];
    replaceChild(parent, at, rising);
    nodes_[rising].parent = parent;
    nodes_[rising].child[lower] = at;
    nodes_[at].parent = rising;
    nodes_[at].child[heavy] = given;
    nodes_[given].parent = at;
    enclose(at);
}

} // namespace fx::activation
