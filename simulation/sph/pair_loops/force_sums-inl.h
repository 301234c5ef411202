/// @file force_sums-inl.h
/// The sums of gas-pair-forces over a piece of a list. The file is included once for each instruction set.
#if defined(FX_PAIR_FORCE_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PAIR_FORCE_SUMS_INL
#undef FX_PAIR_FORCE_SUMS_INL
#else
#define FX_PAIR_FORCE_SUMS_INL
#endif

#include "simulation/sph/pair_loops/force_loop.h"
#include "simulation/sph/pair_loops/neighbors-inl.h"
#include "simulation/sph/pair_loops/parting.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {

/// Indices of the sums in LaneSums.
enum : uint32_t
{
    kSumAcceleration = 0, ///< three sums: the components of the acceleration with the opposite sign
    kSumHeating = 3,
    kSumSignal = 4, ///< largest signal speed
    kSumLevel = 5,  ///< smallest step level
    kForceSums = 6
};

constexpr double kNoLevel = 1e30;

/// Values of the particle that owns the list, broadcast to all lanes of vectors.
template <class T, class Shape>
struct PairOwner
{
    PairOwner(const ForceRules& rules, const GasRecord<T>& own, uint32_t slot, const ImageRules<T>& images)
        : ids(rules.ids), owner(own, slot, images), support(own.support), perH(Pack<T>(1.0) / support),
          peak(peakSlope(perH)), push(own.push), density(own.density), sound(own.sound),
          viscosity(own.viscosity), limiter(own.limiter), energy(own.energy), pressure(own.pressure),
          beta(rules.beta), conductivity(rules.conductivity)
    {}
    /// Returns C / H^5, see sph_kernel.h.
    static HWY_INLINE Pack<T> peakSlope(Pack<T> perSupport)
    {
        const Pack<T> square = perSupport * perSupport;
        return Pack<T>(Shape::kNorm) * (square * square * perSupport);
    }
    const uint32_t* ids;
    Owner<T> owner;
    Pack<T> support, perH, peak, push, density, sound, viscosity, limiter, energy, pressure;
    Pack<T> beta, conductivity;
};

/// Replaces the position differences of coincident pairs by equation (6). Coincident pairs are rare and
/// processed lane by lane.
template <class T>
HWY_NOINLINE void partCoincident(const Owner<T>& owner, const uint32_t* ids, const uint32_t* entries,
                                 Pack<T> meanSupport, Pack<T> isCoincident, Pack<T>* d)
{
    alignas(64) T flag[kLanes], support[kLanes], part[3][kLanes], x[3][kLanes];
    isCoincident.store(flag);
    meanSupport.store(support);
    for (uint32_t a = 0; a < 3; ++a) {
        d[a].store(part[a]);
        owner.x[a].store(x[a]);
    }
    for (uint32_t k = 0; k < Pack<T>::kWidth; ++k) {
        if (flag[k] == T(0))
            continue;
        const uint32_t other = entries[k] & kPlaceMask;
        std::array<T, 3> direction{};
        if (entries[k] == other) {
            direction = ids ? partingDirection<T>(ids[owner.slot], ids[other])
                            : partingDirection<T>(owner.slot, other);
        } else {
            for (uint32_t a = 0; a < 3; ++a) // away from the walls
                if (entries[k] & (kMirrorX << a))
                    direction[a] = owner.wall[a] == owner.rules.images.low[a] ? T(1) : T(-1);
        }
        for (uint32_t a = 0; a < 3; ++a)
            part[a][k] = direction[a] * (T(kPartingDistance) * support[k]);
    }
    for (uint32_t a = 0; a < 3; ++a)
        d[a] = Pack<T>::load(part[a]);
}

