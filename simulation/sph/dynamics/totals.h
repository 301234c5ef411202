/// @file totals.h
/// Sums over all particles.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Mass, momentum and energies of a state between frames, in the order of places.
template <class T>
GasTotals sumTotals(const DynamicsState<T>& state);

/// Hash of everything that decides what comes next, by id.
template <class T>
uint64_t hashState(const DynamicsState<T>& state);

} // namespace fx::sim
