/// @file neighbor_lists.h
/// Verlet lists: neighbor lists that stay valid until a particle has moved too far.
#pragma once

#include "simulation/sph/neighbors/neighbor_search.h"

#include <type_traits>

namespace fx::sim {

/// Neighbor lists of particles (Verlet lists). The lists contain all pairs nearer than the larger of both
/// supports, under a condition for every particle. The condition is: support + 2 d <= (1 + margin) (support
/// at the build), where d is the largest displacement of any particle since the build.
template <class T>
class NeighborLists
{
public:
    /// Creates empty lists.
    /// @param capacity maximum number of particles, below 2^29
    /// @param entriesPerParticle memory for lists. A list that does not fit is searched again on each
    /// request,
    ///         which is slower but gives the same results
    NeighborLists(std::pmr::memory_resource* memory, uint32_t capacity, uint32_t entriesPerParticle);

    /// Builds the lists of every slot of `owners` (ascending). The list of particle i has all other particles
    /// j and all mirror images with |x_i - x_j| < (1 + margin) max(support_i, support_j). The positions are
    /// from the last refit. The list does not contain particle i itself, but the mirror images of i. The
    /// order of a list depends only on the tree. Periodic axes and axes between two walls must be at least
    /// twice as long as the longest reach. The tree must outlive the lists. The tree must not be sorted or
    /// refit while the lists are in use. Every thread needs 160 KiB of stack.
    void build(const ParticleTree<T>& tree, const Domain& domain, std::span<const uint32_t> owners, T margin,
               base::TaskRunner& tasks);

    /// Calls f(const uint32_t* entries, uint32_t count, bool last) for each piece of the list of `slot`,
    /// which must be one of the owners. `entries` can be read up to the next multiple of kLanes. The count of
    /// every piece except the last is a multiple of kLanes. Nearly all lists consist of one piece.
    /// Thread-safe.
    template <class F>
    void forEachPiece(uint32_t slot, F&& f) const
    {
        const uint32_t start = pool_.start(slot);
        if (start != ListPool::kUnlisted) {
            f(pool_.entries(start), pool_.count(slot), true);
            return;
        }
        using Function = std::remove_reference_t<F>;
        searchOwner(
            setup_, slot,
            [](void* argument, const uint32_t* entries, uint32_t count, bool last) {
                (*static_cast<Function*>(argument))(entries, count, last);
            },
            const_cast<std::remove_const_t<Function>*>(&f));
    }

    /// Number of owners of the last build without a list. Causes are exhausted memory, or more than about two
    /// thousand neighbors. Each access to a missing list costs about ten searches.
    uint32_t unlisted() const { return pool_.unlisted(); }
    /// Number of entries of all lists of the last build, without padding.
    uint64_t entries() const { return pool_.total(); }

private:
    SearchSetup<T> setup_;
    ListPool pool_;
};

extern template class NeighborLists<float>;
extern template class NeighborLists<double>;

} // namespace fx::sim
