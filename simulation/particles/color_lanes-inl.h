/// @file color_lanes-inl.h
/// Converts four floats per particle to four binary16 values in 64 bits. The file is included once for each
/// instruction set.
///
/// @formula half-floats
/// Converts a float in [0, 65504] to binary16, to nearest, ties to even, as the conversion instruction does.
///
/// symbol   unit   meaning
///   b       1      bit pattern of the float
///   h       1      bit pattern of the binary16
/// @derivation
///   For normal results the exponent bias is changed and the mantissa is rounded by 13 bits:
///       h = (b - (112 << 23) + 0xFFF + ((b >> 13) & 1)) >> 13                               (1)
///   Below 2^-14, adding 1/2 rounds to a multiple of 2^-24, and the result is in the low bits:
///       h = bits(x + 1/2) - bits(1/2)                                                        (2)
/// @source    elementary
/// @deviation none
/// @valid     other values are clamped to the interval; NaN becomes 0
/// @accuracy  correctly rounded; equal bits with and without the instruction
/// @tests     tests/simulation/particles/core/test_appearance_kernel.cpp
#if defined(FX_PARTICLE_COLOR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PARTICLE_COLOR_LANES_INL
#undef FX_PARTICLE_COLOR_LANES_INL
#else
#define FX_PARTICLE_COLOR_LANES_INL
#endif

#include "simulation/motion/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
using WideTag = hn::CappedTag<uint64_t, 1>;
#else
using WideTag = hn::RepartitionToWide<WordTag>;
#endif
constexpr WideTag kWides;

HWY_INLINE Floats boundedForHalf(Floats x)
{
    return hn::Min(hn::Max(x, hn::Zero(kFloats)), all(65504.0f));
}

#if HWY_TARGET > HWY_AVX3
/// Converts each lane to binary16, in the low half of a word.
HWY_INLINE Words halfWords(Floats bounded)
{
#if HWY_TARGET <= HWY_AVX2
    const hn::Rebind<hwy::float16_t, FloatTag> halves;
    const hn::Rebind<uint16_t, FloatTag> shorts;
    return hn::PromoteTo(kWords, hn::BitCast(shorts, hn::DemoteTo(halves, bounded)));
#else
    const Words bits = hn::BitCast(kWords, bounded);
    const Words even = hn::And(hn::ShiftRight<13>(bits), hn::Set(kWords, 1u));
    const Words normal = hn::ShiftRight<13>(
        hn::Add(hn::Add(hn::Sub(bits, hn::Set(kWords, 112u << 23)), hn::Set(kWords, 0xFFFu)), even));   // (1)
    const Words small = hn::Sub(hn::BitCast(kWords, bounded + all(0.5f)), hn::Set(kWords, 126u << 23)); // (2)
    return hn::IfThenElse(hn::RebindMask(kWords, hn::Lt(bounded, all(0x1p-14f))), small, normal);
#endif
}
#endif

/// The colors of kWidth particles. With one lane, `low` contains all four values.
struct ColorLanes
{
    hn::Vec<WideTag> low;
    hn::Vec<WideTag> high;
};

/// Converts red, green, blue and opacity, which must be bounded.
HWY_INLINE ColorLanes packColor(const Floats* rgb, Floats opacity)
{
#if HWY_TARGET <= HWY_AVX3
    constexpr int kNearest = _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC;
    const auto pair = [](Floats first, Floats second) HWY_ATTR {
        const __m512i lower = _mm512_castsi256_si512(_mm512_cvtps_ph(first.raw, kNearest));
        return _mm512_inserti64x4(lower, _mm512_cvtps_ph(second.raw, kNearest), 1);
    };
    const __m512i redBlue = pair(rgb[0], rgb[2]);
    const __m512i greenOpacity = pair(rgb[1], opacity);
    // Words of two channels. `first` has the particles 0..3 and 8..11, the second vector has 4..7 and 12..15.
    const __m512i first = _mm512_unpacklo_epi16(redBlue, greenOpacity);
    const __m512i second = _mm512_unpackhi_epi16(redBlue, greenOpacity);
    const __m512i low = _mm512_setr_epi32(0, 8, 1, 9, 2, 10, 3, 11, 16, 24, 17, 25, 18, 26, 19, 27);
    const __m512i high = _mm512_setr_epi32(4, 12, 5, 13, 6, 14, 7, 15, 20, 28, 21, 29, 22, 30, 23, 31);
    return {hn::Vec<WideTag>{_mm512_permutex2var_epi32(first, low, second)},
            hn::Vec<WideTag>{_mm512_permutex2var_epi32(first, high, second)}};
#else
    const Words redGreen = hn::Or(halfWords(rgb[0]), hn::ShiftLeft<16>(halfWords(rgb[1])));
    const Words blueOpacity = hn::Or(halfWords(rgb[2]), hn::ShiftLeft<16>(halfWords(opacity)));
#if HWY_TARGET == HWY_SCALAR
    const auto color =
        hn::Set(kWides, uint64_t(hn::GetLane(redGreen)) | uint64_t(hn::GetLane(blueOpacity)) << 32);
    return {color, color};
#else
    const hn::Half<WordTag> half;
    const auto join = [&](auto rg, auto ba) HWY_ATTR {
        return hn::Or(hn::PromoteTo(kWides, rg), hn::ShiftLeft<32>(hn::PromoteTo(kWides, ba)));
    };
    return {join(hn::LowerHalf(half, redGreen), hn::LowerHalf(half, blueOpacity)),
            join(hn::UpperHalf(half, redGreen), hn::UpperHalf(half, blueOpacity))};
#endif
#endif
}

} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
