/// @file birth.h
/// The index and the time of a birth.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>

namespace fx::sim {

constexpr base::Ticks kForever = INT64_MAX / 4; ///< later than any event

/// The birth of one particle.
struct Birth
{
    /// consecutive number within the emitter; births are numbered in the order of their ticks
    uint64_t index;
    base::Ticks tick; ///< local time
};

} // namespace fx::sim
