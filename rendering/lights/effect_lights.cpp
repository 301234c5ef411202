#include "rendering/lights/effect_lights.h"

#include "foundation/math/bits.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "rendering/optics/black_body.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

namespace column = base::blob_column;

constexpr float kDarkest = 1e-3f;     // [cd] a group below this is no light
constexpr float kLeastExtent = 0.05f; // [m] of particles, which have no size as lights

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

namespace {

/// Sums over the lights that particles shed.
Glow sumLights(const base::SnapshotGroup& g)
{
    namespace light = base::light_column;
    Glow glow;
    for (size_t i = 0; i < g.count(); ++i) {
        const glm::vec3 position(g.column(light::PositionX)[i], g.column(light::PositionY)[i],
                                 g.column(light::PositionZ)[i]);
        const glm::vec3 intensity(g.column(light::IntensityR)[i], g.column(light::IntensityG)[i],
                                  g.column(light::IntensityB)[i]);
        const double weight = double(intensity.x + intensity.y + intensity.z);
        if (!base::isFinite(weight) || !base::isFinite(glm::dot(position, position)))
            continue;
        glow.intensity += intensity;
        glow.moment += weight * glm::dvec3(position);
        glow.weight += weight;
        glow.spread += weight * double(glm::dot(position, position));
    }
    return glow;
}

/// What glows already as a medium is not counted again.
bool isShownAsMedium(const base::FrameSnapshot& snapshot, base::KindId blobs, const base::GroupInfo& info)
{
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        if (snapshot.name(g) == base::GroupName{info.instance, info.solver, blobs})
            return true;
    }
    return false;
}

/// Puts a light where its brightness belongs, if there is room for it.
void insert(const EffectLight& light, std::span<EffectLight> out, size_t& ioCount)
{
    const auto brightness = [](const EffectLight& l) {
        return l.intensity.x + l.intensity.y + l.intensity.z;
    };
    size_t at = ioCount;
    while (at > 0 && brightness(out[at - 1]) < brightness(light))
        --at;
    if (at == out.size())
        return;
    ioCount = std::min(ioCount + 1, out.size());
    for (size_t i = ioCount - 1; i > at; --i)
        out[i] = out[i - 1];
    out[at] = light;
}

} // namespace

size_t effectLights(const base::FrameSnapshot& snapshot, std::span<EffectLight> out)
{
    size_t count = 0;
    const base::KindId blobs = snapshot.schema().find(base::kBlobKind.name);
    const base::KindId lights = snapshot.schema().find(base::kLightKind.name);
    for (size_t g = 0; g < snapshot.groupCount() && !out.empty(); ++g) {
        const base::KindId kind = snapshot.name(g).kind;
        const bool isLights = kind == lights && lights != base::kNoKind;
        if ((kind != blobs && !isLights) || snapshot.group(g).count() == 0)
            continue;
        const base::SnapshotGroup& group = snapshot.group(g);
        const Glow glow = isLights ? sumLights(group) : sumGroup(group);
        if (!(glow.weight > double(kDarkest)) || (isLights && isShownAsMedium(snapshot, blobs, group.info())))
            continue;
        const base::Placement& placement = group.info().placement;
        const glm::dvec3 center = glow.moment / glow.weight;
        const float least = isLights ? kLeastExtent * kLeastExtent : 1e-6f;
        const float extent =
            float(std::sqrt(std::max(glow.spread / glow.weight - glm::dot(center, center), double(least))));
        const float face = std::numbers::pi_v<float> * extent * extent;
        const float screen = // neighbors hide each other
            isLights ? 1.0f : escape(float(glow.crossSection) / face);
        const float scale = placement.scale;
        EffectLight light;
        light.position = placement.position + glm::dvec3(placement.rotation * (glm::vec3(center) * scale));
        light.intensity = glow.intensity * (screen * scale * scale);
        light.radius = extent * scale;
        insert(light, out, count);
    }
    return count;
}

} // namespace fx::render
