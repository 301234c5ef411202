#include "rendering/lights/effect_lights.h"

#include "foundation/math/bits.h"
#include "foundation/snapshot/blob_kind.h"
#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

namespace column = base::blob_column;

constexpr float kDarkest = 1e-3f; // [cd] a group below this is no light

/// (1 - exp(-t)) / t, 1 at t = 0.
float escape(float t)
{
    return t < 1e-4f ? 1.0f - 0.5f * t : -std::expm1(-t) / t;
}

/// Sums over one group.
struct Glow
{
    glm::vec3 intensity{0.0f};
    glm::dvec3 moment{0.0}; ///< luminous weight times position
    double weight = 0.0;
    double spread = 0.0; ///< weight times squared extent
    double crossSection = 0.0;
    base::Bounds bounds;
};

glm::vec3 sourceOf(const base::SnapshotGroup& g, size_t i)
{
    const auto c = [&](size_t index) { return g.column(index)[i]; };
    const glm::vec3 albedo(c(column::AlbedoR), c(column::AlbedoG), c(column::AlbedoB));
    const glm::vec3 own(c(column::EmissionR), c(column::EmissionG), c(column::EmissionB));
    return (1.0f - albedo) * blackBodyLuminance(c(column::Temperature)) + own;
}

Glow sumGroup(const base::SnapshotGroup& g)
{
    Glow glow;
    for (size_t i = 0; i < g.count(); ++i) {
        const float radius = g.column(column::Radius)[i];
        const float crossSection = g.column(column::CrossSection)[i];
        const glm::vec3 position(g.column(column::PositionX)[i], g.column(column::PositionY)[i],
                                 g.column(column::PositionZ)[i]);
        const float t = 3.5f * crossSection / (std::numbers::pi_v<float> * radius * radius);
        const glm::vec3 intensity = sourceOf(g, i) * (crossSection * escape(t));
        const double weight = double(intensity.x + intensity.y + intensity.z);
        if (!base::isFinite(weight) || !base::isFinite(glm::dot(position, position)))
            continue; // not drawn either
        glow.intensity += intensity;
        glow.moment += weight * glm::dvec3(position);
        glow.weight += weight;
        glow.spread += weight * double(glm::dot(position, position) + radius * radius);
        glow.crossSection += double(crossSection);
        glow.bounds.add(position, radius);
    }
    return glow;
}

} // namespace

Incidence BallLight::at(const glm::vec3& position) const
{
    const glm::vec3 toLight = center_ - position;
    const float d2 = glm::dot(toLight, toLight);
    const float distance = std::sqrt(d2);
    Incidence incidence;
    incidence.direction = distance > 0.0f ? toLight / distance : glm::vec3(0.0f, 1.0f, 0.0f);
    incidence.illuminance = intensity_ / (d2 + radius_ * radius_);
    incidence.distance = distance;
    return incidence;
}

size_t effectLights(const base::FrameSnapshot& snapshot, std::span<EffectLight> out)
{
    size_t count = 0;
    const base::KindId blobs = snapshot.schema().find(base::kBlobKind.name);
    for (size_t g = 0; g < snapshot.groupCount() && !out.empty(); ++g) {
        const base::SnapshotGroup& group = snapshot.group(g);
        if (group.info().kind != blobs || group.count() == 0)
            continue;
        const Glow glow = sumGroup(group);
        if (!(glow.weight > double(kDarkest)))
            continue;
        const base::Placement& placement = group.info().placement;
        const glm::dvec3 center = glow.moment / glow.weight;
        const float extent =
            float(std::sqrt(std::max(glow.spread / glow.weight - glm::dot(center, center), 1e-6)));
        const float face = std::numbers::pi_v<float> * extent * extent;
        const float screen = escape(float(glow.crossSection) / face); // neighbors hide each other
        const float scale = placement.scale;
        EffectLight light;
        light.position = placement.position + glm::dvec3(placement.rotation * (glm::vec3(center) * scale));
        light.intensity = glow.intensity * (screen * scale * scale);
        light.radius = extent * scale;

        const auto brightness = [](const EffectLight& l) {
            return l.intensity.x + l.intensity.y + l.intensity.z;
        };
        size_t at = count;
        while (at > 0 && brightness(out[at - 1]) < brightness(light))
            --at;
        if (at == out.size())
            continue;
        count = std::min(count + 1, out.size());
        for (size_t i = count - 1; i > at; --i)
            out[i] = out[i - 1];
        out[at] = light;
    }
    return count;
}

} // namespace fx::render
