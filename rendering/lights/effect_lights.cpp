#include "rendering/lights/effect_lights.h"

#include "foundation/snapshot/block_kind.h"

#include "foundation/math/bits.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

constexpr float kDarkest = 1e-3f; // [cd] a group below this is no light

/// Where a light is from.
struct Origin
{
    const LightSource* source;
    size_t group;
};

/// Puts a light where its brightness belongs, if there is room for it.
void insert(const EffectLight& light, const Origin& origin, std::span<EffectLight> out,
            std::span<Origin> origins, size_t& ioCount)
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
    for (size_t i = ioCount - 1; i > at; --i) {
        out[i] = out[i - 1];
        origins[i] = origins[i - 1];
    }
    out[at] = light;
    origins[at] = origin;
}

} // namespace

bool GroupGlow::add(const glm::vec3& position, const glm::vec3& intensity, float radius)
{
    const double weight = double(intensity.x + intensity.y + intensity.z);
    if (!base::isFinite(weight) || !base::isFinite(glm::dot(position, position)))
        return false;
    intensity_ += intensity;
    moment_ += weight * glm::dvec3(position);
    weight_ += weight;
    spread_ += weight * double(glm::dot(position, position) + radius * radius);
    return true;
}

bool GroupGlow::isDark() const
{
    return !(weight_ > double(kDarkest));
}

float GroupGlow::extent(float leastSquare) const
{
    const glm::dvec3 center = moment_ / weight_;
    return float(std::sqrt(std::max(spread_ / weight_ - glm::dot(center, center), double(leastSquare))));
}

EffectLight GroupGlow::light(const base::Placement& placement, float extent, float visible) const
{
    const glm::dvec3 center = moment_ / weight_;
    const float scale = placement.scale;
    EffectLight light;
    light.position = placement.position + glm::dvec3(placement.rotation * (glm::vec3(center) * scale));
    light.intensity = intensity_ * (visible * scale * scale);
    light.radius = extent * scale;
    return light;
}

namespace {

constexpr float kColdest = 400.0f; ///< [K] up to which blackBodyLuminance() is 0

/// True if the balls of blocks do not glow, so that their rows need not be computed.
bool isDark(const base::FrameSnapshot& snapshot, size_t index)
{
    namespace blob = base::blob_column;
    const base::SnapshotGroup& late = snapshot.unread(index);
    if (!late.info().isLate)
        return false;
    const base::KindId kind = snapshot.schema().find(base::kBlockBallKind.name);
    for (size_t g = index; g-- > 0 && !snapshot.pooled(g);) {
        const base::SnapshotGroup& balls = snapshot.unread(g);
        if (balls.info().instance != late.info().instance || balls.info().solver != late.info().solver)
            break;
        if (balls.info().kind != kind)
            continue;
        const auto isAbove = [](float least) { return [=](float value) { return value > least; }; };
        for (const size_t column : {blob::EmissionR, blob::EmissionG, blob::EmissionB})
            if (std::ranges::any_of(balls.column(column), isAbove(0.0f)))
                return false;
        if (std::ranges::any_of(balls.column(blob::Temperature), isAbove(kColdest)))
            return false;
    }
    return true;
}

} // namespace

size_t effectLights(const base::FrameSnapshot& snapshot, std::span<const LightSource* const> sources,
                    std::span<EffectLight> out)
{
    sources = sources.first(std::min(sources.size(), kMaxLightSources));
    std::array<base::KindId, kMaxLightSources> kinds{};
    for (size_t s = 0; s < sources.size(); ++s)
        kinds[s] = snapshot.schema().find(sources[s]->kind->name);
    std::array<Origin, kMaxEffectLights> origins{};
    out = out.first(std::min(out.size(), kMaxEffectLights));
    size_t count = 0;
    for (size_t g = 0; g < snapshot.groupCount() && !out.empty(); ++g) {
        const auto kind = std::find(kinds.begin(), kinds.begin() + sources.size(), snapshot.name(g).kind);
        if (kind == kinds.begin() + sources.size() || (!snapshot.pooled(g) && isDark(snapshot, g)) ||
            snapshot.group(g).count() == 0)
            continue;
        EffectLight light;
        const LightSource* source = sources[size_t(kind - kinds.begin())];
        if (source->lightOf(snapshot, snapshot.group(g), light))
            insert(light, {source, g}, out, origins, count);
    }
    for (size_t i = 0; i < count; ++i)
        if (origins[i].source->complete)
            origins[i].source->complete(snapshot, origins[i].group, out[i]);
    return count;
}

} // namespace fx::render
