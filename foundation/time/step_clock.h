/// @file step_clock.h
/// Turns the host's irregular frame times into fixed simulation steps.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>

namespace fx::base {

/// What one advance of the clock came to.
struct StepPlan
{
    uint32_t steps = 0;     ///< fixed steps to take now
    Ticks firstStep = 0;    ///< tick at which the first of them begins
    bool refused = false;   ///< dt was negative or not finite: nothing advanced
    Ticks droppedTicks = 0; ///< time that was given up because dt exceeded the clamp
};

/// Everything a clock knows beside its rules.
struct ClockState
{
    Ticks now = 0;
    int64_t steps = 0;
    double remainder = 0; ///< [tick]
};

/// Accumulator clock: step k covers [k, k + 1) * stepTicks whatever the frame rate, so any sequence of dt
/// with the same sum takes the same steps.
class StepClock
{
public:
    /// @param stepTicks length of a step, > 0
    /// @param maxFrameTicks longest dt that is simulated; what exceeds it is dropped and reported
    StepClock(Ticks stepTicks, Ticks maxFrameTicks) : stepTicks_(stepTicks), maxFrameTicks_(maxFrameTicks) {}

    /// Advances by `dt` [s]. 0 is legal and does nothing; negative, NaN and infinite are refused.
    StepPlan advance(double dt);

    Ticks now() const { return now_; }                      ///< continuous time
    Ticks simulated() const { return steps_ * stepTicks_; } ///< end of the last step taken
    Ticks stepTicks() const { return stepTicks_; }
    ClockState state() const { return {now_, steps_, remainder_}; }
    /// @param state of a clock with the same step
    void restore(const ClockState& state)
    {
        now_ = state.now;
        steps_ = state.steps;
        remainder_ = state.remainder;
    }
    /// Where now() lies between the last two steps, in [0, 1): 0 shows the older, 1 would show the newer.
    double interpolation() const { return double(now_ - simulated()) / double(stepTicks_); }

private:
    Ticks stepTicks_;
    Ticks maxFrameTicks_;
    Ticks now_ = 0;
    int64_t steps_ = 0;
    double remainder_ = 0; ///< [tick] part of dt smaller than a tick, carried so that it is not lost
};

} // namespace fx::base
