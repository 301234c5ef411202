#include "simulation/sph/pair_loops/force_loop.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/sph/pair_loops/force_loop.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/precision_dispatch.h"
#include "simulation/sph/pair_loops/force_sums-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {
namespace {

template <class T, class Shape>
void sumOne(const ForceRules& rules, const PairSlots<T>& of, const ImageRules<T>& images, uint32_t slot,
            const ForceResults<T>& out)
{
    const GasRecord<T>& own = of.records[slot];
    const PairOwner<T, Shape> owner(rules, own, slot, images);
    LaneSums<T, kForceSums> sums;
    sums.clear();
    for (T& level : sums.lane[kSumLevel])
        level = static_cast<T>(kNoLevel);
    uint32_t pairs = 0;
    of.lists.forEachPiece(slot, [&](const uint32_t* entries, uint32_t count, bool)
                                    HWY_ATTR { pairs += addPiece(owner, of.records, entries, count, sums); });
    T total[4], signal, level;
    combineRows<4>(sums, kSumAcceleration, total, Adding());
    combineRows<1>(sums, kSumSignal, &signal, TakingLarger());
    combineRows<1>(sums, kSumLevel, &level, TakingSmaller());
    out.ax[slot] = T(0) - total[0];
    out.ay[slot] = T(0) - total[1];
    out.az[slot] = T(0) - total[2];
    out.heating[slot] = total[kSumHeating];
    out.signalSpeed[slot] = larger(own.sound + own.sound, signal);
    out.fastestNeighbor[slot] = pairs > 0 ? level : own.stepLevel;
    out.pairs[slot] = pairs;
}

template <class T>
void sumAll(const ForceCall<T>& call)
{
    const ImageRules<T> images(call.of.domain);
    withShape(call.rules.kernel, [&](auto shape) HWY_ATTR {
        for (const uint32_t slot : call.of.slots)
            sumOne<T, decltype(shape)>(call.rules, call.of, images, slot, call.results);
    });
}

FX_KERNEL_INSTANCES(void, sumAll, ForceCall)

} // namespace
} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

using namespace pairs;
FX_KERNEL_DISPATCH(void, sumForces, sumAll, ForceCall)

} // namespace fx::sim
#endif
