/// @file nudge.h
/// Small changes from outside between two frames, taken in without a new evaluation.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Brings pressure, energy and sound of all particles to their entropies, wanted steps to the speed of sound,
/// and the account of the lists to the positions. @param pressureScale (0, 1], others are passed over
template <class T>
void acceptNudge(DynamicsState<T>& state, double pressureScale, base::TaskRunner& tasks);

} // namespace fx::sim
