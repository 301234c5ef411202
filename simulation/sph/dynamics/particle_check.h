/// @file particle_check.h
/// What may enter the gas.
#pragma once

#include "foundation/result/status.h"
#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Refuses particles outside the ranges that GasDynamics::add states.
base::Status checkParticle(const GasParticle& particle, const Domain& domain);

/// Puts a particle behind the others; it has no density until prepare().
template <class T>
void appendParticle(DynamicsState<T>& state, const GasParticle& particle);

} // namespace fx::sim
