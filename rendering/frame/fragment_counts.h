/// @file fragment_counts.h
/// Types for the number of fragments of a frame with each size of layers, and for the share of the picture
/// that media cover.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Width and height of layers may be those of the picture divided by one of these numbers.
inline constexpr std::array<int, 3> kLayerDivisors = {1, 2, 4};

/// Number of fragments, for each divisor in kLayerDivisors.
using FragmentCounts = std::array<uint64_t, kLayerDivisors.size()>;

inline void add(const FragmentCounts& counts, FragmentCounts& ioSum)
{
    for (size_t i = 0; i < counts.size(); ++i)
        ioSum[i] += counts[i];
}

/// Shares of the picture that techniques cover, [0, 1). They are weights of the errors of scalability levels.
struct ScreenShare
{
    double media = 0; ///< share covered by blobs
    double hot = 0;   ///< share covered by blobs with heat
};

} // namespace fx::render
