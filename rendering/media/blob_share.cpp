#include "rendering/media/blob_share.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

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
