/// @file contact_leg.h
/// A particle's way through a part of a step, as obstacles see it.
#pragma once

#include <glm/vec3.hpp>

namespace fx::sim {

/// From `from` to `to` in `seconds`, along the parabola that begins with `velocity`.
struct ContactLeg
{
    glm::vec3 from, to;     ///< [m]
    glm::vec3 velocity;     ///< [m/s] at `from`
    glm::vec3 acceleration; ///< [m/s2]
    float seconds;          ///< > 0

    glm::vec3 at(float time) const { return from + time * (velocity + 0.5f * time * acceleration); }
};

/// Where a leg first meets an obstacle.
struct LegContact
{
    bool found = false;
    float share = 1.0f;     ///< [1] of the leg's seconds
    glm::vec3 place{0.0f};  ///< [m]
    glm::vec3 normal{0.0f}; ///< unit, towards where particles may be
};

/// Distance of a point to the nearest obstacle.
struct Clearance
{
    float distance;   ///< [m] negative inside of matter
    glm::vec3 normal; ///< unit, towards where particles may be, or 0
};

} // namespace fx::sim
