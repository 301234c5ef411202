#include "simulation/sph/pair_loops/concentration_loop.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/sph/pair_loops/concentration_loop.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/precision_dispatch.h"
#include "simulation/sph/pair_loops/neighbors-inl.h"
#include "simulation/sph/pair_loops/parting.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {
namespace {

constexpr uint32_t kConcentrationSums = 6; ///< three of (1), three of (2)

/// The particle that a list belongs to, in all lanes.
template <class T>
struct ConcentrationOwner
{
    ConcentrationOwner(double reach, const GasRecord<T>& own, uint32_t slot, const ImageRules<T>& images)
        : owner(own, slot, images), support(own.support), mass(own.mass), range(reach),
          perSquare(Pack<T>(1.0) / (support * support))
    {}
    Owner<T> owner;
    Pack<T> support, mass, range, perSquare;
};

/// One vector of pairs. Padding is the owner itself, which has no direction.
template <class T>
HWY_INLINE void addConcentration(const ConcentrationOwner<T>& i, const GasRecord<T>* records,
                                 const uint32_t* entries, Pack<T>* sum)
{
    const Pack<T> none(0.0), one(1.0), two(2.0);
    const Entries<T> lanes(entries);
    const Quad<T> where = loadQuad(records, entries, 0);  // x, y, z, support
    const Quad<T> motion = loadQuad(records, entries, 1); // velocity, mass
    const Pack<T> x[3] = {where.a, where.b, where.c};
    const Pack<T> v[3] = {motion.a, motion.b, motion.c};
    const Relative<T> pair(i.owner, lanes, x, v);
    const Pack<T>* d = pair.d;
    const Pack<T> square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const Pack<T> range = i.range * larger(i.support, where.d);
    const Pack<T> r = larger(root(square), range * Pack<T>(kCoincident));
    const Pack<T> near = larger(one - r / range, none);
    const Pack<T> push = range / r * (near * near) * (two * motion.d / (i.mass + motion.d)); // (1)
    const Pack<T> inside = larger(one - square * i.perSquare, none);                         // (2)
    for (uint32_t a = 0; a < 3; ++a) {
        sum[a] += push * d[a];
        sum[3 + a] += inside * d[a];
    }
}

template <class T>
void addPiece(const ConcentrationOwner<T>& owner, const GasRecord<T>* records, const uint32_t* entries,
              uint32_t count, LaneSums<T, kConcentrationSums>& sums)
{
    addVectors(
        entries, count, sums, [&](const uint32_t* at, Pack<T>* sum) HWY_ATTR __attribute__((always_inline)) {
            addConcentration(owner, records, at, sum);
        });
}

template <class T>
void sumAll(const ConcentrationCall<T>& call)
{
    const PairSlots<T>& of = call.of;
    const ConcentrationResults<T>& out = call.results;
    const ImageRules<T> images(of.domain);
    for (const uint32_t slot : of.slots) {
        const ConcentrationOwner<T> owner(call.range, of.records[slot], slot, images);
        LaneSums<T, kConcentrationSums> sums;
        sums.clear();
        of.lists.forEachPiece(slot, [&](const uint32_t* entries, uint32_t count, bool)
                                        HWY_ATTR { addPiece(owner, of.records, entries, count, sums); });
        T total[kConcentrationSums];
        combineRows<kConcentrationSums>(sums, 0, total, Adding());
        out.x[slot] = total[0];
        out.y[slot] = total[1];
        out.z[slot] = total[2];
        out.outwardX[slot] = total[3];
        out.outwardY[slot] = total[4];
        out.outwardZ[slot] = total[5];
    }
}

FX_KERNEL_INSTANCES(void, sumAll, ConcentrationCall)

} // namespace
} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

using namespace pairs;
FX_KERNEL_DISPATCH(void, sumConcentration, sumAll, ConcentrationCall)

} // namespace fx::sim
#endif
