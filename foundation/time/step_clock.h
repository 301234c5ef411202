/// @file step_clock.h
/// Converts the host's irregular frame times to fixed simulation steps.
#pragma once

#include "foundation/time/ticks.h"

#include <algorithm>
#include <cstdint>

namespace fx::base {

/// Result of one advance of the clock.
struct StepPlan
{
    uint32_t steps = 0;     ///< number of fixed steps to take now
    Ticks firstStep = 0;    ///< [tick] beginning of the first of these steps
    bool refused = false;   ///< true: dt was negative or not finite, and the clock did not advance
    Ticks droppedTicks = 0; ///< time that was dropped because dt exceeded the maximum
};

/// The state of a clock, without its step length and limits.
struct ClockState
{
    Ticks now = 0;
    int64_t steps = 0;
    double remainder = 0; ///< [tick]
};

/// Accumulator clock: step k covers [k, k + 1) * stepTicks at any frame rate, so that all sequences of dt
/// with the same sum take the same steps.
class StepClock
{
public:
    /// @param stepTicks length of a step, > 0
    /// @param maxFrameTicks [tick] longest dt that is simulated; a longer dt is shortened, and
    ///         StepPlan::droppedTicks is the difference
    StepClock(Ticks stepTicks, Ticks maxFrameTicks) : stepTicks_(stepTicks), maxFrameTicks_(maxFrameTicks) {}

    /// Advances by `dt` [s]. A dt of 0 has no effect; negative, NaN and infinite values are refused. The plan
    /// has at most as many steps as the longest dt contains; postponed steps are included.
    StepPlan advance(double dt);
    /// Postpones the last `steps` steps of a plan to the next plan.
    void postpone(uint32_t steps) { steps_ -= steps; }
    /// Marks one postponed step as taken.
    void takePostponed() { ++steps_; }
    /// [tick] duration of the postponed steps.
    Ticks debt() const { return (now_ / stepTicks_ - steps_) * stepTicks_; }
    bool isBehind() const { return now_ - simulated() >= stepTicks_; } ///< true if debt() is not 0
    /// Reduces the debt to at most `most` [tick]. @return [tick] the dropped time
    Ticks dropDebt(Ticks most);

    Ticks now() const { return now_; }                      ///< [tick] sum of all dt passed to advance()
    Ticks simulated() const { return steps_ * stepTicks_; } ///< [tick] end of the last step taken
    Ticks stepTicks() const { return stepTicks_; }
    ClockState state() const { return {now_, steps_, remainder_}; }
    /// Sets the clock to a stored state.
    /// @param state state of a clock with the same step length
    void restore(const ClockState& state)
    {
        now_ = state.now;
        steps_ = state.steps;
        remainder_ = state.remainder;
    }
    /// Position of now() between the last two steps, in [0, 1): 0 is the older step, 1 the newer. If steps
    /// are postponed, the result is just below 1, so that the newer step is shown.
    double interpolation() const
    {
        return std::min(double(now_ - simulated()) / double(stepTicks_), 1.0 - 0x1p-53);
    }

private:
    Ticks stepTicks_;
    Ticks maxFrameTicks_;
    Ticks now_ = 0;
    int64_t steps_ = 0;
    double remainder_ = 0; ///< [tick] part of the sum of all dt that is less than one tick
};

} // namespace fx::base
