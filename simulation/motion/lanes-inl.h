/// @file lanes-inl.h
/// Elementary functions on vectors of particles. The file is included once for each instruction set. All
/// instruction sets give the same bits, because every operation is correctly rounded and the order of
/// operations is fixed.
///
/// @formula drag-coefficients
/// The coefficients of linear-drag-step in single precision, lane by lane.
///
/// symbol   unit   meaning
///   k, t, E, G, R   as in linear-drag-step
///   z       1      k t
///   q       1      R / t^2
/// @derivation
///   q = 1/2! - z/3! + z^2/4! - ... . For z < 2, q is replaced by the polynomial of degree 7 that equals q at
///   the 8 Chebyshev nodes of [0, 2]. With rounded coefficients its error is at most 4e-8 of q           (1)
///   R = q t^2, G = t - k R, and for z < 1 E = 1 - k G, from the definitions of G and E             (2)
///   For larger z: E = exp(-z), G = (1 - E) / k, R = (t - G) / k                                    (3)
///   exp(-z) = 2^-n exp(-r), with z = n ln 2 + r, where ln 2 is split into two constants. exp(-r) is its
///   Taylor polynomial to r^7                                                                       (4)
/// @source    elementary
/// @deviation none
/// @valid     0 <= k <= 1e6, 0 <= t <= 1e9; z > 87 is taken as 87, where E is 1.6e-38
/// @accuracy  relative error <= 1e-6 (G, R), <= 5e-7 + 6e-8 z (E)
/// @tests     tests/simulation/particles/core/test_ballistic_motion.cpp
#if defined(FX_PARTICLE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PARTICLE_LANES_INL
#undef FX_PARTICLE_LANES_INL
#else
#define FX_PARTICLE_LANES_INL
#endif

#include "foundation/time/ticks.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The vector width of the processor, limited to 16 lanes, the padding of tiles.
using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::Rebind<int32_t, FloatTag>;
using WordTag = hn::Rebind<uint32_t, FloatTag>;
using Floats = hn::Vec<FloatTag>;
using Words = hn::Vec<WordTag>;
using Which = hn::Mask<FloatTag>;

constexpr FloatTag kFloats;
constexpr IntTag kInts;
constexpr WordTag kWords;
constexpr uint32_t kWidth = uint32_t(hn::MaxLanes(FloatTag())); // known when compiled on all of ours

HWY_INLINE Floats all(float x)
{
    return hn::Set(kFloats, x);
}

/// Effect of drag and acceleration over a time, see linear-drag-step.
struct DragLanes
{
    Floats decay; ///< [1] decay E
    Floats gain;  ///< [s] gain G
    Floats ramp;  ///< [s2] ramp R
};

/// e^-z for z >= 0.
HWY_INLINE Floats expMinus(Floats z)
{
    const Floats bounded = hn::Min(z, all(87.0f));
    const Floats n = (bounded * all(1.44269504f) + all(12582912.0f)) - all(12582912.0f); // nearest integer
    const Floats r = (n * all(0.693359375f) - bounded) - n * all(2.12194440e-4f); // (4), -r of the text
    const Floats r2 = r * r;
    const Floats p0 = all(1.0f) + r;
    const Floats p1 = all(0.5f) + all(1.0f / 6.0f) * r;
    const Floats p2 = all(1.0f / 24.0f) + all(1.0f / 120.0f) * r;
    const Floats p3 = all(1.0f / 720.0f) + all(1.0f / 5040.0f) * r;
    const Floats sum = (p0 + r2 * p1) + (r2 * r2) * (p2 + r2 * p3);
    const auto exponent = hn::ShiftLeft<23>(hn::Sub(hn::Set(kInts, 127), hn::ConvertTo(kInts, n)));
    return sum * hn::BitCast(kFloats, exponent);
}

/// Coefficients of linear-drag-step for the drag rate k and the time t.
/// @param perK 1 / k, where k > 0
/// @tparam kDecay true: computes `decay`. The bits of `gain` and `ramp` do not depend on kDecay
template <bool kDecay>
HWY_INLINE DragLanes dragLanes(Floats k, Floats perK, Floats t)
{
    const Floats z = k * t;
    const Floats z2 = z * z;
    const Floats z4 = z2 * z2;
    // (1) in pairs, which shortens the dependency chain.
    const Floats p0 = all(0.5f) - all(0.166666597f) * z;
    const Floats p1 = all(0.0416659452f) - all(0.00833040196f) * z;
    const Floats p2 = all(0.00138298643f) - all(0.000191851024f) * z;
    const Floats p3 = all(2.06316363e-05f) - all(1.26966074e-06f) * z;
    const Floats q = (p0 + z2 * p1) + z4 * (p2 + z2 * p3);
    const Floats ramp = q * (t * t); // (2)
    const Floats gain = t - k * ramp;
    const Floats decay = kDecay ? all(1.0f) - k * gain : ramp;
    if (HWY_LIKELY(hn::AllTrue(kFloats, hn::Lt(z, all(kDecay ? 1.0f : 2.0f)))))
        return {decay, gain, ramp};
    const Floats e = expMinus(z); // (3)
    const Floats g = (all(1.0f) - e) * perK;
    const Floats r = (t - g) * perK;
    const Which strong = hn::Ge(z, all(2.0f));
    return {hn::IfThenElse(hn::Ge(z, all(1.0f)), e, decay), hn::IfThenElse(strong, g, gain),
            hn::IfThenElse(strong, r, ramp)};
}

