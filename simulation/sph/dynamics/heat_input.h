/// @file heat_input.h
/// Heat that comes from outside, now or in the middle of a frame.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Gives the particle at `slot` heat: exact for any amount at constant density, whatever its step. Its
/// viscosity jumps to the largest.
template <class T>
void heatParticle(DynamicsState<T>& state, uint32_t slot, double joules);

/// [tick] when the next delayed heat arrives; the end of the frame if none does.
template <class T>
uint64_t nextHeat(const DynamicsState<T>& state);

/// Ends the steps of the particles whose heat is due now.
template <class T>
void wakeHeated(DynamicsState<T>& state);

/// Gives out the delayed heat that is due now, to particles whose density is that of now.
template <class T>
void giveDelayedHeat(DynamicsState<T>& state);

/// Moves delayed heat nearer by `seconds`.
template <class T>
void passTime(DynamicsState<T>& state, double seconds);

} // namespace fx::sim
