/// @file gas_operations.h
/// Operations of GasDynamics on its state. Each group of functions has its own source file.
#pragma once

#include "foundation/result/status.h"
#include "simulation/sph/dynamics/dynamics_state.h"

#include <cstddef>
#include <span>
#include <vector>

namespace fx::sim {

// Frames from their beginning to their end: frame.cpp.

/// Computes supports, densities and entropies of new particles, then evaluates all particles if the caller
/// has changed any. Does nothing otherwise.
template <class T>
void prepare(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Steps by `seconds` > 0 within the budget of sub-steps. If `work` is used up before, state.advance stays
/// open, and the next call continues; the report is that of all calls.
template <class T>
AdvanceReport runFrames(DynamicsState<T>& state, double seconds, base::TaskRunner& tasks,
                        base::WorkBudget& work);

// Small changes from outside between two frames, taken in without a new evaluation: nudge.cpp.

/// Brings pressure, energy and sound of all particles to their entropies, wanted steps to the speed of sound,
/// and the account of the lists to the positions. @param pressureScale (0, 1], others are passed over
template <class T>
void acceptNudge(DynamicsState<T>& state, double pressureScale, base::TaskRunner& tasks);

// Validation of particles: particle_check.cpp.

/// Refuses particles outside the ranges that GasDynamics::add states.
base::Status checkParticle(const GasParticle& particle, const Domain& domain);

/// Appends a particle; it has no density until prepare().
template <class T>
void appendParticle(DynamicsState<T>& state, const GasParticle& particle);

// The whole state as bytes: state_bytes.cpp.

/// Appends the state between two frames to `out`: a header, then column after column in the order of slots.
template <class T>
void saveState(const DynamicsState<T>& state, std::vector<std::byte>& out);

/// Reads what saveState has written for the same definition. The tree is not saved: it is rebuilt from the
/// positions of the last sort.
template <class T>
base::Status restoreState(DynamicsState<T>& state, std::span<const std::byte> bytes);

// Sums over all particles: totals.cpp.

/// Mass, momentum and energies of a state between frames, in the order of slots.
template <class T>
GasTotals sumTotals(const DynamicsState<T>& state);

/// Hash of all data that later results depend on, by id.
template <class T>
uint64_t hashState(const DynamicsState<T>& state);

} // namespace fx::sim
