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

/// [m] Upper bound of the distances of particles from the origin, see SolverDef::reachFrom().
float reachOf(const EmitterSettings& def, const ReachConditions& conditions, const BirthReach& births,
              std::span<BirthReach> ioOthers);

/// Box that contains all drawn parts of particles up to the age `seconds`, for all random numbers.
/// @param low, high [m/s2] range of accelerations, component by component
/// @param secondsBack [s] time since the previous snapshot; newer particles are also drawn at the time of the
///         previous snapshot, at extrapolated positions
base::Bounds boundsOfAll(const EmitterSettings& def, const glm::vec3& low, const glm::vec3& high,
                         float seconds, float secondsBack);

/// Ranges of conditions since the birth of the oldest particle, without the conditions of modules.
struct ConditionsRange
{
    ReachConditions strongest; ///< strongest conditions, and the duration that they cover
    glm::vec3 low{0.0f}; ///< [m/s2] range of the acceleration by gravity and wind, see AppearanceJob::pull
    glm::vec3 high{0.0f};
    float lowGround = 0.0f; ///< [m] range of the height of the ground plane, -infinity: no ground
    float highGround = 0.0f;
    float secondsBack = kLongestStep; ///< [s] see boundsOfAll()
    bool meetsGround = false;         ///< true: the ground stops particles
    bool meetsOthers = false;         ///< true: contacts may deflect particles in any direction
};

/// Computes boundsOfAll() for particles whose motion is changed by modules; infinite if no bound is known.
base::Bounds boundsOfStepped(const EmitterSettings& def, const ConditionsRange& conditions);

} // namespace fx::sim
