#include "rendering/media/blob_estimate.h"

#include "rendering/frame/ball_window.h"
#include "rendering/media/blob_gather.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

/// [pixel] of the window that a blob's rectangle covers along one axis; and before it was cut.
struct Extent
{
    float cut, whole;
};

Extent extentAlong(const CameraGeometry& camera, int axis, float c, float depth, float radius, float pixels)
{
    const auto [a, b] = clipRange(camera, axis, c, depth, radius);
    const float cut = std::clamp(b, -1.0f, 1.0f) - std::clamp(a, -1.0f, 1.0f);
    return {0.5f * pixels * cut, 0.5f * pixels * (b - a)};
}

/// Texels across, when each is `divisor` pixels wide: small blobs are widened, what the window cuts is not.
float texels(const Extent& extent, int divisor)
{
    const float least = 2.0f * kMinPixels * float(divisor);
    const float widening = std::max(least / std::max(extent.whole, 1e-6f), 1.0f);
    return std::min(extent.cut * widening, std::max(extent.cut, least)) / float(divisor);
}

} // namespace

FragmentCounts estimateFragments(std::span<const BlobInstance> blobs, const CameraGeometry& camera, int width,
                                 int height)
{
    std::array<double, 3> sums{};
    for (const BlobInstance& blob : blobs) {
        const glm::vec3 center(blob.centerRadius);
        const float depth = glm::dot(center, camera.forward);
        const float radius = blob.centerRadius.w;
        const Extent x = extentAlong(camera, 0, glm::dot(center, camera.right), depth, radius, float(width));
        const Extent y = extentAlong(camera, 1, glm::dot(center, camera.up), depth, radius, float(height));
        for (size_t i = 0; i < sums.size(); ++i)
            sums[i] += double(texels(x, kLayerDivisors[i])) * double(texels(y, kLayerDivisors[i]));
    }
    return {uint64_t(sums[0]), uint64_t(sums[1]), uint64_t(sums[2])};
}

ScreenShare screenShare(std::span<const BlobInstance> blobs, const CameraGeometry& camera)
{
    // the picture is a square of side 2 in clip space, where a ball is an ellipse
    const float perArea =
        std::numbers::pi_v<float> / 4.0f * std::abs(camera.clipScale.x * camera.clipScale.y);
    double media = 0.0;
    double hot = 0.0;
    for (const BlobInstance& blob : blobs) {
        const glm::vec3 center(blob.centerRadius);
        const float distance2 = camera.orthographic ? 1.0f : glm::dot(center, center);
        const float radius = blob.centerRadius.w;
        const float area = std::min(1.0f, perArea * radius * radius / std::max(distance2, radius * radius));
        media += double(area);
        if (blob.medium.y > 0.0f)
            hot += double(area);
    }
    return {-std::expm1(-media), -std::expm1(-hot)};
}

} // namespace fx::render
