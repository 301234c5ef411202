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

    /// The frame that is shown at a local time: 0 to below `count`, with a fraction. Before the start it is
    /// 0.
    double frameAt(base::Ticks tick) const;
    /// Frames since the start at the beginning and at the end of a step, between which time is linear.
    struct Way
    {
        double before = 0.0; ///< below 0: before the start, when the first frame is shown
        /// `count` and above: a sequence that loops has begun again. Above count - 1, another one shows its
        /// last frame.
        double frame = 0.0;
    };
    /// The way of the step that ends at `tick` and is `step` long.
    Way wayTo(base::Ticks tick, base::Ticks step) const;
    /// See SeekableSolver::restsUntil().
    base::Ticks restsUntil(base::Ticks tick) const;
};

} // namespace fx::sim
