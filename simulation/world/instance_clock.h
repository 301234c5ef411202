/// @file instance_clock.h
/// Conversion between the time of the scene and the local time of an instance.
///
/// @formula instance-clock
/// Local time of an instance with its own playback rate.
///
/// symbol   unit   meaning
///   s        tick   scene time
///   s0, l0   tick   scene time from which the present rate applies, and the local time at s0
///   p        1      local ticks in 2^16 ticks of the scene, >= 0
/// @derivation
///   l(s) = l0 + floor(p (s - s0) / 2^16)  for s >= s0,  l0 + s - s0 before                 (1)
///   The largest s with l(s) <= l is, for l >= l0 and p > 0,
///       s(l) = s0 + floor(((l - l0 + 1) 2^16 - 1) / p)                                      (2)
///   All numbers are integers, so results do not depend on the division of time into steps. With a rate that
///   is a multiple of 2^16, local ticks correspond exactly to scene ticks.
/// @source    elementary
/// @deviation none
/// @valid     p <= 2^20; differences below 2^62
/// @accuracy  exact
/// @tests     tests/simulation/particles/events/test_instance_time.cpp
#pragma once

#include "foundation/time/ticks.h"

#include <algorithm>
#include <cstdint>

namespace fx::sim {

constexpr uint32_t kNormalRate = 1u << 16; ///< rate at which local time advances as fast as scene time
constexpr uint32_t kHighestRate = 16u << 16;

struct InstanceClock
{
    base::Ticks scene = 0;       ///< scene time s0 of the last change of the rate
    base::Ticks local = 0;       ///< local time l0 at scene time s0
    uint32_t rate = kNormalRate; ///< rate p, local ticks per 2^16 ticks of the scene

    base::Ticks toLocal(base::Ticks tick) const
    {
        __extension__ using Wide = __int128;
        const base::Ticks since = tick - scene;
        if (since < 0 || rate == kNormalRate)
            return local + since;
        return local + base::Ticks((Wide(since) * rate) >> 16); // (1)
    }
    /// Scene time at which the instance reaches a local time; INT64_MAX / 4 if it never does.
    base::Ticks toScene(base::Ticks tick) const
    {
        __extension__ using Wide = __int128;
        const base::Ticks since = tick - local;
        if (since < 0 || rate == kNormalRate)
            return scene + since;
        if (rate == 0)
            return INT64_MAX / 4;
        const Wide ticks = (((Wide(since) + 1) << 16) - 1) / rate; // (2)
        return base::Ticks(std::min<Wide>(Wide(scene) + ticks, INT64_MAX / 4));
    }
    bool operator==(const InstanceClock&) const = default;
};

} // namespace fx::sim
