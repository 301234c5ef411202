/// @file contact_path.h
/// Computes the path of a particle in a step, with contacts with all obstacles.
///
/// @formula contact-path
/// Motion after each contact in a step.
///
/// symbol   unit   meaning
///   x0, x1   m      position at the begin of the step, and at its end without contacts
///   v1       m/s    velocity at its end without contacts
///   T        s      length of the step
///   n        1      normal of the obstacle, towards the particle
///   e, c     1      restitution, friction
///   l        m      lift, 2^-20 of the largest coordinate and at least 1e-6 m
/// @derivation
///   The path without contacts is taken as the parabola through x0 and x1 with v1 at its end:
///       v0 = 2 (x1 - x0) / T - v1,   a = (v1 - v0) / T                                      (1)
///   which is exact for a constant acceleration. At a contact after t
///       v = v0 + a t,   v' = v - (1 + e) (v.n) n - c (v - (v.n) n)                           (2)
///   and the motion continues for the rest T - t with v' and a, from l above the obstacle. After kMaxContacts
///   contacts, or if v.n is too small for another flight within the rest, the particle slides:
///       v' <- v' - min(v'.n, 0) n,   a <- a - min(a.n, 0) n                                  (3)
///   If the end is inside of matter in spite of that, it is set back to the beginning of the last leg  (4)
/// @source    elementary
/// @deviation contacts of curved paths are ordered along their chords, except those with planes
/// @valid     T > 0; finite numbers
/// @accuracy  a path that begins outside of matter ends outside; on a plane without friction, a drop from h
///            rises to e^2 h for any T
/// @tests     tests/simulation/particles/modules/test_contact_path.cpp
#pragma once

#include "simulation/particles/collisions/obstacles.h"
#include "simulation/particles/tile.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace fx::sim {

/// An obstacle and its response.
struct ObstacleEntry
{
    std::unique_ptr<Obstacle> obstacle;
    ContactResponse response;
    float restitution;
    float friction;
};

/// State of a particle at the end of a step.
struct ContactState
{
    glm::vec3 position; ///< [m]
    glm::vec3 velocity; ///< [m/s]
    bool isHit = false;
    bool isKilled = false;
    bool isStuck = false;
    /// [1] Time before the first contact divided by the length of the step. For a particle that dies, the
    /// time before the contact that kills it.
    float contact = 1.0f;
};

constexpr int kMaxContacts = 8;      ///< maximum number of contacts of one particle in one step
constexpr size_t kMaxObstacles = 16; ///< maximum number of obstacles of one emitter

/// Contacts that begin in a step, selected by rule (2) of event-ticks.
struct ContactList
{
    std::array<TileContact, kMaxContacts + 1> contacts;
    uint32_t count = 0;
};

/// Follows the path of a particle through a step and responds to its contacts.
/// @param state state at the end of the step without contacts
/// @param seconds [s] length of the step, > 0
/// @param list receives the contacts; null: no contacts are collected
ContactState followPath(std::span<const ObstacleEntry> obstacles, const StepContext& step,
                        const glm::vec3& from, const ContactState& state, float seconds,
                        ContactList* list = nullptr);

} // namespace fx::sim
