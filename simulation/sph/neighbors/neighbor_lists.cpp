#include "simulation/sph/neighbors/neighbor_lists.h"

#include "foundation/simd/instruction_set.h"
#include "foundation/tasks/parallel_rows.h"

namespace fx::sim {

namespace {

constexpr uint32_t kMinBatch = 1024; ///< owners; fewer are not worth waking a thread

} // namespace

template <class T>
NeighborLists<T>::NeighborLists(std::pmr::memory_resource* memory, uint32_t capacity,
                                uint32_t entriesPerParticle)
    : pool_(memory, capacity, size_t(capacity) * entriesPerParticle)
{}

template <class T>
void NeighborLists<T>::build(const ParticleTree<T>& tree, const Domain& domain,
                             std::span<const uint32_t> owners, T margin, base::TaskRunner& tasks)
{
    base::applyInstructionSetLimit();
    setup_ = searchSetup(tree.view(), domain, margin);
    pool_.clear();
    parallelRows(tasks, uint32_t(owners.size()), kMinBatch, [&](uint32_t begin, uint32_t end) {
        ListWriter writer(pool_);
        listOwners(setup_, owners.subspan(begin, end - begin), writer);
    });
}

template class NeighborLists<float>;
template class NeighborLists<double>;

} // namespace fx::sim
