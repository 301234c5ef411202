#include "rendering/techniques/blobs/blob_parts.h"

#include "foundation/snapshot/blob_kind.h"
#include "rendering/optics/black_body.h"

#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

namespace column = base::blob_column;

constexpr float kMinSquare = 1e-6f; // [m2] of the extent

/// (1 - exp(-t)) / t, 1 at t = 0.
float escape(float t)
{
    return t < 1e-4f ? 1.0f - 0.5f * t : -std::expm1(-t) / t;
}

glm::vec3 sourceOf(const base::SnapshotGroup& g, size_t i)
{
    const auto c = [&](size_t index) { return g.column(index)[i]; };
    const glm::vec3 albedo(c(column::AlbedoR), c(column::AlbedoG), c(column::AlbedoB));
    const glm::vec3 own(c(column::EmissionR), c(column::EmissionG), c(column::EmissionB));
    return (1.0f - albedo) * blackBodyLuminance(c(column::Temperature)) + own;
}

bool lightOf(const base::FrameSnapshot&, const base::SnapshotGroup& g, EffectLight& outLight)
{
    GroupGlow glow;
    double allCrossSections = 0.0;
    for (size_t i = 0; i < g.count(); ++i) {
        const float radius = g.column(column::Radius)[i];
        const float crossSection = g.column(column::CrossSection)[i];
        const glm::vec3 position(g.column(column::PositionX)[i], g.column(column::PositionY)[i],
                                 g.column(column::PositionZ)[i]);
        const float t = 3.5f * crossSection / (std::numbers::pi_v<float> * radius * radius);
        const glm::vec3 intensity = sourceOf(g, i) * (crossSection * escape(t));
        if (glow.add(position, intensity, radius))
            allCrossSections += double(crossSection);
    }
    if (glow.isDark())
        return false;
    const float extent = glow.extent(kMinSquare);
    const float face = std::numbers::pi_v<float> * extent * extent;
    outLight = glow.light(g.info().placement, extent,
                          escape(float(allCrossSections) / face)); // neighbors hide each other
    outLight.isOfMedium = true;
    return true;
}

} // namespace

constexpr LightSource kBlobLights{&base::kBlobKind, lightOf};

} // namespace fx::render
