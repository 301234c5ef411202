#include "foundation/snapshot/particle_bounds.h"

#include "foundation/math/bits.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace fx::base {

namespace {

constexpr float kRounding = 1.0f + 1e-5f; ///< of the float arithmetic that draws

/// Adds a ball unless something of it is not finite.
void addBall(Bounds& bounds, const glm::vec3& center, float reach)
{
    const float values[] = {center.x, center.y, center.z, reach};
    if (allFinite(values, 4))
        bounds.add(center,
                   reach * kRounding +
                       kRounding * 1e-6f * (std::abs(center.x) + std::abs(center.y) + std::abs(center.z)));
}

} // namespace

Bounds particleBounds(const SnapshotGroup& group, float meshReach, float secondsBack)
{
    namespace column = particle_column;
    const auto constants = group.constants();
    const bool isMesh = constants[particle_constant::Shape] == float(ParticleShape::Mesh);
    const bool isStretched = constants[particle_constant::Alignment] == float(SpriteAlignment::Velocity);
    const float aspect = constants[particle_constant::Aspect];
    const float stretch = isStretched && !isMesh ? 0.5f * constants[particle_constant::Stretch] : 0.0f;
    const bool moves = group.has(column::VelocityX);
    const auto x = group.column(column::PositionX);
    const auto y = group.column(column::PositionY);
    const auto z = group.column(column::PositionZ);
    const auto radius = group.column(column::Radius);
    const auto age = group.column(column::Age);
    Bounds bounds;
    for (size_t i = 0; i < group.count(); ++i) {
        if (!(radius[i] > 0.0f))
            continue;
        const glm::vec3 velocity =
            moves ? glm::vec3(group.column(column::VelocityX)[i], group.column(column::VelocityY)[i],
                              group.column(column::VelocityZ)[i])
                  : glm::vec3(0.0f);
        const float high = radius[i] + stretch * glm::length(velocity);
        const float wide = radius[i] * aspect;
        const float reach = isMesh ? radius[i] * meshReach : std::sqrt(high * high + wide * wide);
        const glm::vec3 center(x[i], y[i], z[i]);
        addBall(bounds, center, reach);
        if (moves && age[i] <= secondsBack)
            addBall(bounds, center - velocity * secondsBack, reach);
    }
    return bounds;
}

Bounds ribbonBounds(const SnapshotGroup& group)
{
    namespace column = ribbon_column;
    Bounds bounds;
    for (size_t i = 0; i < group.count(); ++i)
        addBall(bounds,
                {group.column(column::PositionX)[i], group.column(column::PositionY)[i],
                 group.column(column::PositionZ)[i]},
                group.column(column::HalfWidth)[i]);
    return bounds;
}

} // namespace fx::base
