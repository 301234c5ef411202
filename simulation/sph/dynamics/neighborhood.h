/// @file neighborhood.h
/// Keeps the tree and the lists of neighbors fit for the particles as they are now.
#pragma once

#include "simulation/sph/dynamics/dynamics_state.h"

namespace fx::sim {

/// Whether the order of the particles still serves; if not, they are sorted at the next evaluation.
template <class T>
bool treeIsGood(const DynamicsState<T>& s)
{
    constexpr double kMaxLoosenedShare = 0.25;
    return s.treeIsSorted && s.tree.loosened() <= kMaxLoosenedShare;
}

/// Sorts particles by their current positions and moves all columns. Records and active slots are invalid
/// afterwards.
template <class T>
void sortParticles(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Restores the tree of a state whose columns are in the order of a sort by sortedX..sortedSupport, and the
/// lists that were built at listX..listSupport where listState says that there are any.
template <class T>
void recoverTree(DynamicsState<T>& state, base::TaskRunner& tasks);

/// Searches the neighbors of `owners` within (1 + margin) times the larger support.
template <class T>
void searchNeighbors(DynamicsState<T>& state, std::span<const uint32_t> owners, double margin,
                     base::TaskRunner& tasks);

/// Measures how far particles have moved, and supports grown, since the lists of all were built.
template <class T>
void measureWays(DynamicsState<T>& state, base::TaskRunner& tasks);

/// [1] How much supports may grow with the lists that exist; 0 where they must be searched again.
template <class T>
double roomOfLists(const DynamicsState<T>& state);

/// [1] The margin that new lists should have: large where they will serve several steps.
template <class T>
double marginOfLists(const DynamicsState<T>& state);

} // namespace fx::sim
