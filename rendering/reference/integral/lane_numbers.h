/// @file lane_numbers.h
/// The arithmetic operations of the integral for scalars. The file pack-inl.h has the same operations for
/// SIMD vectors.
///
/// The code of the integral (*.inl) consists of templates of a number type V: float, double, __float128, or a
/// SIMD vector with one ray in each lane. All operations work on each lane separately and are not fused.
/// Therefore each lane has the same bits as the scalar code.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace fx::render::integral {

/// Functions of the scalar type T. A specialization for a type other than float and double must also define
/// expOfMinus(x).
template <class T>
struct Real
{
    static constexpr int kDigits = std::numeric_limits<T>::digits;
    static T root(T x) { return std::sqrt(x); }
};

/// Constants of expOfMinus.
template <class T>
struct ExpConstants;

template <>
struct ExpConstants<float>
{
    using Bits = int32_t;
    static constexpr float kLargest = 87.0f;
    static constexpr float kMin = -80.0f;
    static constexpr float kPerLn2 = 1.44269504f;
    static constexpr float kLn2High = 0.693359375f; // 9 bits, so that its product with n is exact
    static constexpr float kLn2Low = -2.12194440e-4f;
    static constexpr float kRound = 12582912.0f; // 1.5 2^23: the low bits of kRound + n are n
    static constexpr int kMantissa = 23;
    static constexpr int kTerms = 7;
};

template <>
struct ExpConstants<double>
{
    using Bits = int64_t;
    static constexpr double kLargest = 708.0;
    static constexpr double kMin = -700.0;
    static constexpr double kPerLn2 = 1.4426950408889634;
    static constexpr double kLn2High = 6.93147180369123816490e-01;
    static constexpr double kLn2Low = 1.90821492927058770002e-10;
    static constexpr double kRound = 6755399441055744.0; // 1.5 2^52
    static constexpr int kMantissa = 52;
    static constexpr int kTerms = 13;
};

/// expOfMinus() needs no range reduction for arguments below this constant.
constexpr float kSmallDepth = 0.34f;

/// Table of 1 / k! for k = 0..13, computed in double and rounded to T.
template <class T>
inline constexpr auto kPerFactorial = [] {
    std::array<T, 14> table{};
    double factorial = 1.0; // exact up to 18!
    for (int k = 0; k < 14; ++k) {
        factorial *= k > 0 ? k : 1;
        table[k] = static_cast<T>(1.0 / factorial);
    }
    return table;
}();

/// e^r by equation (3) of formula attenuation-exponential.
template <class T>
inline T expSeries(T r)
{
    T sum = kPerFactorial<T>[ExpConstants<T>::kTerms];
    for (int k = ExpConstants<T>::kTerms - 1; k >= 0; --k)
        sum = sum * r + kPerFactorial<T>[k];
    return sum;
}

/// @formula attenuation-exponential
/// e^-x for optical depths, the same bits in a scalar and in every lane of a vector.
///
/// symbol   unit   meaning
///   x       1      optical depth; limited to 87 (float) or 708 (double)
///   n       1      nearest integer to -x / ln 2
///   r       1      remainder, |r| <= ln(2)/2
/// @derivation
///   -x = n ln 2 + r, ln 2 in two pieces so that n times the first is exact     (1)
///   e^-x = 2^n e^r                                                              (2)
///   e^r = sum r^k / k!, k = 0..7 in float (next term 5e-9), 0..13 in double     (3)
///   With m bits of mantissa, the low bits of -x / ln 2 + 1.5 2^m are n. Shifted left by m and added to the
///   bits of e^r, they increase its exponent by n                                      (4)
/// @source    [MUL16] section 11 for the reduction; the series is elementary
/// @deviation none
/// @valid     x = 0 gives exactly 1; x below -80 (float) or -700 (double) is set to this limit;
///            for |x| < 0.34, n is 0, so that (3) alone gives the same bits
/// @accuracy  relative error <= 2e-7 (float), 1e-15 (double)
/// @tests     tests/rendering/reference/integral/test_lane_numbers.cpp
template <class T>
inline T expOfMinus(T x)
{
    if constexpr (!std::is_same_v<T, float> && !std::is_same_v<T, double>) {
        return Real<T>::expOfMinus(x);
    } else {
        using C = ExpConstants<T>;
        const T most = x < C::kLargest ? x : C::kLargest;
        const T y = T(0) - (most < C::kMin ? C::kMin : most);
        const T shifted = y * C::kPerLn2 + C::kRound;
        const T n = shifted - C::kRound;
        const T r = (y - n * C::kLn2High) - n * C::kLn2Low; // (1)
        const T sum = expSeries(r);                         // (3)
        using Unsigned = std::make_unsigned_t<typename C::Bits>;
        const Unsigned power = std::bit_cast<Unsigned>(shifted) << C::kMantissa; // (4)
        return std::bit_cast<T>(std::bit_cast<Unsigned>(sum) + power);           // (2)
    }
}

/// Access to the scalars in a number of type V.
template <class V>
struct Lanes
{
    using Scalar = V;
    static constexpr uint32_t kWidth = 1;
    static V load(const V* from) { return *from; }
    static void store(V* to, V x) { *to = x; }
    static V all(V x) { return x; }
};

template <class V>
inline V larger(V a, V b)
{
    return a < b ? b : a;
}
template <class V>
inline V smaller(V a, V b)
{
    return b < a ? b : a;
}
/// Minimum and maximum, for sorting. For zeros of different sign, the sign of the result is unspecified.
template <class V>
inline V minOf(V a, V b)
{
    return smaller(a, b);
}
template <class V>
inline V maxOf(V a, V b)
{
    return larger(a, b);
}
template <class V>
inline V root(V a)
{
    return Real<V>::root(a);
}
/// Returns `yes` in lanes with a < b, and `no` in all other lanes.
template <class V>
inline V chooseLess(V a, V b, V yes, V no)
{
    return a < b ? yes : no;
}
template <class V>
inline bool anyLess(V a, V b)
{
    return a < b;
}
template <class V>
inline uint32_t countLess(V a, V b)
{
    return a < b ? 1 : 0;
}
template <class V>
inline uint64_t bitsLess(V a, V b)
{
    return a < b ? 1 : 0;
}
/// Number of vectors that foldRows() reduces at once.
constexpr uint32_t kFoldedRows = 1;
template <class V, bool kLowest>
inline void foldRows(const V* rows, size_t stride, uint32_t count, V* out)
{
    for (uint32_t i = 0; i < count; ++i)
        out[i] = rows[i * stride];
}
template <class V>
inline V lowest(V a)
{
    return a;
}
template <class V>
inline V highest(V a)
{
    return a;
}
/// Computes e^-x for |x| < kSmallDepth, with the same bits as expOfMinus().
template <class V>
inline V expOfSmall(V x)
{
    return expOfMinus(x);
}

/// The smallest integer >= a, for 0 <= a <= 2^20.
template <class V>
inline V wholeAbove(V a)
{
    const V whole = static_cast<V>(static_cast<int32_t>(a));
    return whole < a ? whole + V(1) : whole;
}

} // namespace fx::render::integral
