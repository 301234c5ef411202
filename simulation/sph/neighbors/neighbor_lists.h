/// @file neighbor_lists.h
/// Verlet lists: neighbor lists that stay valid until a particle has moved too far.
#pragma once

#include "simulation/sph/neighbors/neighbor_search.h"

#include <type_traits>

namespace fx::sim {

/// Neighbor lists of particles (Verlet lists). Lists built with `margin` contain all pairs nearer than the
/// larger of their supports, as long as every particle satisfies: present support + 2 (largest displacement
/// of any particle since the build) <= (1 + margin) (support at the build).
template <class T>
class NeighborLists
{
public:
    /// Creates empty lists.
    /// @param capacity maximum number of particles, below 2^29
    /// @param entriesPerParticle memory for lists. A particle whose list does not fit is searched again on
    ///          each request; this is slower, with equal results
    NeighborLists(std::pmr::memory_resource* memory, uint32_t capacity, uint32_t entriesPerParticle);

    /// Builds the lists of every slot of `owners` (ascending). The list of i holds all other particles j and
    /// all mirror images with |x_i - x_j| < (1 + margin) max(support_i, support_j) at the time of the last
    /// refit. The particle itself is not in its list; its mirror images are. The order of a list depends only
    /// on the tree. Periodic axes and axes between two walls must be at least twice as long as the longest
    /// reach. The tree must outlive the lists and must be neither sorted nor refit while they are in use.
    /// Every thread needs 160 KiB of stack.
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

    /// Number of owners of the last build without a list, because memory was exhausted or because they have
    /// more than about two thousand neighbors. Each access to such a list costs about ten searches.
    uint32_t unlisted() const { return pool_.unlisted(); }
    /// Entries of all lists of the last build, without padding and without owners that have no list.
    uint64_t entries() const { return pool_.total(); }

private:
    SearchSetup<T> setup_;
    ListPool pool_;
};

extern template class NeighborLists<float>;
extern template class NeighborLists<double>;

} // namespace fx::sim
