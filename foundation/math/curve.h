/// @file curve.h
/// Curves over the lifetime of a particle, and ranges from which random values are drawn.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace fx::base {

constexpr size_t kCurveSamples = 64;

/// A key of a curve: the value at a time.
template <size_t N>
struct CurveKey
{
    float t; ///< [1] age divided by lifetime, 0..1
    std::array<float, N> value;
};

/// Piecewise linear curve over [0, 1], stored as 65 equally spaced samples, so that evaluation is one linear
/// interpolation. Near a key that falls between two samples the error is at most |slope change| / (8 * 64).
template <size_t N>
class Curve
{
public:
    Curve() { table_.fill({}); }
    /// A curve with the same value for all t.
    explicit Curve(const std::array<float, N>& constant) { table_.fill(constant); }
    /// Makes a curve from keys.
    /// @param keys sorted by t, at least one, all finite; two keys of equal t make a jump to the value of the
    ///         later key
    explicit Curve(std::span<const CurveKey<N>> keys);

    /// Value at t; t outside [0, 1] (NaN included) is clamped.
    std::array<float, N> at(float t) const
    {
        const float s = (t > 0.0f ? (t < 1.0f ? t : 1.0f) : 0.0f) * float(kCurveSamples);
        const size_t i = s < float(kCurveSamples) ? size_t(s) : kCurveSamples - 1;
        const float f = s - float(i);
        std::array<float, N> value;
        for (size_t k = 0; k < N; ++k)
            value[k] = table_[i][k] + f * (table_[i + 1][k] - table_[i][k]);
        return value;
    }

private:
    std::array<std::array<float, N>, kCurveSamples + 1> table_;
};

extern template class Curve<1>;
extern template class Curve<3>;

using ScalarCurve = Curve<1>;
using ColorCurve = Curve<3>;

/// A constant, or a range from which each particle draws a random value.
struct Range
{
    float min = 0;
    float max = 0;

    float at(float u) const { return min + (max - min) * u; } ///< @param u random number in [0, 1)
};

} // namespace fx::base
