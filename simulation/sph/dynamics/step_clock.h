/// @file step_clock.h
/// Integer time inside a frame, so that steps of different lengths end at exactly the same time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace fx::sim {

constexpr uint32_t kFrameLevel = 40; ///< a frame has 2^40 ticks: its shortest step is 1e-12 of it
constexpr uint64_t kFrameTicks = uint64_t(1) << kFrameLevel;

/// Level of the longest power of two that is not above `ticks`, in 0 .. `most`.
inline uint32_t stepLevel(double ticks, uint32_t most = kFrameLevel)
{
    if (!(ticks >= 2.0))
        return 0;
    const uint32_t exponent = uint32_t(std::bit_cast<uint64_t>(ticks) >> 52) - 1023;
    return std::min(exponent, most);
}

/// The longest level, up to `level`, whose steps begin at `now`: a step may only become longer at a multiple
/// of the longer step.
inline uint32_t alignedLevel(uint32_t level, uint64_t now)
{
    return std::min(level, uint32_t(std::countr_zero(now | kFrameTicks)));
}

/// From the middle of the step [begin, end) to `now`, in ticks; exact.
inline double ticksSinceMiddle(uint64_t now, uint64_t begin, uint64_t end)
{
    return 0.5 * double(int64_t(2 * now) - int64_t(begin + end));
}

} // namespace fx::sim
