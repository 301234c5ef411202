/// @file lanes-inl.h
/// Arithmetic on vectors of any width, and sums whose bits do not depend on the vector width. The file is
/// included once for each instruction set.
///
/// Every sum over neighbors has kLanes = 16 virtual lanes: lane k sums the list entries 16 m + k. Narrow
/// instruction sets process a few of these lanes at a time. The 16 partial results are added in the same
/// order for every instruction set.
#if defined(FX_PAIR_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PAIR_LANES_INL
#undef FX_PAIR_LANES_INL
#else
#define FX_PAIR_LANES_INL
#endif

#include "foundation/simd/pack-inl.h"
#include "simulation/sph/neighbors/neighbor_lists.h"
#include "simulation/sph/pair_loops/sph_kernel.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::pairs::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Pack = base::HWY_NAMESPACE::Pack<T, kLanes>;

template <class T>
HWY_INLINE Pack<T> larger(Pack<T> a, Pack<T> b)
{
    return Pack<T>(hn::Max(a.v, b.v));
}
template <class T>
HWY_INLINE Pack<T> smaller(Pack<T> a, Pack<T> b)
{
    return Pack<T>(hn::Min(a.v, b.v));
}
template <class T>
HWY_INLINE Pack<T> magnitude(Pack<T> a)
{
    return Pack<T>(hn::Abs(a.v));
}
template <class T>
HWY_INLINE Pack<T> choose(typename Pack<T>::Mask mask, Pack<T> yes, Pack<T> no)
{
    return Pack<T>(hn::IfThenElse(mask, yes.v, no.v));
}

/// The nearest integer, ties to even, for |a| < 2^22 (float) or 2^51 (double). The function uses the rounding
/// of an addition, which is the same on every processor.
template <class T>
HWY_INLINE Pack<T> nearestInteger(Pack<T> a)
{
    const Pack<T> big(sizeof(T) == 4 ? 12582912.0 : 6755399441055744.0); // 1.5 times 2^23 and 2^52
    return (a + big) - big;
}

/// Scalar versions of functions that kernel_shapes.inl uses.
HWY_INLINE float larger(float a, float b)
{
    return a > b ? a : b;
}
HWY_INLINE double larger(double a, double b)
{
    return a > b ? a : b;
}

#include "simulation/sph/pair_loops/kernel_shapes.inl"

/// Partial results of Q sums, each in 16 virtual lanes.
template <class T, uint32_t Q>
struct alignas(64) LaneSums
{
    T lane[Q][kLanes];

    void clear()
    {
        for (auto& row : lane)
            for (T& x : row)
                x = T(0);
    }
};

/// Accumulates f(entries, sum) over all vectors of a list that is padded to a multiple of kLanes.
/// always_inline keeps the sums in registers.
template <class T, uint32_t Q, class F>
HWY_INLINE void addVectors(const uint32_t* entries, uint32_t count, LaneSums<T, Q>& sums, F f)
{
    for (uint32_t p = 0; p < kLanes; p += Pack<T>::kWidth) {
        Pack<T> sum[Q];
        for (uint32_t s = 0; s < Q; ++s)
            sum[s] = Pack<T>::load(sums.lane[s] + p);
        for (uint32_t k = 0; k < count; k += kLanes)
            f(entries + k + p, sum);
        for (uint32_t s = 0; s < Q; ++s)
            sum[s].store(sums.lane[s] + p);
    }
}

struct Adding
{
    template <class D, class V>
    HWY_INLINE V operator()(D, V a, V b) const
    {
        return hn::Add(a, b);
    }
};
struct TakingLarger
{
    template <class D, class V>
    HWY_INLINE V operator()(D, V a, V b) const
    {
        return hn::Max(a, b);
    }
};
struct TakingSmaller
{
    template <class D, class V>
    HWY_INLINE V operator()(D, V a, V b) const
    {
        return hn::Min(a, b);
    }
};

/// One level of the reduction: combines lane k with lane k + Half.
template <uint32_t Half, class F, class T>
HWY_INLINE void halve(const T* lane, T* out, F f)
{
    const hn::CappedTag<T, Half> tag;
    constexpr uint32_t kWidth = uint32_t(hn::MaxLanes(hn::CappedTag<T, Half>()));
    for (uint32_t k = 0; k < Half; k += kWidth)
        hn::StoreU(f(tag, hn::LoadU(tag, lane + k), hn::LoadU(tag, lane + Half + k)), tag, out + k);
}

/// Combines the 16 lanes of rows [first, first + Rows): ((0+8)+(4+12))+((2+10)+(6+14)), plus the same
/// expression for the odd lanes. Each level is computed for all rows before the next level, to shorten
/// dependency chains.
template <uint32_t Rows, class F, class T, uint32_t Q>
HWY_INLINE void combineRows(const LaneSums<T, Q>& sums, uint32_t first, T* out, F f)
{
    alignas(64) T part[Rows][8];
    for (uint32_t s = 0; s < Rows; ++s)
        halve<8>(sums.lane[first + s], part[s], f);
    for (uint32_t s = 0; s < Rows; ++s)
        halve<4>(part[s], part[s], f);
    for (uint32_t s = 0; s < Rows; ++s)
        halve<2>(part[s], part[s], f);
    for (uint32_t s = 0; s < Rows; ++s)
        halve<1>(part[s], out + s, f);
}

} // namespace fx::sim::pairs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
