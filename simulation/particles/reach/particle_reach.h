/// @file particle_reach.h
/// How far the particles of an emitter can get, without a look at any of them.
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

/// What is drawn within lives of at most `seconds` stays in this box, whatever is drawn at random.
/// @param low, high   [m/s2] between these are the pulls, component by component
/// @param secondsBack [s] to the snapshot before, particles born since are drawn on their path from it
base::Bounds boundsOfAll(const EmitterSettings& def, const glm::vec3& low, const glm::vec3& high,
                         float seconds, float secondsBack);

/// Ranges of what has acted on particles since the oldest of them was born, besides modules.
struct ConditionsRange
{
    ReachConditions strongest; ///< and how long that is
    glm::vec3 low{0.0f};       ///< [m/s2] between these were the pulls of gravity and wind, see AppearanceJob
    glm::vec3 high{0.0f};
    float lowGround = 0.0f; ///< [m] between these was the ground plane, -infinity for none
    float highGround = 0.0f;
    float secondsBack = kLongestStep; ///< [s] see boundsOfAll()
    bool meetsGround = false;         ///< particles do not fall below it
    bool meetsOthers = false;         ///< they may go anywhere from there
};

/// As boundsOfAll() where modules move particles; infinite when unknown.
base::Bounds boundsOfStepped(const EmitterSettings& def, const ConditionsRange& conditions);

} // namespace fx::sim
