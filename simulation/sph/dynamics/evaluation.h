/// @file evaluation.h
/// Density, state and forces of the particles whose step ends now, and first densities of new particles.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Computes supports, densities and velocity gradients of the active slots. Afterwards every active slot has
/// a list that covers its support.
template <class T>
void evaluateDensity(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Computes densities of `slots` from the existing lists. @return whether a support must grow beyond the
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

/// Computes supports, densities and entropies of particles that have none, and sorts all particles
/// (first_density.cpp). Bounds of supports that the definition leaves open are set to 1e-4 and 200 times the
/// median support.
template <class T>
void findFirstDensities(DynamicsState<T>& state, base::TaskRunner& tasks);

} // namespace fx::sim
