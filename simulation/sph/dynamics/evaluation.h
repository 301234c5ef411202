/// @file evaluation.h
/// Computes density, state and forces of the particles whose step ends now, and the first densities of new
/// particles.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Computes supports, densities and velocity gradients of the active slots. After the call, every active slot
/// has a list that covers its support.
template <class T>
void evaluateDensity(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Computes densities of `slots` from the existing lists. @return true if a support must grow beyond the
/// range of its list
template <class T>
bool sumDensities(DynamicsState<T>& state, std::span<const uint32_t> slots, double reach,
                  base::TaskRunner& tasks);

/// Computes pressure, viscosity switch and limiter of the active slots from their new densities. Writes
/// columns and records.
template <class T>
void evaluateState(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Computes accelerations, heating and longest steps of the active slots.
template <class T>
void evaluateForces(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Computes supports, densities and entropies of new particles, and sorts all particles (first_density.cpp).
/// If the definition has no bounds of supports, the bounds are set to 1e-4 and 200 times the median support.
template <class T>
void findFirstDensities(DynamicsState<T>& state, base::TaskRunner& tasks);

} // namespace fx::sim
