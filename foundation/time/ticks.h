/// @file ticks.h
/// Time as integers. 705,600,000 ticks a second divide exactly by every frame and audio rate in use.
#pragma once

#include <cmath>
#include <cstdint>

namespace fx::base {

using Ticks = int64_t;

constexpr Ticks kTicksPerSecond = 705'600'000;

constexpr double toSeconds(Ticks ticks)
{
    return double(ticks) / double(kTicksPerSecond);
}

/// Nearest tick. Requires a finite `seconds` with |seconds| < 1e9.
inline Ticks toTicks(double seconds)
{
    return Ticks(std::llround(seconds * double(kTicksPerSecond)));
}

} // namespace fx::base
