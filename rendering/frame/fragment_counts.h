/// @file fragment_counts.h
/// Types for the number of fragments of a frame, and for the share of the picture that media cover.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Divisors of the size of layers: width and height of a layer are the picture's width and height divided by
/// one of these numbers.
inline constexpr std::array<int, 3> kLayerDivisors = {1, 2, 4};

/// Number of fragments, for each divisor in kLayerDivisors.
using FragmentCounts = std::array<uint64_t, kLayerDivisors.size()>;

inline void add(const FragmentCounts& counts, FragmentCounts& ioSum)
{
    for (size_t i = 0; i < counts.size(); ++i)
        ioSum[i] += counts[i];
}

/// Fractions of the picture that media cover, [0, 1). The errors of scalability levels are weighted by these
/// fractions.
struct ScreenShare
{
    double media = 0; ///< fraction covered by blobs
    double hot = 0;   ///< fraction covered by hot blobs
};

} // namespace fx::render
