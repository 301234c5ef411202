/// @file step_clock.h
/// Integer time within a frame. Steps of different lengths can therefore end at exactly the same time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace fx::sim {

/// Binary logarithm of the number of ticks in a frame. The shortest step, one tick, is 1e-12 of a frame.
constexpr uint32_t kFrameLevel = 40;
constexpr uint64_t kFrameTicks = uint64_t(1) << kFrameLevel;

/// Binary logarithm of the largest power of two that does not exceed `ticks`, clamped to 0 .. `most`.
inline uint32_t stepLevel(double ticks, uint32_t most = kFrameLevel)
{
    if (!(ticks >= 2.0))
        return 0;
    const uint32_t exponent = uint32_t(std::bit_cast<uint64_t>(ticks) >> 52) - 1023;
    return std::min(exponent, most);
}

/// The largest level up to `level` whose steps may begin at `now`. A step of 2^level ticks begins only at a
/// multiple of its length.
inline uint32_t alignedLevel(uint32_t level, uint64_t now)
{
    return std::min(level, uint32_t(std::countr_zero(now | kFrameTicks)));
}

/// Number of ticks from the middle of the step [begin, end) to `now`, without rounding error.
inline double ticksSinceMiddle(uint64_t now, uint64_t begin, uint64_t end)
{
    return 0.5 * double(int64_t(2 * now) - int64_t(begin + end));
}

} // namespace fx::sim
