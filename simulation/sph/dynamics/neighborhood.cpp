#include "simulation/sph/dynamics/neighborhood.h"

#include "simulation/parallel.h"

namespace fx::sim {

namespace {

constexpr double kSmallMargin = 0.03; ///< of lists that serve once: room for supports to grow
constexpr double kLargeMargin = 0.14; ///< of lists that serve several steps
constexpr double kSlowStep = 0.015;   ///< way per step, in supports, below which lists serve several steps
constexpr double kLeastRoom = 0.015;  ///< growth of supports that lists must leave room for

template <class T>
PointColumns<T> pointsNow(const DynamicsState<T>& s)
{
    return {s.nowX.data(), s.nowY.data(), s.nowZ.data(), s.gas.support.data(), s.count};
}

} // namespace

template <class T>
void sortParticles(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    s.tree.sort(pointsNow(s), s.def.domain, tasks);
    const std::span<const uint32_t> order = s.tree.order();
    parallelRows(tasks, s.count, 4096, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            const uint32_t from = order[i];
            s.sortedX[i] = s.nowX[from];
            s.sortedY[i] = s.nowY[from];
            s.sortedZ[i] = s.nowZ[from];
            s.sortedSupport[i] = s.gas.support[from];
            s.place[s.gas.id[from]] = i;
        }
    });
    s.gas.permute(order, tasks);
    s.tree.refit({s.sortedX.data(), s.sortedY.data(), s.sortedZ.data(), s.sortedSupport.data(), s.count},
                 tasks);
    s.treeIsSorted = true;
    s.mustRecoverTree = false;
    s.listState = {};
}

template <class T>
void recoverTree(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    const PointColumns<T> sorted{s.sortedX.data(), s.sortedY.data(), s.sortedZ.data(), s.sortedSupport.data(),
                                 s.count};
    s.tree.sort(sorted, s.def.domain, tasks);
    s.tree.refit(sorted, tasks);
    s.treeIsSorted = true;
    s.mustRecoverTree = false;
    s.listState = {};
}

template <class T>
void searchNeighbors(DynamicsState<T>& s, std::span<const uint32_t> owners, double margin,
                     base::TaskRunner& tasks)
{
    s.tree.refit(pointsNow(s), tasks);
    s.lists.build(s.tree, s.def.domain, owners, T(margin), tasks);
    s.listState = {owners.size() == s.count, margin, 0.0, 0.0, s.listState.perStep};
    s.listsServeActive = true;
    ++s.searches;
}

template <class T>
double roomOfLists(const DynamicsState<T>& s)
{
    // Entries stay complete while 2 moved + growth <= margin, both in units of the larger support of a pair.
    const ListState& kept = s.listState;
    const double room = (1.0 + kept.margin - 2.0 * kept.moved) / (1.0 + kept.growth) - 1.0;
    return kept.valid && room >= kLeastRoom ? room : 0.0;
}

template <class T>
double marginOfLists(const DynamicsState<T>& s)
{
    return s.listState.perStep < kSlowStep && s.activeCount == s.count ? kLargeMargin : kSmallMargin;
}

template void sortParticles<float>(DynamicsState<float>&, base::TaskRunner&);
template void sortParticles<double>(DynamicsState<double>&, base::TaskRunner&);
template void recoverTree<float>(DynamicsState<float>&, base::TaskRunner&);
template void recoverTree<double>(DynamicsState<double>&, base::TaskRunner&);
template void searchNeighbors<float>(DynamicsState<float>&, std::span<const uint32_t>, double,
                                     base::TaskRunner&);
template void searchNeighbors<double>(DynamicsState<double>&, std::span<const uint32_t>, double,
                                      base::TaskRunner&);
template double roomOfLists<float>(const DynamicsState<float>&);
template double roomOfLists<double>(const DynamicsState<double>&);
template double marginOfLists<float>(const DynamicsState<float>&);
template double marginOfLists<double>(const DynamicsState<double>&);

} // namespace fx::sim