/// [s] Time between two local times that differ by `ticks`.
HWY_INLINE Floats secondsOf(const int64_t* HWY_RESTRICT born, int64_t now)
{
#if HWY_TARGET == HWY_SCALAR
    return all(float(double(now - *born) * (1.0 / double(base::kTicksPerSecond))));
#else
    const hn::Half<FloatTag> half;
    const hn::Rebind<double, decltype(half)> doubles;
    const hn::Rebind<int64_t, decltype(half)> longs;
    const auto end = hn::Set(longs, now);
    const auto unit = hn::Set(doubles, 1.0 / double(base::kTicksPerSecond));
    const auto low = hn::ConvertTo(doubles, hn::Sub(end, hn::LoadU(longs, born)));
    const auto high = hn::ConvertTo(doubles, hn::Sub(end, hn::LoadU(longs, born + hn::Lanes(longs))));
    return hn::Combine(kFloats, hn::DemoteTo(half, hn::Mul(high, unit)),
                       hn::DemoteTo(half, hn::Mul(low, unit)));
#endif
}

/// [s] Time between two local times, from the low 32 bits of the times, for differences below 2^32 ticks.
HWY_INLINE Floats secondsOf(const uint32_t* HWY_RESTRICT born, uint32_t now)
{
    const Words ticks = hn::Sub(hn::Set(kWords, now), hn::LoadU(kWords, born));
#if HWY_TARGET <= HWY_AVX3 // has the conversion, which rounds once too
    return Floats{_mm512_cvtepu32_ps(ticks.raw)} * all(float(1.0 / double(base::kTicksPerSecond)));
#else
    // In two halves of 16 bits, both exact, rounded once by the sum.
    const Floats high = hn::ConvertTo(kFloats, hn::BitCast(kInts, hn::ShiftRight<16>(ticks)));
    const Floats low = hn::ConvertTo(kFloats, hn::BitCast(kInts, hn::And(ticks, hn::Set(kWords, 0xFFFFu))));
    return (high * all(65536.0f) + low) * all(float(1.0 / double(base::kTicksPerSecond)));
#endif
}

/// Random numbers in [0, 1), with the same bits as base::toUnitFloat.
HWY_INLINE Floats unitFloats(Words words)
{
    return hn::ConvertTo(kFloats, hn::BitCast(kInts, hn::ShiftRight<8>(words))) * all(0x1.0p-24f);
}

/// Sine and cosine of `t` [turns], |t| < 2^20, by formula sine-cosine-of-turns. The absolute error is at most
/// 2e-7.
struct SinCosLanes
{
    Floats sin;
    Floats cos;
};
HWY_INLINE SinCosLanes sinCosTurns(Floats t)
{
    const Floats q = (t * all(4.0f) + all(12582912.0f)) - all(12582912.0f); // nearest quarter
    const Floats a = (t - q * all(0.25f)) * all(6.28318531f);
    const Floats z = a * a;
    Floats s = all(-1.0f / 5040.0f);
    s = s * z + all(1.0f / 120.0f);
    s = s * z - all(1.0f / 6.0f);
    s = a + a * z * s;
    Floats c = all(1.0f / 40320.0f);
    c = c * z - all(1.0f / 720.0f);
    c = c * z + all(1.0f / 24.0f);
    c = c * z - all(0.5f);
    c = c * z + all(1.0f);
    const auto quarter = hn::ConvertTo(kInts, q);
    const auto one = hn::Set(kInts, 1);
    const auto odd = hn::RebindMask(kFloats, hn::Eq(hn::And(quarter, one), one));
    const auto sinSign = hn::ShiftLeft<30>(hn::And(quarter, hn::Set(kInts, 2)));
    const auto cosSign = hn::ShiftLeft<30>(hn::And(hn::Add(quarter, one), hn::Set(kInts, 2)));
    return {hn::Xor(hn::IfThenElse(odd, c, s), hn::BitCast(kFloats, sinSign)),
            hn::Xor(hn::IfThenElse(odd, s, c), hn::BitCast(kFloats, cosSign))};
}

} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
