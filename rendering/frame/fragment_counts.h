/// @file fragment_counts.h
/// Fragments of a frame at each size at which layers can be drawn, and the share of the picture that they
/// cover.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Divisors of the size of layers.
inline constexpr std::array<int, 3> kLayerDivisors = {1, 2, 4};

/// Fragments if the layers were drawn at each of kLayerDivisors.
using FragmentCounts = std::array<uint64_t, kLayerDivisors.size()>;

inline void add(const FragmentCounts& counts, FragmentCounts& ioSum)
{
    for (size_t i = 0; i < counts.size(); ++i)
        ioSum[i] += counts[i];
}

/// Shares of the picture that techniques cover, [0, 1): the weights of their errors.
struct ScreenShare
{
    double media = 0; ///< covered by blobs
    double hot = 0;   ///< covered by blobs with heat
};

} // namespace fx::render
