/// @file evaluation.h
/// Density, state and forces of the particles whose step ends now, and first densities of new ones.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Supports, densities and velocity gradients of the active slots. Lists of all active slots exist
/// afterwards and cover their supports.
template <class T>
void evaluateDensity(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Densities of `slots` from the lists that exist. True when a support has to grow beyond them.
template <class T>
bool sumDensities(DynamicsState<T>& state, std::span<const uint32_t> slots, double reach,
                  base::TaskRunner& tasks);

/// Pressure, switch and limiter of the active slots from their new densities, into columns and records.
template <class T>
void evaluateState(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Accelerations, heating and longest steps of the active slots.
template <class T>
void evaluateForces(DynamicsState<T>& state, base::TaskRunner& tasks);

/// In first_density.cpp: supports, densities and entropies of particles that have none; sorts all particles.
/// Bounds of supports that the definition leaves open follow from the median: 1e-4 and 200 times it.
template <class T>
void findFirstDensities(DynamicsState<T>& state, base::TaskRunner& tasks);

} // namespace fx::sim
