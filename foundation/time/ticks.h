/// @file ticks.h
/// Time as integers. The number of ticks per second, 705,600,000, is a multiple of every frame rate and audio
/// rate in use.
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

/// Converts seconds to the nearest number of ticks. Requires |seconds| < 1e9.
inline Ticks toTicks(double seconds)
{
    return Ticks(std::llround(seconds * double(kTicksPerSecond)));
}

} // namespace fx::base
