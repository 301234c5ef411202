/// @file prediction.h
/// Predicts all particles to the present time, including particles in the middle of their steps.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Predicts all particles to the present time. Computes the records, the positions for the tree, the list of
/// active slots and the next end of the other steps. A slot is active if its step ends now. Particles that
/// have left a periodic or walled domain are moved back into it.
///
/// A block of slots is skipped if no step of the block ends now and no particle has moved by more than 1e-5
/// of its support (double: 1e-12). Positions move with the velocity at the middle of the step. Velocity and
/// entropy change by their rates. Pressure and energy change with the density and with the added heat. All
/// changes are linear in time. The speed of sound of an ideal gas follows from its energy.
///
/// If few particles are active, only the records of active particles are filled. In this case, fillSeen()
/// must be called when the neighbor lists of the active particles are known.
template <class T>
void predict(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Computes the missing records of the neighbors in the lists of `owners`. These are the records that the
/// last predict() has not filled.
template <class T>
void fillSeen(DynamicsState<T>& state, std::span<const uint32_t> owners, base::TaskRunner& tasks);

/// Factor by which the density changes if the product of divergence and time is `change`. The factor is
/// always positive. To first order, the factor is 1 - change.
template <class T>
T thinning(T change)
{
    return change > 0 ? T(1) / (T(1) + change) : T(1) - change;
}

/// Returns value + growth, but at least a tenth of `value`. A `value` that is not positive is returned
/// unchanged.
template <class T>
T grown(T value, T growth)
{
    return value > 0 ? std::max(value + growth, T(0.1) * value) : value;
}

} // namespace fx::sim
