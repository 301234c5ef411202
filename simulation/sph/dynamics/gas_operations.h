/// @file gas_operations.h
/// Operations of GasDynamics on its state. Each group of functions has its own source file.
#pragma once

#include "foundation/result/status.h"
#include "simulation/sph/dynamics/dynamics_state.h"

#include <cstddef>
#include <span>
#include <vector>

namespace fx::sim {

// Frames: frame.cpp.

/// Computes supports, densities and entropies of new particles. If the caller has changed a particle, also
/// evaluates all particles.
template <class T>
void prepare(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Advances by `seconds` > 0 within the limit of sub-steps. If `work` is used up before the end, the next
/// call continues. The report covers all calls.
template <class T>
AdvanceReport runFrames(DynamicsState<T>& state, double seconds, base::TaskRunner& tasks,
                        base::WorkBudget& work);

// Small external changes between two frames, without a new evaluation: nudge.cpp.

/// Updates pressure, energy and speed of sound of all particles from their entropies. Then updates the
/// longest steps from the speed of sound, and the validity of the lists from the positions.
/// @param pressureScale (0, 1], other values are ignored
template <class T>
void acceptNudge(DynamicsState<T>& state, double pressureScale, base::TaskRunner& tasks);

// Validation of particles: particle_check.cpp.

/// Checks a particle. @return an error if a value is outside of the ranges at GasDynamics::add()
base::Status checkParticle(const GasParticle& particle, const Domain& domain);

/// Appends a particle. The particle has no density until prepare().
template <class T>
void appendParticle(DynamicsState<T>& state, const GasParticle& particle);

// The whole state as bytes: state_bytes.cpp.

/// Appends the state between two frames to `out`. The format is a header, then all columns in the order of
/// slots.
template <class T>
void saveState(const DynamicsState<T>& state, std::vector<std::byte>& out);

/// Reads the output of saveState() for the same definition. The tree is not saved. The function rebuilds the
/// tree from the positions of the last sort.
template <class T>
base::Status restoreState(DynamicsState<T>& state, std::span<const std::byte> bytes);

// Sums over all particles: totals.cpp.

/// Mass, momentum and energies of a state between frames, in the order of slots.
template <class T>
GasTotals sumTotals(const DynamicsState<T>& state);

/// Hash of all data on which later results depend, in the order of ids.
template <class T>
uint64_t hashState(const DynamicsState<T>& state);

} // namespace fx::sim
