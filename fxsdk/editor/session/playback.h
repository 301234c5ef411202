/// @file playback.h
/// The clock of the timeline. Its times are whole steps of the scene, so that every time is exact.
#pragma once

#include <cstdint>

namespace fx::editor {

class Playback
{
public:
    static constexpr int kStepsPerSecond = 60;

    double end = 5.0;   ///< [s] > 0, end of the timeline
    double speed = 1.0; ///< [1] of the effect's time over real time, >= 0
    bool isPlaying = false;
    bool isLooping = true;

    double time() const { return double(step_) / kStepsPerSecond; } ///< [s]
    int64_t step() const { return step_; }
    /// Goes to a time [s], rounded to a step and limited to 0..end.
    void scrub(double seconds);
    /// Adds real time [s] while playing. At the end it starts again, or stops.
    void advance(double seconds);

private:
    int64_t lastStep() const;

    int64_t step_ = 0;
    double rest_ = 0.0; ///< [step] fraction of a step that is not shown yet
};

} // namespace fx::editor
