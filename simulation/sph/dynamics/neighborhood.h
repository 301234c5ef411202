/// @file neighborhood.h
/// Updates the tree and the neighbor lists for the present particles.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// True if the order of the particles is efficient for searches. If false, the next evaluation sorts the
/// particles.
template <class T>
bool treeIsGood(const DynamicsState<T>& s)
{
    constexpr double kMaxLoosenedShare = 0.25;
    return s.treeIsSorted && s.tree.loosened() <= kMaxLoosenedShare;
}

/// Sorts particles by their current positions and reorders all columns. After the call, records and active
/// slots are invalid.
template <class T>
void sortParticles(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Restores the tree of a state. The columns of the state are in the order of a sort by
/// sortedX..sortedSupport. If listState is valid, the neighbor lists are also restored, from
/// listX..listSupport.
template <class T>
void recoverTree(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Searches the neighbors of `owners` within (1 + margin) times the larger support.
template <class T>
void searchNeighbors(DynamicsState<T>& state, std::span<const uint32_t> owners, double margin,
                     base::TaskRunner& tasks);

/// Measures the motion of particles, and the growth of supports, since all lists were built.
template <class T>
void measureWays(DynamicsState<T>& state, base::TaskRunner& tasks);

/// [1] Relative growth of supports for which the existing lists suffice; 0 if the lists must be rebuilt.
template <class T>
double roomOfLists(const DynamicsState<T>& state);

/// [1] Margin with which new lists are built. The margin is large if the lists will be used for several
/// steps.
template <class T>
double marginOfLists(const DynamicsState<T>& state);

} // namespace fx::sim
