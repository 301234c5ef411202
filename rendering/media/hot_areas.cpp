#include "rendering/media/hot_areas.h"

#include "rendering/frame/ball_window.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

/// A GPU rounds places of corners and rays in its own way.
constexpr float kSparePixels = 1.0f;
constexpr float kSpareRadius = 1e-3f; ///< [1]

/// Tiles from `first` up to, not including, `last`.
struct Range
{
    uint32_t first, last;
};

/// Tiles between two clip coordinates; none when all of it is outside of the window.
Range tilesBetween(float low, float high, uint32_t pixels, uint32_t tiles)
{
    const float size = float(pixels);
    const float from = (0.5f * low + 0.5f) * size - kSparePixels;
    const float to = (0.5f * high + 0.5f) * size + kSparePixels;
    if (from >= size || to <= 0.0f)
        return {0, 0};
    const uint32_t first = from > 0.0f ? uint32_t(from) / kHotTile : 0;
    const uint32_t last = to < size ? uint32_t(to) / kHotTile + 1 : tiles;
    return {first, std::min(last, tiles)};
}

} // namespace

void HotAreas::find(std::span<const BlobInstance> blobs, const CameraView& view, int width, int height)
{
    width_ = uint32_t(width);
    height_ = uint32_t(height);
    columns_ = (width_ + kHotTile - 1) / kHotTile;
    rows_ = (height_ + kHotTile - 1) / kHotTile;
    counts_.assign(size_t(columns_ + 1) * (rows_ + 1), 0);
    const CameraGeometry camera = cameraGeometry(view);
    for (const BlobInstance& blob : blobs)
        if (blob.medium.y > 0.0f)
            count(camera, blob, view.upperLeftOrigin);
    collect();
}

/// Notes the tiles of one blob at the corners of their rectangle.
void HotAreas::count(const CameraGeometry& camera, const BlobInstance& blob, bool isFlipped)
{
    const glm::vec3 center(blob.centerRadius);
    const float radius = blob.centerRadius.w * (1.0f + kSpareRadius);
    const float depth = glm::dot(center, camera.forward);
    if (!camera.orthographic && depth < -radius)
        return; // behind the eye
    const auto [left, right] = clipRange(camera, 0, glm::dot(center, camera.right), depth, radius);
    const auto [low, high] = clipRange(camera, 1, glm::dot(center, camera.up), depth, radius);
    const Range x = tilesBetween(left, right, width_, columns_);
    const Range y =
        isFlipped ? tilesBetween(-high, -low, height_, rows_) : tilesBetween(low, high, height_, rows_);
    const auto at = [this](uint32_t column, uint32_t row) -> int32_t& {
        return counts_[column + size_t(columns_ + 1) * row];
    };
    ++at(x.first, y.first);
    --at(x.last, y.first);
    --at(x.first, y.last);
    ++at(x.last, y.last);
}

/// Sums up what begins and ends, and turns each row's tiles into areas.
void HotAreas::collect()
{
    areas_.clear();
    for (uint32_t row = 0; row < rows_; ++row) {
        int32_t* const here = &counts_[size_t(columns_ + 1) * row];
        const int32_t* const below = row > 0 ? here - (columns_ + 1) : nullptr;
        int32_t sum = 0; // of this row alone
        bool wasHot = false;
        for (uint32_t column = 0; column < columns_; ++column) {
            sum += here[column];
            here[column] = sum + (below ? below[column] : 0); // blobs on this tile
            const bool isHot = here[column] > 0;
            if (isHot && !wasHot)
                areas_.push_back(
                    {column * kHotTile, row * kHotTile, 0, std::min((row + 1) * kHotTile, height_)});
            if (isHot)
                areas_.back().right = std::min((column + 1) * kHotTile, width_);
            wasHot = isHot;
        }
    }
}

} // namespace fx::render
