/// @file sequence_time.h
/// Time of media that are played from numbered files.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>

namespace fx::sim {

/// What follows the last frame.
enum class SequenceEnd : uint8_t
{
    Hold, ///< the last frame stays
    Loop, ///< the first frame follows, interpolated like all others
};

struct SequenceTime
{
    uint32_t count = 1; ///< number of frames, > 0
    float framesPerSecond = 24.0f;
    SequenceEnd end = SequenceEnd::Hold;

    /// The frame that is shown at a local time: 0 to below `count`, with a fraction.
    double frameAt(base::Ticks tick) const;
    /// See SeekableSolver::restsUntil().
    base::Ticks restsUntil(base::Ticks tick) const;
};

} // namespace fx::sim
