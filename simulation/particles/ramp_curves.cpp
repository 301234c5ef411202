#include "simulation/particles/ramp_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::sim {

namespace {

constexpr size_t kLast = base::kCurveSamples;
constexpr float kFlat = 2e-6f; // of the largest value: less than this is rounding of the samples

float largest(const std::array<float, kLast + 1>& samples)
{
    float most = 1e-30f;
    for (const float p : samples)
        most = std::max(most, std::abs(p));
    return most;
}

/// Slope of the piece after sample `i`, per unit of t.
float slopeAfter(const std::array<float, kLast + 1>& samples, size_t i)
{
    return (samples[i + 1] - samples[i]) * float(kLast);
}

bool bendsAt(const std::array<float, kLast + 1>& samples, size_t i)
{
    const float bend = samples[i + 1] - 2.0f * samples[i] + samples[i - 1];
    return std::abs(bend) > kFlat * largest(samples);
}

/// Mean slope between two samples: rounding of the single pieces cancels.
float slopeBetween(const std::array<float, kLast + 1>& samples, size_t from, size_t to)
{
    return to > from + 1 ? (samples[to] - samples[from]) * (float(kLast) / float(to - from))
                         : slopeAfter(samples, from);
}

} // namespace

RampCurves::RampCurves(std::span<const std::array<float, kLast + 1>> samples)
    : channels(uint32_t(std::min<size_t>(samples.size(), kMaxChannels)))
{
    std::array<size_t, kMaxRamps + 2> places{0};
    for (uint32_t c = 0; c < channels; ++c) {
        table[c] = samples[c];
        start[c] = samples[c][0];
        const auto [low, high] = std::minmax_element(samples[c].begin(), samples[c].end());
        varying |= *high > *low ? 1u << c : 0u;
    }
    for (size_t i = 1; i < kLast; ++i) {
        const bool bends = std::any_of(table.begin(), table.begin() + channels,
                                       [i](const auto& channel) { return bendsAt(channel, i); });
        if (!bends)
            continue;
        byTable = byTable || ramps == kMaxRamps;
        if (byTable)
            return;
        places[++ramps] = i;
        at[ramps - 1] = float(i) / float(kLast);
    }
    places[ramps + 1] = kLast;
    from.fill(std::numeric_limits<float>::infinity());
    from[0] = -from[1];
    std::copy_n(at.begin(), ramps, from.begin() + 1);
    for (uint32_t c = 0; c < channels; ++c) {
        slope[c] = slopeBetween(table[c], 0, places[1]);
        float before = slope[c];
        pieceStart[c].fill(start[c]);
        pieceSlope[c].fill(before);
        for (uint32_t k = 0; k < ramps; ++k) {
            const float after = slopeBetween(table[c], places[k + 1], places[k + 2]);
            bend[c][k] = after - before;
            before = after;
            const double line = double(table[c][places[k + 1]]) - double(after) * double(at[k]);
            std::fill(pieceStart[c].begin() + k + 1, pieceStart[c].end(), float(line));
            std::fill(pieceSlope[c].begin() + k + 1, pieceSlope[c].end(), after);
        }
    }
}

float RampCurves::lowest(uint32_t channel) const
{
    return *std::min_element(table[channel].begin(), table[channel].end());
}

float RampCurves::highest(uint32_t channel) const
{
    return *std::max_element(table[channel].begin(), table[channel].end());
}

} // namespace fx::sim
