/// @file neighbor_lists.h
/// Lists of neighbors, kept until a particle has moved too far.
#pragma once

#include "simulation/sph/neighbors/neighbor_search.h"

#include <type_traits>

namespace fx::sim {

/// Neighbors of particles, found for all at once and kept until a particle has moved too far: lists built
/// with `margin` hold all pairs nearer than max(support) as long as for every particle
///     support now + 2 (largest distance that any particle has moved since) <= (1 + margin) support then.
template <class T>
class NeighborLists
{
public:
    /// @param capacity particles, below 2^29
    /// @param entriesPerParticle memory for lists; particles without memory are searched on each request for
    ///         their list: slower, with equal results
    NeighborLists(std::pmr::memory_resource* memory, uint32_t capacity, uint32_t entriesPerParticle);

    /// Lists, for every slot of `owners` (ascending), all others j, mirror images included, with
    /// |x_i - x_j| < (1 + margin) max(support_i, support_j) at the time of the last refit. The particle
    /// itself is not in its list, its own mirror images are. The order of a list depends on the tree alone.
    /// Periodic axes and those between two walls must be at least twice as long as the longest such reach.
    /// The tree must outlive the lists and be neither sorted nor refit while they are in use. Every thread
    /// needs 160 KiB of stack.
    void build(const ParticleTree<T>& tree, const Domain& domain, std::span<const uint32_t> owners, T margin,
               base::TaskRunner& tasks);

    /// Calls f(const uint32_t* entries, uint32_t count, bool last) for the list of `slot`, one of the
    /// owners, in pieces. `entries` can be read up to the next multiple of kLanes; every piece but the last
    /// has a count that is such a multiple. Nearly all lists come in one piece. Thread-safe.
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

    /// Owners of the last build without a list, because memory was exhausted or they have more than about two
    /// thousand neighbors: each read costs about ten searches.
    uint32_t unlisted() const { return pool_.unlisted(); }
    /// Entries of all lists of the last build, without padding; those of unlisted owners not counted.
    uint64_t entries() const { return pool_.total(); }

private:
    SearchSetup<T> setup_;
    ListPool pool_;
};

extern template class NeighborLists<float>;
extern template class NeighborLists<double>;

} // namespace fx::sim
