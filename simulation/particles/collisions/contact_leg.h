/// @file contact_leg.h
/// A part of a particle's path in a step, which is tested against obstacles.
#pragma once

#include <glm/vec3.hpp>

namespace fx::sim {

/// The path from `from` to `to` in `seconds`: a parabola that begins with `velocity`.
struct ContactLeg
{
    glm::vec3 from, to;     ///< [m]
    glm::vec3 velocity;     ///< [m/s] at `from`
    glm::vec3 acceleration; ///< [m/s2]
    float seconds;          ///< > 0

    glm::vec3 at(float time) const { return from + time * (velocity + 0.5f * time * acceleration); }
};

/// First contact of a leg with an obstacle.
struct LegContact
{
    bool found = false;
    float share = 1.0f;     ///< [1] time before the contact divided by the duration of the leg
    glm::vec3 place{0.0f};  ///< [m]
    glm::vec3 normal{0.0f}; ///< unit vector towards the side on which particles may be
};

/// Distance of a point to the nearest obstacle.
struct Clearance
{
    float distance;   ///< [m] negative inside of matter
    glm::vec3 normal; ///< unit vector towards the side on which particles may be, or 0
};

} // namespace fx::sim
