/// @file step_clock.h
/// Turns the host's irregular frame times into fixed simulation steps.
#pragma once

#include "foundation/time/ticks.h"

#include <algorithm>
#include <cstdint>

namespace fx::base {

/// Result of one advance of the clock.
struct StepPlan
{
    uint32_t steps = 0;     ///< fixed steps to take now
    Ticks firstStep = 0;    ///< tick at which the first of them begins
    bool refused = false;   ///< dt was negative or not finite: nothing advanced
    Ticks droppedTicks = 0; ///< time that was dropped because dt exceeded the maximum
};

/// The state of a clock, without its step length and limits.
struct ClockState
{
    Ticks now = 0;
    int64_t steps = 0;
    double remainder = 0; ///< [tick]
};

/// Accumulator clock: step k covers [k, k + 1) * stepTicks at any frame rate, so all sequences of dt with the
/// same sum take the same steps.
class StepClock
{
public:
    /// @param stepTicks length of a step, > 0
    /// @param maxFrameTicks longest dt that is simulated; longer ones are shortened and the difference is
    ///         reported
    StepClock(Ticks stepTicks, Ticks maxFrameTicks) : stepTicks_(stepTicks), maxFrameTicks_(maxFrameTicks) {}

    /// Advances by `dt` [s]. 0 does nothing; negative, NaN and infinite values are refused. Plans at most the
    /// steps of the longest dt, postponed ones included.
    StepPlan advance(double dt);
    /// Postpones the last `steps` of a plan to the next plan.
    void postpone(uint32_t steps) { steps_ -= steps; }
    /// Marks one postponed step as taken.
    void takePostponed() { ++steps_; }
    /// Whole steps of now() that have been postponed.
    Ticks debt() const { return (now_ / stepTicks_ - steps_) * stepTicks_; }
    bool isBehind() const { return now_ - simulated() >= stepTicks_; } ///< debt() is not 0
    /// Drops the part of the debt above `most`. @return the dropped part
    Ticks dropDebt(Ticks most);

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
    /// Position of now() between the last two steps, in [0, 1): 0 is the older, 1 the newer. While there is
    /// debt, the newer one is shown.
    double interpolation() const
    {
        return std::min(double(now_ - simulated()) / double(stepTicks_), 1.0 - 0x1p-53);
    }

private:
    Ticks stepTicks_;
    Ticks maxFrameTicks_;
    Ticks now_ = 0;
    int64_t steps_ = 0;
    double remainder_ = 0; ///< [tick] part of dt smaller than a tick, carried so that it is not lost
};

} // namespace fx::base
