#include "simulation/sph/pair_loops/density_loop.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/sph/pair_loops/density_loop.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/precision_dispatch.h"
#include "simulation/sph/pair_loops/density_sums-inl.h"
#include "simulation/sph/pair_loops/flow_gradient.h"
#include "simulation/sph/pair_loops/support_search.h"

#include <algorithm>
#include <numbers>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {
namespace {

/// What one call of sumDensity works on.
template <class T>
struct DensityJob
{
    const DensityRules& rules;
    const PairSlots<T>& of;
    ImageRules<T> images;
    T reach;
    T self; ///< [1] (1 - e) w(0)
    T want; ///< [1] 3 N / (4 pi C): what S / (C m) has to be
    const DensityResults<T>& results;
};

/// The neighbors of one particle, block by block. Nearly all lists are one block, which is loaded once.
template <class T>
class Neighborhood
{
public:
    Neighborhood(const DensityJob<T>& job, uint32_t slot, NeighborBlock<T>& block)
        : job_(job), owner_(job.of.records[slot], slot, job.images), block_(block)
    {}

    /// Calls f() for every block, while the block holds it.
    template <class F>
    void forEachBlock(F&& f)
    {
        if (blocks_ == 1) {
            f();
            return;
        }
        blocks_ = 0;
        job_.of.lists.forEachPiece(owner_.slot, [&](const uint32_t* entries, uint32_t count, bool) HWY_ATTR {
            for (uint32_t begin = 0; begin < count; begin += NeighborBlock<T>::kCapacity) {
                const uint32_t size = std::min(count - begin, NeighborBlock<T>::kCapacity);
                block_.load(owner_, job_.of.records, entries + begin, size);
                ++blocks_;
                f();
            }
        });
    }

private:
    const DensityJob<T>& job_;
    Owner<T> owner_;
    NeighborBlock<T>& block_;
    uint32_t blocks_ = 0;
};

template <class T>
SupportSearch<T> beginSearch(const DensityJob<T>& job, uint32_t slot)
{
    const T guess = job.results.support[slot];
    const T smallest = static_cast<T>(job.rules.smallestSupport);
    const T largest = static_cast<T>(job.rules.largestSupport);
    const T bottom = std::min(std::max(smallest, guess * T(1.0 / 1024)), largest);
    const T top = std::max(std::min(largest, guess * (T(1) + job.reach)), bottom);
    const T want = job.want * job.of.records[slot].mass; // (2)
    return SupportSearch<T>(want, bottom, top, guess, static_cast<T>(job.rules.tolerance));
}

/// (7)
template <class T>
T exposureOf(const T* sum, T support)
{
    const T trace = sum[kSumMoments] + sum[kSumMoments + 3] + sum[kSumMoments + 5];
    const T* e = sum + kSumSlopes;
    const T slope = support * std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    return slope < trace ? slope / trace : T(1);
}

/// (8) @param inertia H^2 S / C
template <class T>
T expansionOf(const T* sum, T correction, T inertia)
{
    const T* flow = sum + kSumFlows;
    return inertia > T(0) ? correction * (flow[0] + flow[4] + flow[8]) / inertia : T(0);
}

template <class T>
void publish(const DensityJob<T>& job, uint32_t slot, const SupportSearch<T>& search, const T* sum,
             double norm)
{
    const T support = search.support();
    const T mass = job.self * job.of.records[slot].mass + sum[kSumMass];
    const T growth = T(0) - sum[kSumGrowth];
    const bool atLargest = search.isAtTop() && support >= static_cast<T>(job.rules.largestSupport);
    const bool atSmallest = search.isAtBottom() && support <= static_cast<T>(job.rules.smallestSupport);
    const bool isFree = !atLargest && !atSmallest && growth > T(0);
    const FlowGradient<T> flow = flowGradient(sum + kSumMoments, sum + kSumFlows);
    const DensityResults<T>& out = job.results;
    out.support[slot] = support;
    out.density[slot] = static_cast<T>(norm) * mass / (support * support * support);       // (1)
    out.correction[slot] = isFree ? std::clamp(T(3) * mass / growth, T(0.2), T(5)) : T(1); // (4)
    out.divergence[slot] = flow.divergence;
    out.curl[slot] = flow.curl;
    if (out.exposure != nullptr)
        out.exposure[slot] = exposureOf(sum, support);
    if (out.expansion != nullptr)
        out.expansion[slot] = expansionOf(sum, out.correction[slot], support * support * mass); // (8)
    out.wantsReach[slot] = search.isAtTop() && !atLargest;
}

template <class T, class Shape>
void sumOne(const DensityJob<T>& job, uint32_t slot, NeighborBlock<T>& block)
{
    LaneSums<T, kDensitySums> sums;
    Neighborhood<T> neighborhood(job, slot, block);
    SupportSearch<T> search = beginSearch(job, slot);
    const T self = job.self * job.of.records[slot].mass;
    while (!search.isDone()) {
        const T perSupport = T(1) / search.support();
        sums.clear();
        neighborhood.forEachBlock([&]() HWY_ATTR { block.template addMass<Shape>(perSupport, sums); });
        T mass[2];
        combineRows<2>(sums, kSumMass, mass, Adding());
        search.tell(self + mass[0], T(0) - mass[1]);
    }
    const T perSupport = T(1) / search.support();
    uint32_t inside = 0;
    sums.clear();
    neighborhood.forEachBlock([&]() HWY_ATTR { inside += block.template addAll<Shape>(perSupport, sums); });
    T total[kDensitySums];
    combineRows<kDensitySums>(sums, kSumMass, total, Adding());
    publish(job, slot, search, total, Shape::kNorm);
    job.results.neighbors[slot] = inside;
}

template <class T>
void sumAll(const DensityCall<T>& call)
{
    const DensityRules& rules = call.rules;
    const double bias = rules.subtractSelfBias ? selfBias(rules.kernel, rules.neighbors) : 0.0;
    NeighborBlock<T> block;
    withShape(rules.kernel, [&](auto shape) HWY_ATTR {
        using Shape = decltype(shape);
        const double want = 3.0 * rules.neighbors / (4.0 * std::numbers::pi * Shape::kNorm);
        const DensityJob<T> job{rules,
                                call.of,
                                ImageRules<T>(call.of.domain),
                                call.reach,
                                static_cast<T>((1.0 - bias) * Shape::kCenter),
                                static_cast<T>(want),
                                call.results};
        for (const uint32_t slot : call.of.slots)
            sumOne<T, Shape>(job, slot, block);
    });
}

FX_KERNEL_INSTANCES(void, sumAll, DensityCall)

} // namespace
} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

using namespace pairs;
FX_KERNEL_DISPATCH(void, sumDensity, sumAll, DensityCall)

} // namespace fx::sim
#endif
