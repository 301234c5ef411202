/// @file step_limiter.h
/// Keeps the steps of neighbors within a factor of each other; (4) of kick-drift-kick.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Levels of the next steps of the active places: what they want, what their neighbors allow, what the clock
/// allows.
template <class T>
void chooseLevels(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Ends the steps of neighbors of the active places that are too long, now. They become the active places, to
/// be evaluated at once. @return how many
template <class T>
uint32_t wakeNeighbors(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Limits wanted steps by those of the neighbors, at the end of a frame when all are active and listed.
template <class T>
void limitWantedSteps(DynamicsState<T>& state, base::TaskRunner& tasks);

} // namespace fx::sim
