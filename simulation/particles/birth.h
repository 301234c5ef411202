/// @file birth.h
/// When a particle is born.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>

namespace fx::sim {

constexpr base::Ticks kForever = INT64_MAX / 4; ///< later than any event

/// One particle that is to be born.
struct Birth
{
    uint64_t index;   ///< running number within the emitter, ascending with the tick
    base::Ticks tick; ///< local time
};

} // namespace fx::sim
