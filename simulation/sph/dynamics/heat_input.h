/// @file heat_input.h
/// External heat input, at once or in the middle of a frame.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Adds heat to the particle at `slot`, at any time within its step. The result is exact at constant density.
/// The viscosity of the particle is set to the largest value.
template <class T>
void heatParticle(DynamicsState<T>& state, uint32_t slot, double joules);

/// [tick] Time at which the next delayed heat is due; the end of the frame if there is none.
template <class T>
uint64_t nextHeat(const DynamicsState<T>& state);

/// Ends the steps of the particles whose heat is due now.
template <class T>
void wakeHeated(DynamicsState<T>& state);

/// Releases the delayed heat that is due now. The densities of the heated particles must be up to date.
template <class T>
void giveDelayedHeat(DynamicsState<T>& state);

/// Reduces the delays of pending heat by `seconds`.
template <class T>
void passTime(DynamicsState<T>& state, double seconds);

} // namespace fx::sim
