#include "rendering/particle_rows/particle_estimate.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

namespace {

constexpr size_t kStride = 61; ///< rows from one that is looked at to the next

} // namespace

FragmentCounts estimateRows(const base::SnapshotGroup& group, const RowTechnique& technique,
                            const base::Placement& place, const CameraGeometry& camera, int width, int height)
{
    const double window = double(width) * double(height);
    const double pixelsPerSlope = 0.5 * double(height) * std::abs(double(camera.clipScale.y));
    std::array<double, kLayerDivisors.size()> sums{};
    const size_t rows = technique.instances(group);
    for (size_t i = 0; i < rows; i += kStride) {
        const RowCard card = technique.card(group, i);
        const glm::vec3 center = glm::vec3(place.position) + place.rotation * (card.center * place.scale);
        const float depth = camera.orthographic ? 1.0f : glm::dot(center, camera.forward);
        if (!(card.area > 0.0f) || !(depth > 0.0f))
            continue;
        const double perMetre = pixelsPerSlope * double(place.scale) /
                                double(camera.orthographic ? 1.0f : std::max(depth, camera.nearDistance));
        const double pixels = double(card.area) * perMetre * perMetre;
        for (size_t k = 0; k < sums.size() && std::isfinite(pixels); ++k) {
            const double perTexel = double(kLayerDivisors[k]) * double(kLayerDivisors[k]);
            sums[k] += std::max(std::min(pixels, window) / perTexel, 1.0); // none is smaller than a texel
        }
    }
    const size_t looked = (rows + kStride - 1) / kStride;
    FragmentCounts counts{};
    for (size_t k = 0; k < sums.size(); ++k)
        counts[k] = looked > 0 ? uint64_t(sums[k] * double(rows) / double(looked)) : 0;
    return counts;
}

} // namespace fx::render