/// Evaluates one vector of pairs. Every term is symmetric or antisymmetric in the two particles, bit for bit.
template <class T, class Shape>
HWY_INLINE uint32_t addPairs(const PairOwner<T, Shape>& i, const GasRecord<T>* records,
                             const uint32_t* entries, Pack<T>* sum)
{
    const typename Pack<T>::Tag tag;
    const Pack<T> one(1.0), half(0.5), none(0.0);
    const Entries<T> lanes(entries);
    const Quad<T> where = loadQuad(records, entries, 0);  // x, y, z, support
    const Quad<T> motion = loadQuad(records, entries, 1); // velocity, mass
    const Quad<T> gas = loadQuad(records, entries, 2);    // push, density, sound, viscosity
    const Quad<T> heat = loadQuad(records, entries, 3);   // limiter, energy, pressure, stepLevel
    const Pack<T> x[3] = {where.a, where.b, where.c};
    const Pack<T> v[3] = {motion.a, motion.b, motion.c};
    Relative<T> pair(i.owner, lanes, x, v);
    Pack<T>* d = pair.d;
    const Pack<T>* u = pair.u;
    Pack<T> square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];

    const auto isPadding = lanes.equal(i.owner.slot);
    const Pack<T> meanSupport = half * (i.support + where.d);
    const Pack<T> nothing = Pack<T>(kCoincident) * meanSupport;
    const auto isCoincident = hn::AndNot(isPadding, hn::Lt(square.v, (nothing * nothing).v));
    if (HWY_UNLIKELY(!hn::AllFalse(tag, isCoincident))) {
        partCoincident(i.owner, i.ids, entries, meanSupport, choose<T>(isCoincident, one, none), d);
        square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    }
    const Pack<T> r = root(square);
    const auto isNear = hn::AndNot(isPadding, hn::Lt(r.v, larger(i.support, where.d).v));

    const Pack<T> perH = one / where.d;
    const Pack<T> Fi = i.peak * Shape::template slope<Pack<T>>(smaller(r * i.perH, one));
    const Pack<T> Fj = i.peakSlope(perH) * Shape::template slope<Pack<T>>(smaller(r * perH, one));
    const Pack<T> F = half * (Fi + Fj);
    const Pack<T> vd = u[0] * d[0] + u[1] * d[1] + u[2] * d[2];
    const Pack<T> closing = choose<T>(hn::Lt(vd.v, none.v), vd, none);
    const Pack<T> mu = closing / larger(r, Pack<T>(1e-30)); // (1)
    const Pack<T> signal = (i.sound + gas.c) - i.beta * mu;
    const Pack<T> perDensity = one / (half * (i.density + gas.b));
    const Pack<T> nu =
        Pack<T>(-0.125) * ((i.viscosity + gas.d) * (i.limiter + heat.a)) * (mu * signal) * perDensity; // (2)
    const Pack<T> force = motion.d * ((i.push * Fi + gas.a * Fj) + nu * F);
    for (uint32_t a = 0; a < 3; ++a)
        sum[kSumAcceleration + a] += force * d[a]; // (3)
    const Pack<T> diffusion = root(magnitude(i.pressure - heat.c) * perDensity) * i.conductivity;
    const Pack<T> flow = (i.energy - heat.b) * (diffusion * (perDensity * r));
    sum[kSumHeating] += motion.d * (F * ((half * nu) * vd + flow)); // (4), (5)
    sum[kSumSignal] = larger(sum[kSumSignal], choose<T>(isNear, signal, none));
    sum[kSumLevel] = smaller(sum[kSumLevel], choose<T>(isNear, heat.d, Pack<T>(kNoLevel)));
    return uint32_t(hn::CountTrue(tag, isNear));
}

/// Adds a piece of a list, padded to a multiple of kLanes. Returns the number of neighbors within the larger
/// support.
template <class T, class Shape>
uint32_t addPiece(const PairOwner<T, Shape>& i, const GasRecord<T>* records, const uint32_t* entries,
                  uint32_t count, LaneSums<T, kForceSums>& sums)
{
    uint32_t pairs = 0;
    addVectors(
        entries, count, sums, [&](const uint32_t* at, Pack<T>* sum) HWY_ATTR __attribute__((always_inline)) {
            pairs += addPairs(i, records, at, sum);
        });
    return pairs;
}

} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
