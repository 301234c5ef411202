#include "rendering/compositions/slabs/slab_tiles.h"

#include "rendering/frame/ball_window.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr float kMargin = 0.01f; ///< [texel] for rounding

/// Texels between which a ball lies along one axis of the window, as shaders/shared/blob_quad.glsl says.
std::pair<float, float> windowRange(const ViewBlock& view, int axis, const glm::vec3& center, float radius)
{
    const glm::vec4& side = axis == 0 ? view.right : view.up;
    const float size = axis == 0 ? view.rayDirectionX.w : view.rayDirectionY.w;
    const float flip = axis == 0 ? 1.0f : view.rayOriginY.w;
    const float c = glm::dot(center, glm::vec3(side));
    const float depth = glm::dot(center, glm::vec3(view.forward));
    const bool isParallel = view.rayOrigin.w > 0.5f;
    const auto [low, high] = isParallel ? std::pair(c - radius, c + radius) : tangentSlopes(c, depth, radius);
    const auto texel = [&](float slope) {
        const float clip = slope * side.w + view.clipOffset[axis];
        return std::clamp(0.5f + 0.5f * flip * clip, -1.0f, 2.0f) * size;
    };
    const float a = texel(low), b = texel(high);
    return {std::min(a, b) - kMargin, std::max(a, b) + kMargin};
}

uint32_t rankOf(const BlobInstance& ball)
{
    return uint32_t(ball.layer.y * 0x1.0p24f) << 8;
}

} // namespace

uint64_t findTiles(std::span<const BlobInstance> balls, const ViewBlock& view,
                   std::pmr::vector<TileRect>& outRects)
{
    const bool isParallel = view.rayOrigin.w > 0.5f;
    const int tiles[2] = {(int(view.rayDirectionX.w) + kSlabTile - 1) / kSlabTile,
                          (int(view.rayDirectionY.w) + kSlabTile - 1) / kSlabTile};
    uint64_t all = 0;
    outRects.clear();
    for (const BlobInstance& ball : balls) {
        const glm::vec3 center(ball.centerRadius);
        const float least = view.pass.x * (isParallel ? 1.0f : glm::length(center));
        const float radius = std::max(ball.centerRadius.w, least);
        int first[2], last[2];
        for (int axis = 0; axis < 2; ++axis) {
            const auto [low, high] = windowRange(view, axis, center, radius);
            first[axis] = std::max(int(std::floor(low / kSlabTile)), 0);
            last[axis] = std::min(int(std::floor(high / kSlabTile)), tiles[axis] - 1);
        }
        if (first[0] > last[0] || first[1] > last[1]) {
            outRects.push_back({1, 0, 1, 0, 0});
            continue;
        }
        outRects.push_back(
            {uint16_t(first[0]), uint16_t(last[0]), uint16_t(first[1]), uint16_t(last[1]), rankOf(ball)});
        all += uint64_t(last[0] - first[0] + 1) * uint64_t(last[1] - first[1] + 1);
    }
    return all;
}

} // namespace fx::render
