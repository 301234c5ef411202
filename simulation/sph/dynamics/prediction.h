/// @file prediction.h
/// Prediction of particles in the middle of their steps to the present time.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Fills records, positions for the tree, the list of active slots (those whose step ends now) and the next
/// end of the others. Particles that have left the domain are brought back.
///
/// Blocks of slots where no step ends, and no particle has moved by more than a hundred thousandth of its
/// support (double: a million millionth), are passed over. Positions move with the velocity of the middle of
/// the step, velocity and entropy grow by their rates, pressure and energy by the change of density that the
/// expansion gives and by heat: all linear in time. The speed of sound of an ideal gas follows its energy.
///
/// Where few are active, only theirs are filled: fillSeen() has to follow when their lists are known.
template <class T>
void predict(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Fills the records that the lists of `owners` show and that the last predict() has left out.
template <class T>
void fillSeen(DynamicsState<T>& state, std::span<const uint32_t> owners, base::TaskRunner& tasks);

/// Factor of the density when the divergence times the time is `change`: positive, and to first order 1 -
/// change.
template <class T>
T thinning(T change)
{
    return change > 0 ? T(1) / (T(1) + change) : T(1) - change;
}

/// value + growth, but never less than a tenth of a positive value.
template <class T>
T grown(T value, T growth)
{
    return value > 0 ? std::max(value + growth, T(0.1) * value) : value;
}

} // namespace fx::sim
