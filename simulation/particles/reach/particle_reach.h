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

/// [m] Upper bound of distances, see SolverDef::reachFrom().
float reachOf(const EmitterSettings& def, const ReachConditions& conditions, const BirthReach& births,
              std::span<BirthReach> ioOthers);

/// Box that contains all drawn geometry of particles up to the age `seconds`, for all random numbers.
/// @param low, high [m/s2] range of accelerations, component by component
/// @param secondsBack [s] time since the previous snapshot; particles born since then are drawn at their
///                    extrapolated positions at that time
base::Bounds boundsOfAll(const EmitterSettings& def, const glm::vec3& low, const glm::vec3& high,
                         float seconds, float secondsBack);

/// Ranges of conditions, apart from modules, since the birth of the oldest particle.
struct ConditionsRange
{
    ReachConditions strongest; ///< strongest conditions, and the length of that time
    glm::vec3 low{0.0f};       ///< [m/s2] range of the pull of gravity and wind, see AppearanceJob
    glm::vec3 high{0.0f};
    float lowGround = 0.0f; ///< [m] range of the height of the ground plane, -infinity for none
    float highGround = 0.0f;
    float secondsBack = kLongestStep; ///< [s] see boundsOfAll()
    bool meetsGround = false;         ///< particles stay above the ground
    bool meetsOthers = false;         ///< contacts may deflect them in any direction
};

/// As boundsOfAll(), for particles that modules move; infinite when unknown.
base::Bounds boundsOfStepped(const EmitterSettings& def, const ConditionsRange& conditions);

} // namespace fx::sim
