#include "simulation/sph/dynamics/neighborhood.h"

#include "foundation/tasks/parallel_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::sim {

namespace {

constexpr double kSmallMargin = 0.03; ///< of lists that serve once: room for supports to grow
constexpr double kOnlyMargin = 0.05;  ///< the same where no second search follows
constexpr double kLargeMargin = 0.14; ///< of lists that serve several steps
constexpr double kSlowStep = 0.015;   ///< way per step, in supports, below which lists serve several steps
constexpr double kLastMargin = 0.08;  ///< of lists at the end of a frame, which serve the next beginning
constexpr double kMinSupportMargin = 0.015;    ///< growth of supports that lists must leave room for
constexpr double kMinFastSupportMargin = 0.03; ///< the same where steps are long

template <class T>
PointColumns<T> pointsNow(const DynamicsState<T>& s)
{
    return {s.nowX.data(), s.nowY.data(), s.nowZ.data(), s.gas.support.data(), s.count};
}

template <class T>
PointColumns<T> pointsOfLists(const DynamicsState<T>& s)
{
    return {s.listX.data(), s.listY.data(), s.listZ.data(), s.listSupport.data(), s.count};
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
            s.slot[s.gas.id[from]] = i;
        }
    });
    s.gas.permute(order, tasks);
    s.tree.refit({s.sortedX.data(), s.sortedY.data(), s.sortedZ.data(), s.sortedSupport.data(), s.count},
                 tasks);
    std::fill_n(s.blockChanged.data(), blockCount(s.count), uint8_t(1));
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
    if (!s.listState.valid)
        return;
    s.tree.refit(pointsOfLists(s), tasks);
    for (uint32_t i = 0; i < s.count; ++i)
        s.active[i] = i;
    s.lists.build(s.tree, s.def.domain, s.active.first(s.count), T(s.listState.margin), tasks);
}

template <class T>
void searchNeighbors(DynamicsState<T>& s, std::span<const uint32_t> owners, double margin,
                     base::TaskRunner& tasks)
{
    s.tree.refit(pointsNow(s), tasks);
    s.lists.build(s.tree, s.def.domain, owners, T(margin), tasks);
    s.listState = {owners.size() == s.count, margin, 0.0, 0.0, s.listState.perStep};
    ++s.searches;
    if (!s.listState.valid)
        return;
    std::copy_n(s.nowX.data(), s.count, s.listX.data());
    std::copy_n(s.nowY.data(), s.count, s.listY.data());
    std::copy_n(s.nowZ.data(), s.count, s.listZ.data());
    std::copy_n(s.gas.support.data(), s.count, s.listSupport.data());
}

template <class T>
void measureWays(DynamicsState<T>& s, base::TaskRunner& tasks)
{
    if (!s.listState.valid)
        return;
    std::atomic<uint64_t> farthest{0}, largest{std::bit_cast<uint64_t>(1.0)};
    parallelRows(tasks, s.count, kBlock, [&](uint32_t begin, uint32_t end) {
        T square = 0, growth = 1;
        for (uint32_t i = begin; i < end; ++i) {
            const T perSupport = T(1) / s.listSupport[i];
            const T x = (s.nowX[i] - s.listX[i]) * perSupport;
            const T y = (s.nowY[i] - s.listY[i]) * perSupport;
            const T z = (s.nowZ[i] - s.listZ[i]) * perSupport;
            square = std::max(square, x * x + y * y + z * z);
            growth = std::max(growth, s.gas.support[i] * perSupport);
        }
        raiseTo(farthest, std::bit_cast<uint64_t>(double(square))); // bits of positive numbers are in order
        raiseTo(largest, std::bit_cast<uint64_t>(double(growth)));
    });
    s.listState.moved = std::sqrt(std::bit_cast<double>(farthest.load()));
    s.listState.growth = std::bit_cast<double>(largest.load()) - 1.0;
}

template <class T>
double roomOfLists(const DynamicsState<T>& s)
{
    // Entries stay complete while 2 moved + growth <= margin, both in units of the larger support of a pair.
    const ListState& kept = s.listState;
    const double room = (1.0 + kept.margin - 2.0 * kept.moved) / (1.0 + kept.growth) - 1.0;
    return kept.valid && room >= (kept.perStep < kSlowStep ? kMinSupportMargin : kMinFastSupportMargin) ? room
                                                                                                        : 0.0;
}

template <class T>
double marginOfLists(const DynamicsState<T>& s)
{
    if (s.activeCount < s.count)
        return s.def.exact ? kSmallMargin : kOnlyMargin;
    if (s.listState.perStep < kSlowStep)
        return kLargeMargin;
    return s.now == kFrameTicks ? kLastMargin : kSmallMargin;
}

template void sortParticles<float>(DynamicsState<float>&, base::TaskRunner&);
template void sortParticles<double>(DynamicsState<double>&, base::TaskRunner&);
template void recoverTree<float>(DynamicsState<float>&, base::TaskRunner&);
template void recoverTree<double>(DynamicsState<double>&, base::TaskRunner&);
template void searchNeighbors<float>(DynamicsState<float>&, std::span<const uint32_t>, double,
                                     base::TaskRunner&);
template void searchNeighbors<double>(DynamicsState<double>&, std::span<const uint32_t>, double,
                                      base::TaskRunner&);
template void measureWays<float>(DynamicsState<float>&, base::TaskRunner&);
template void measureWays<double>(DynamicsState<double>&, base::TaskRunner&);
template double roomOfLists<float>(const DynamicsState<float>&);
template double roomOfLists<double>(const DynamicsState<double>&);
template double marginOfLists<float>(const DynamicsState<float>&);
template double marginOfLists<double>(const DynamicsState<double>&);

} // namespace fx::sim
