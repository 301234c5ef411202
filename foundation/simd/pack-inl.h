/// @file pack-inl.h
/// SIMD vectors with arithmetic operators for formulas. This file is included once for each instruction set.
#if defined(FX_PACK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PACK_INL
#undef FX_PACK_INL
#else
#define FX_PACK_INL
#endif

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace fx::base::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A vector with as many lanes as the instruction set has, at most kMax. Operators do not fuse multiplication
/// with addition, and do not approximate.
template <class T, uint32_t kMax>
struct Pack
{
    using Tag = hn::CappedTag<T, kMax>;
    using Vector = hn::Vec<Tag>;
    using Mask = hn::Mask<Tag>;
    static constexpr uint32_t kWidth = HWY_LANES(T) < kMax ? uint32_t(HWY_LANES(T)) : kMax;

    Vector v;

    Pack() = default; // trivial, so that structs of packs are trivial too
    HWY_INLINE explicit Pack(Vector vector) : v(vector) {}
    HWY_INLINE explicit Pack(double x) : v(hn::Set(Tag(), static_cast<T>(x))) {}
    HWY_INLINE explicit Pack(float x) : v(hn::Set(Tag(), static_cast<T>(x))) {}
    static HWY_INLINE Pack load(const T* from) { return Pack(hn::LoadU(Tag(), from)); }
    HWY_INLINE void store(T* to) const { hn::StoreU(v, Tag(), to); }
};

template <class T, uint32_t N>
HWY_INLINE Pack<T, N> operator+(Pack<T, N> a, Pack<T, N> b)
{
    return Pack<T, N>(hn::Add(a.v, b.v));
}
template <class T, uint32_t N>
HWY_INLINE Pack<T, N> operator-(Pack<T, N> a, Pack<T, N> b)
{
    return Pack<T, N>(hn::Sub(a.v, b.v));
}
template <class T, uint32_t N>
HWY_INLINE Pack<T, N> operator*(Pack<T, N> a, Pack<T, N> b)
{
    return Pack<T, N>(hn::Mul(a.v, b.v));
}
template <class T, uint32_t N>
HWY_INLINE Pack<T, N> operator/(Pack<T, N> a, Pack<T, N> b)
{
    return Pack<T, N>(hn::Div(a.v, b.v));
}
template <class T, uint32_t N>
HWY_INLINE Pack<T, N>& operator+=(Pack<T, N>& a, Pack<T, N> b)
{
    return a = a + b;
}
template <class T, uint32_t N>
HWY_INLINE Pack<T, N> root(Pack<T, N> a)
{
    return Pack<T, N>(hn::Sqrt(a.v));
}

} // namespace fx::base::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
