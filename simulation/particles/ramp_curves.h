/// @file ramp_curves.h
/// Several curves over the same parameter, in a form for SIMD evaluation.
///
/// @formula ramp-curves
/// A piecewise linear function as a sum of ramps.
///
/// symbol   unit   meaning
///   t       1      parameter, 0..1
///   t_k     1      parameters at which slopes change, common to all channels
///   c       -      value at 0
///   s       -      slope from 0 to t_1
///   d_k     -      change of slope at t_k
///   a_i,b_i -      value at 0 and slope of the line of piece i, which begins at t_i
/// @derivation
///   f(t) = c + s t + sum of d_k max(t - t_k, 0)                                            (1)
///   On piece i the sum is a line: with b_i = s + d_1 + ... + d_i and a_i = f(t_i) - b_i t_i,
///   f(t) = a_i + b_i t                                                                     (2)
///   Pieces are common to all channels, and consecutive particles are mostly in the same piece.
///   With more than 8 changes of slope, a table of samples of the curve is interpolated instead:
///   f(t) = p_i + (64 t - i) (p_(i+1) - p_i), i = floor(64 t)                              (3)
/// @source    elementary
/// @deviation none
/// @valid     t in [0, 1]; outside, the first and the last piece are extrapolated
/// @accuracy  (2) differs from the curve by at most 2^-20 of its largest value plus 2^-20 of its slopes
/// @tests     tests/simulation/particles/core/test_ramp_curves.cpp
#pragma once

#include "foundation/math/curve.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace fx::sim {

constexpr uint32_t kMaxRamps = 8;
constexpr uint32_t kMaxChannels = 8;
constexpr uint32_t kPieceRoom =
    16; ///< maximum number of pieces, rounded up to the width of the widest SIMD vector

struct RampCurves
{
    /// Converts sampled curves to ramps.
    /// @param channels for each channel, the values at the 65 equally spaced samples of base::Curve
    explicit RampCurves(std::span<const std::array<float, base::kCurveSamples + 1>> channels);

    /// Smallest or largest sample of a channel.
    float lowest(uint32_t channel) const;
    float highest(uint32_t channel) const;
    bool isConstant(uint32_t channel) const { return (varying >> channel & 1u) == 0; }

    uint32_t channels = 0;
    uint32_t varying = 0; ///< bit c is set if channel c is not constant
    bool byTable = false; ///< true: the curves are evaluated by equation (3); false: by equation (2)
    uint32_t ramps = 0;   ///< number of ramps, one less than the number of pieces
    /// t_i, beginning of piece i; -infinity for the first piece, +infinity after the last piece
    std::array<float, kPieceRoom + 1> from{};
    /// a_i, values at the beginning of pieces; the last value is repeated
    std::array<std::array<float, kPieceRoom>, kMaxChannels> pieceStart{};
    std::array<std::array<float, kPieceRoom>, kMaxChannels> pieceSlope{}; ///< slopes b_i of pieces
    std::array<float, kMaxRamps> at{};                             ///< parameters t_k at which slopes change
    std::array<float, kMaxChannels> start{};                       ///< values c at 0
    std::array<float, kMaxChannels> slope{};                       ///< slopes s from 0 to t_1
    std::array<std::array<float, kMaxRamps>, kMaxChannels> bend{}; ///< changes d_k of the slope at t_k
    std::array<std::array<float, base::kCurveSamples + 1>, kMaxChannels> table{};
};

/// The samples of channel `k` of a curve, in the format of the constructor of RampCurves.
template <size_t N>
std::array<float, base::kCurveSamples + 1> samplesOf(const base::Curve<N>& curve, size_t k)
{
    std::array<float, base::kCurveSamples + 1> samples;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        samples[i] = curve.at(float(i) / float(base::kCurveSamples))[k];
    return samples;
}

} // namespace fx::sim
