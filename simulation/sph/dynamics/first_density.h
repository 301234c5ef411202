/// @file first_density.h
/// Particles that have just come: how far they reach and how dense they are.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Supports, densities and entropies of particles that have none; sorts everybody. Bounds of supports that
/// the definition leaves open follow from the median: 1e-4 and 200 times it.
template <class T>
void findFirstDensities(DynamicsState<T>& state, base::TaskRunner& tasks);

/// True for a particle that has been added and not yet seen its neighbors.
template <class T>
bool isNew(const DynamicsState<T>& state, uint32_t place)
{
    return state.gas.viscosity[place] < 0;
}

} // namespace fx::sim
