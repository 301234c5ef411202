#include "simulation/collision/triangle_tree.h"

#include "simulation/collision/packet_search.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace fx::sim {

namespace {
constexpr uint32_t kLeaf = 4; ///< triangles
} // namespace

TriangleTree::TriangleTree(std::span<const Triangle> triangles, std::pmr::memory_resource* memory)
    : order_(triangles.size(), memory), triangles_(memory), boxes_(memory), nodes_(memory)
{
    if (triangles.empty())
        return;
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(triangles.size());
    build(triangles, 0, uint32_t(triangles.size()));
    triangles_.reserve(triangles.size());
    boxes_.reserve(triangles.size());
    for (const uint32_t number : order_) {
        const auto& [a, b, c] = triangles_.emplace_back(triangles[number]);
        boxes_.push_back({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
    }
}

/// Halves the triangles at the median of their centers along the longest side. @return the node's place
uint32_t TriangleTree::build(std::span<const Triangle> triangles, uint32_t begin, uint32_t end)
{
    const uint32_t index = uint32_t(nodes_.size());
    glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
    for (uint32_t i = begin; i < end; ++i)
        for (const glm::vec3& corner : triangles[order_[i]]) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    nodes_.push_back({{low, high}, begin, end - begin});
    if (end - begin <= kLeaf)
        return index;
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const auto center = [&](uint32_t i) {
        const Triangle& t = triangles[i];
        return std::pair(double(t[0][axis]) + double(t[1][axis]) + double(t[2][axis]), i);
    };
    const uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](uint32_t a, uint32_t b) { return center(a) < center(b); });
    build(triangles, begin, middle);
    const uint32_t second = build(triangles, middle, end);
    nodes_[index].first = second;
    nodes_[index].count = 0;
    return index;
}

double TriangleTree::squaredDistance(const Box& box, const glm::dvec3& p)
{
    const glm::dvec3 outside =
        glm::max(glm::max(glm::dvec3(box.low) - p, p - glm::dvec3(box.high)), glm::dvec3(0.0));
    return glm::dot(outside, outside);
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& p, double within) const
{
    Nearest found{within, kNone, Feature::Inside, p};
    if (nodes_.empty())
        return found;
    double squared = within * within;
    std::array<uint32_t, kDeepest> stack;
    size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t index = stack[--depth];
        const Node& node = nodes_[index];
        if (squaredDistance(node, p) >= squared)
            continue;
        if (node.count == 0) {
            uint32_t near = index + 1, far = node.first;
            if (squaredDistance(nodes_[far], p) < squaredDistance(nodes_[near], p))
                std::swap(near, far);
            stack[depth++] = far;
            stack[depth++] = near;
            continue;
        }
        for (uint32_t i = 0; i < node.count; ++i) {
            const Triangle& t = triangles_[node.first + i];
            const NearestPoint here =
                nearestOnTriangle(p, glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2]));
            const double d2 = glm::dot(here.point - p, here.point - p);
            if (d2 < squared) {
                squared = d2;
                found = {std::sqrt(d2), order_[node.first + i], here.feature, here.point};
            }
        }
    }
    return found;
}

TriangleTree::Nearest TriangleTree::at(uint32_t place, const glm::dvec3& p) const
{
    const Triangle& t = triangles_[place];
    const NearestPoint here = nearestOnTriangle(p, glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2]));
    return {std::sqrt(glm::dot(here.point - p, here.point - p)), order_[place], here.feature, here.point};
}

void TriangleTree::nearest(const PointPacket& points, uint32_t guess, PacketNearest& out) const
{
    searchPacket({nodes_, triangles_, boxes_}, points, guess, out);
}

} // namespace fx::sim
