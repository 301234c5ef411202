/// @file particle_reach.h
/// Bounds of the particles of an emitter from its definition and conditions.
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/solver/solver.h"

#include <glm/vec3.hpp>

#include <span>

namespace fx::sim {

/// [m] As SolverDef::reachFrom().
float reachOf(const EmitterSettings& def, const ReachConditions& conditions, const BirthReach& births,
              std::span<BirthReach> ioOthers);

/// Box that contains all drawn geometry of particles with lifetimes up to `seconds`, for all random numbers.
/// @param low, high [m/s2] range of accelerations, component by component
/// @param secondsBack [s] to the snapshot before, particles born since are drawn on their path from it
base::Bounds boundsOfAll(const EmitterSettings& def, const glm::vec3& low, const glm::vec3& high,
                         float seconds, float secondsBack);

/// Ranges of conditions, besides modules, since the birth of the oldest particle.
struct ConditionsRange
{
    ReachConditions strongest; ///< and how long that is
    glm::vec3 low{0.0f};       ///< [m/s2] between these were the pulls of gravity and wind, see AppearanceJob
    glm::vec3 high{0.0f};
    float lowGround = 0.0f; ///< [m] between these was the ground plane, -infinity for none
    float highGround = 0.0f;
    float secondsBack = kLongestStep; ///< [s] see boundsOfAll()
    bool meetsGround = false;         ///< particles do not fall below it
    bool meetsOthers = false;         ///< contacts may deflect them in any direction
};

/// As boundsOfAll() where modules move particles; infinite when unknown.
base::Bounds boundsOfStepped(const EmitterSettings& def, const ConditionsRange& conditions);

} // namespace fx::sim
