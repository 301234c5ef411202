/// @file ramp_curves.h
/// Several curves over the same parameter, compiled for evaluation in vectors.
///
/// @formula ramp-curves
/// A piecewise linear function as a sum of ramps.
///
/// symbol   unit   meaning
///   t       1      parameter, 0..1
///   t_k     1      where slopes change, common to all channels
///   c       -      value at 0
///   s       -      slope from 0 to t_1
///   d_k     -      change of slope at t_k
/// @derivation
///   f(t) = c + s t + sum of d_k max(t - t_k, 0)                                            (1)
///   The ramps max(t - t_k, 0) do not depend on the channel: they are computed once for all of them.
///   With more than 8 changes of slope the samples of the curve are looked up instead:
///   f(t) = p_i + (64 t - i) (p_(i+1) - p_i), i = floor(64 t)                              (2)
/// @source    elementary
/// @deviation none
/// @valid     t in [0, 1]; outside, the last pieces go on
/// @accuracy  (1) differs from the curve by at most 2^-20 of its largest value plus 2^-20 of its slopes
/// @tests     tests/simulation/particles/core/test_ramp_curves.cpp
#pragma once

#include "foundation/math/curve.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace fx::sim {

constexpr uint32_t kMostRamps = 8;
constexpr uint32_t kMostChannels = 8;

struct RampCurves
{
    /// @param channels values at the 65 equally spaced samples of base::Curve, one span a channel
    explicit RampCurves(std::span<const std::array<float, base::kCurveSamples + 1>> channels);

    bool isConstant(uint32_t channel) const { return (varying >> channel & 1u) == 0; }

    uint32_t channels = 0;
    uint32_t varying = 0; ///< bit c: channel c is not constant
    bool byTable = false; ///< (2) instead of (1)
    uint32_t ramps = 0;
    std::array<float, kMostRamps> at{};                              ///< t_k
    std::array<float, kMostChannels> start{};                        ///< c
    std::array<float, kMostChannels> slope{};                        ///< s
    std::array<std::array<float, kMostRamps>, kMostChannels> bend{}; ///< d_k
    std::array<std::array<float, base::kCurveSamples + 1>, kMostChannels> table{};
};

/// The samples of channel `k` of a curve, as RampCurves takes them.
template <size_t N>
std::array<float, base::kCurveSamples + 1> samplesOf(const base::Curve<N>& curve, size_t k)
{
    std::array<float, base::kCurveSamples + 1> samples;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        samples[i] = curve.at(float(i) / float(base::kCurveSamples))[k];
    return samples;
}

} // namespace fx::sim
