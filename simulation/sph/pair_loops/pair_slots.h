/// @file pair_slots.h
/// Inputs of a loop over pairs: the slots to evaluate, their neighbor lists, and a record of each particle.
#pragma once

#include "simulation/sph/neighbors/neighbor_lists.h"

#include <span>

namespace fx::sim {

/// Record of a gas particle for loops over pairs, in one cache line (float) or two (double).
///
/// A record has sixteen numbers in four groups of four. The loops load whole groups and transpose them, which
/// is faster than gathering single numbers. The density loop needs the first two groups, the force loop needs
/// all four groups.
template <class T>
struct alignas(16 * sizeof(T)) GasRecord
{
    T x, y, z;    ///< [m]
    T support;    ///< [m] radius H of the kernel's support, > 0
    T vx, vy, vz; ///< [m/s] velocity at the time of the loop
    T mass;       ///< [kg] > 0
    T push;       ///< [m5/(kg s2)] f (P - P_ambient) / rho^2, with the correction f for varying support
    T density;    ///< [kg/m3] > 0
    T sound;      ///< [m/s]
    T viscosity;  ///< [1] coefficient alpha of the artificial viscosity
    T limiter;    ///< [1] Balsara's factor, 0..1
    T energy;     ///< [J/kg] specific thermal energy, for conduction
    T pressure;   ///< [Pa] pressure, for the conductivity, which depends on pressure differences
    T stepLevel;  ///< [1] binary logarithm of the particle's time step in ticks, a small integer
};

static_assert(sizeof(GasRecord<float>) == 64 && sizeof(GasRecord<double>) == 128);

template <class T>
struct PairSlots
{
    const NeighborLists<T>& lists;
    const GasRecord<T>* records; ///< indexed by slot
    const Domain& domain;
    std::span<const uint32_t> slots; ///< slots to evaluate, all of which own lists
};

} // namespace fx::sim
