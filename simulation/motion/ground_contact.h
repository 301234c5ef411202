/// @file ground_contact.h
/// Collision of particles with the ground plane.
///
/// @formula ground-bounce
/// Reflects the part of a step's path that lies below the ground.
///
/// symbol   unit   meaning
///   y0, y1  m      height before and after the free step
///   yg      m      height of the ground
///   f       1      part of the step before contact
///   e       1      restitution, 0..1
///   c       1      friction: tangential velocity lost, 0..1
/// @derivation
///   The path is taken as straight, so the contact is after f = (y0 - yg) / (y0 - y1)             (1)
///   The velocity at the contact v* = v0 + f (v1 - v0) is reflected to v' = (v*x (1-c), -e v*y, v*z (1-c))
///   (2) The rest of the step has the mean acceleration (v1 - v0) / t of the free step:
///       v = v' + (1 - f)(v1 - v0),  x = x* + (1 - f) t v' + (1 - f)^2 t (v1 - v0) / 2           (3)
///   A particle that would be below the ground again is put to rest on it                         (4)
/// @source    elementary
/// @deviation after the first bounce in a step, a particle that falls again is put to rest
/// @valid     yg = -infinity: no contact; a particle that starts below the ground is put onto it
/// @accuracy  never below the ground; no step gains height from a resting state
/// @tests     tests/simulation/test_emitter_motion.cpp
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>

namespace fx::sim {

/// Position and velocity of one particle.
struct MotionState
{
    glm::vec3 position; ///< [m]
    glm::vec3 velocity; ///< [m/s]
};

/// Collision with the ground.
struct GroundContact
{
    float height;      ///< [m] height of the ground; -infinity: no ground
    float restitution; ///< [1] 0..1
    float friction;    ///< [1] 0..1
};

/// State after a step that begins with `before`. `after` is the state after a free flight of `seconds` [s].
inline MotionState bounce(const MotionState& before, const MotionState& after, float seconds,
                          const GroundContact& ground)
{
    if (after.position.y >= ground.height)
        return after;
    const float drop = before.position.y - after.position.y;
    const float f =
        drop > 0.0f ? std::clamp((before.position.y - ground.height) / drop, 0.0f, 1.0f) : 0.0f; // (1)
    const float rest = 1.0f - f;
    const glm::vec3 change = after.velocity - before.velocity;
    const float grip = 1.0f - ground.friction;

    MotionState state;
    state.velocity = before.velocity + f * change; // (2)
    state.velocity.x *= grip;
    state.velocity.z *= grip;
    state.velocity.y = std::max(-ground.restitution * state.velocity.y, 0.0f);
    state.position = before.position + f * (after.position - before.position);
    state.position += rest * seconds * state.velocity + 0.5f * rest * rest * seconds * change; // (3)
    state.velocity += rest * change;
    if (state.position.y <= ground.height) { // (4)
        state.position.y = ground.height;
        state.velocity.y = 0.0f;
    }
    return state;
}

} // namespace fx::sim
