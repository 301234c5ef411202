#include "simulation/emitters/births/birth_shape.h"

#include "foundation/math/elementary.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr float kPi = 3.14159265f;

/// A direction within the angle of +Y whose cosine is `cosLimit`.
glm::vec3 coneDirection(float u1, float u2, float cosLimit)
{
    const float cosine = 1.0f - u1 * (1.0f - cosLimit); // (1)
    const float sine = std::sqrt(std::max((1.0f - cosine) * (1.0f + cosine), 0.0f));
    const base::SinCos azimuth = base::sinCosTurns(double(u2));
    return {sine * float(azimuth.cos), cosine, sine * float(azimuth.sin)};
}

} // namespace

BirthPlace sampleBirth(const EmitterSettings& def, const std::array<float, 4>& place,
                       const std::array<float, 4>& heading)
{
    switch (def.shape) {
    case EmitterShape::Point:
        return {def.position, coneDirection(heading[0], heading[1], -1.0f)};
    case EmitterShape::Sphere: {
        const glm::vec3 outward = coneDirection(place[0], place[1], -1.0f);
        const float radius = def.size.x * float(base::cubeRoot(double(place[2]))); // (2)
        return {def.position + radius * outward, outward};
    }
    case EmitterShape::Box: {
        const glm::vec3 unit(2.0f * place[0] - 1.0f, 2.0f * place[1] - 1.0f, 2.0f * place[2] - 1.0f);
        return {def.position + def.size * unit, {0.0f, 1.0f, 0.0f}};
    }
    case EmitterShape::Cone:
        break;
    }
    const base::SinCos azimuth = base::sinCosTurns(double(place[0]));
    const float radius = def.size.x * std::sqrt(place[1]); // (2)
    const glm::vec3 onDisc(radius * float(azimuth.cos), 0.0f, radius * float(azimuth.sin));
    const float angle = std::clamp(def.angle, 0.0f, kPi);
    const float cosLimit = float(base::sinCosTurns(double(angle) / 6.283185307179586).cos);
    return {def.position + onDisc, coneDirection(heading[0], heading[1], cosLimit)};
}

} // namespace fx::sim
