/// @file contact_path.h
/// A particle's way through a step, around all obstacles.
///
/// @formula contact-path
/// Motion in the rest of a step after each contact.
///
/// symbol   unit   meaning
///   x0, x1   m      where the step began, and where it would end freely
///   v1       m/s    velocity at its free end
///   T        s      length of the step
///   n        1      normal of the obstacle, towards the particle
///   e, c     1      restitution, friction
///   l        m      lift, 2^-20 of the largest coordinate and at least 1e-6 m
/// @derivation
///   The way is taken as the parabola through x0 and x1 with v1 at its end:
///       v0 = 2 (x1 - x0) / T - v1,   a = (v1 - v0) / T                                      (1)
///   which free flight under a constant acceleration is. At a contact after t
///       v = v0 + a t,   v' = v - (1 + e) (v.n) n - c (v - (v.n) n)                           (2)
///   and the rest T - t goes on from there with v' and a, l above the obstacle. After kMaxContacts of them,
///   or where v.n is too small to leave again within the rest, the particle slides:
///       v' <- v' - min(v'.n, 0) n,   a <- a - min(a.n, 0) n                                  (3)
///   What ends inside of matter in spite of all that goes back to the beginning of its last leg   (4)
/// @source    elementary
/// @deviation the order of contacts of a way that bends is that along its chords, but for planes
/// @valid     T > 0; finite numbers
/// @accuracy  a way that begins outside of matter ends outside; on a plane without friction, a drop from h
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

/// A particle at the end of a step.
struct ContactState
{
    glm::vec3 position; ///< [m]
    glm::vec3 velocity; ///< [m/s]
    bool isHit = false;
    bool isKilled = false;
    bool isStuck = false;
    float contact = 1.0f; ///< [1] of the step, of the first contact, or of the one that kills
};

constexpr int kMaxContacts = 8;      ///< of one particle in one step
constexpr size_t kMaxObstacles = 16; ///< of one emitter

/// Contacts that begin in a step, selected by (2) of event-ticks.
struct ContactList
{
    std::array<TileContact, kMaxContacts + 1> contacts;
    uint32_t count = 0;
};

/// @param state free end of the step
/// @param seconds length of the step, > 0
/// @param list receives the contacts; null: none are collected
ContactState followPath(std::span<const ObstacleEntry> obstacles, const StepContext& step,
                        const glm::vec3& from, const ContactState& state, float seconds,
                        ContactList* list = nullptr);

} // namespace fx::sim
