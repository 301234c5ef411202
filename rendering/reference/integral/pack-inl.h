/// @file pack-inl.h
/// The operations of lane_numbers.h for SIMD vectors with one ray in each lane. This file is included once
/// for each instruction set.
#if defined(FX_INTEGRAL_PACK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_INTEGRAL_PACK_INL
#undef FX_INTEGRAL_PACK_INL
#else
#define FX_INTEGRAL_PACK_INL
#endif

#include "foundation/simd/pack-inl.h"
#include "rendering/reference/integral/lane_numbers.h"
#include "rendering/reference/integral/ray_packet.h"

#include <hwy/highway.h>

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace fx::render::integral::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Pack = base::HWY_NAMESPACE::Pack<T, kPacketRays>;

template <class V>
struct Lanes;

template <class T>
struct Lanes<Pack<T>>
{
    using Scalar = T;
    static constexpr uint32_t kWidth = Pack<T>::kWidth;
    static HWY_INLINE Pack<T> load(const T* from) { return Pack<T>::load(from); }
    static HWY_INLINE void store(T* to, Pack<T> x) { x.store(to); }
    static HWY_INLINE Pack<T> all(T x) { return Pack<T>(x); }
};

template <class T>
HWY_INLINE Pack<T> chooseLess(Pack<T> a, Pack<T> b, Pack<T> yes, Pack<T> no)
{
    return Pack<T>(hn::IfThenElse(hn::Lt(a.v, b.v), yes.v, no.v));
}
/// Minimum and maximum, with the same comparison as the scalar code, so that zeros of different sign give the
/// same result.
template <class T>
HWY_INLINE Pack<T> larger(Pack<T> a, Pack<T> b)
{
    return chooseLess(a, b, b, a);
}
template <class T>
HWY_INLINE Pack<T> smaller(Pack<T> a, Pack<T> b)
{
    return chooseLess(b, a, b, a);
}
template <class T>
HWY_INLINE Pack<T> minOf(Pack<T> a, Pack<T> b)
{
    return Pack<T>(hn::Min(a.v, b.v));
}
template <class T>
HWY_INLINE Pack<T> maxOf(Pack<T> a, Pack<T> b)
{
    return Pack<T>(hn::Max(a.v, b.v));
}
template <class T>
HWY_INLINE bool anyLess(Pack<T> a, Pack<T> b)
{
    return !hn::AllFalse(typename Pack<T>::Tag(), hn::Lt(a.v, b.v));
}
template <class T>
HWY_INLINE uint32_t countLess(Pack<T> a, Pack<T> b)
{
    return uint32_t(hn::CountTrue(typename Pack<T>::Tag(), hn::Lt(a.v, b.v)));
}
/// A mask as bits: bit i is set if a < b in lane i.
template <class T>
HWY_INLINE uint64_t bitsLess(Pack<T> a, Pack<T> b)
{
    uint64_t bits = 0;
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(typename Pack<T>::Tag(), hn::Lt(a.v, b.v), bytes);
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
}
template <class T>
HWY_INLINE T lowest(Pack<T> a)
{
    return hn::GetLane(hn::MinOfLanes(typename Pack<T>::Tag(), a.v));
}
template <class T>
HWY_INLINE T highest(Pack<T> a)
{
    return hn::GetLane(hn::MaxOfLanes(typename Pack<T>::Tag(), a.v));
}
#if HWY_TARGET != HWY_SCALAR
/// Minimum or maximum of each pair of neighboring lanes. The lower half of the result has the values of `a`,
/// the upper half the values of `b`.
template <bool kLowest, class T>
HWY_INLINE Pack<T> foldLanes(Pack<T> a, Pack<T> b)
{
    const typename Pack<T>::Tag tag;
    const Pack<T> even(hn::ConcatEven(tag, b.v, a.v));
    const Pack<T> odd(hn::ConcatOdd(tag, b.v, a.v));
    return kLowest ? minOf(even, odd) : maxOf(even, odd);
}
/// Number of vectors that foldRows() reduces at once. foldRows() computes lowest() or highest() of each of
/// `count` vectors, which are `stride` numbers apart. foldRows() may read kFoldedRows - 1 vectors past the
/// last input vector, and may write one vector past the last result.
constexpr uint32_t kFoldedRows = 8;
template <class V, bool kLowest, class T>
HWY_INLINE void foldRows(const T* rows, size_t stride, uint32_t count, T* out)
{
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    constexpr uint32_t kRows = kWidth < kFoldedRows ? kWidth : kFoldedRows;
    for (uint32_t begin = 0; begin < count; begin += kRows) {
        V row[kRows];
        for (uint32_t i = 0; i < kRows; ++i)
            row[i] = Lanes<V>::load(rows + (begin + i) * stride);
        for (uint32_t n = kRows / 2; n > 0; n /= 2)
            for (uint32_t i = 0; i < n; ++i)
                row[i] = foldLanes<kLowest>(row[2 * i], row[2 * i + 1]);
        for (uint32_t n = kWidth / kRows; n > 1; n /= 2)
            row[0] = foldLanes<kLowest>(row[0], row[0]);
        Lanes<V>::store(out + begin, row[0]);
    }
}
#endif
template <class T>
HWY_INLINE Pack<T> wholeAbove(Pack<T> a)
{
    const Pack<T> big = Lanes<Pack<T>>::all(ExpConstants<T>::kRound);
    const Pack<T> whole = (a + big) - big;
    return chooseLess(whole, a, whole + Lanes<Pack<T>>::all(T(1)), whole);
}

/// e^r by equation (3) of formula attenuation-exponential.
template <class T>
HWY_INLINE Pack<T> expSeries(Pack<T> r)
{
    using C = ExpConstants<T>;
    Pack<T> sum = Lanes<Pack<T>>::all(kPerFactorial<T>[C::kTerms]);
    for (int k = C::kTerms - 1; k >= 0; --k)
        sum = sum * r + Lanes<Pack<T>>::all(kPerFactorial<T>[k]);
    return sum;
}
/// The exponential e^-x of formula attenuation-exponential, with the same operations as the scalar code.
template <class T>
HWY_INLINE Pack<T> expOfMinus(Pack<T> x)
{
    using C = ExpConstants<T>;
    const typename Pack<T>::Tag tag;
    const hn::RebindToSigned<typename Pack<T>::Tag> bits;
    const auto all = [](T c) HWY_ATTR { return Lanes<Pack<T>>::all(c); };
    const Pack<T> y = all(T(0)) - larger(smaller(all(C::kLargest), x), all(C::kMin));
    const Pack<T> shifted = y * all(C::kPerLn2) + all(C::kRound);
    const Pack<T> n = shifted - all(C::kRound);
    const Pack<T> r = (y - n * all(C::kLn2High)) - n * all(C::kLn2Low);           // (1)
    const Pack<T> sum = expSeries(r);                                             // (3)
    const auto power = hn::ShiftLeft<C::kMantissa>(hn::BitCast(bits, shifted.v)); // (4)
    return Pack<T>(hn::BitCast(tag, hn::Add(hn::BitCast(bits, sum.v), power)));   // (2)
}
/// expOfMinus() for small arguments, without range reduction.
template <class T>
HWY_INLINE Pack<T> expOfSmall(Pack<T> x)
{
    return expSeries(Lanes<Pack<T>>::all(T(0)) - x);
}

} // namespace fx::render::integral::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
