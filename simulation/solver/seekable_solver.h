/// @file seekable_solver.h
/// Interface of solvers that can reach a time or placement without executing all steps.
#pragma once

#include "simulation/solver/solver.h"

namespace fx::sim {

/// A solver that can skip steps. See Solver::seekable().
class SeekableSolver
{
public:
    /// True if seek() can move the solver from its present state to local time `tick`.
    virtual bool canSeek(const StepContext& context, base::Ticks tick) const = 0;

    /// Moves to local time `tick` under the conditions of `context`. The result has the same bits as
    /// executing all steps, from the present state (forwards) or from time 0 (backwards). Requires canSeek().
    /// The context's tick and stepTicks are ignored.
    virtual void seek(const StepContext& context, base::Ticks tick) = 0;

    /// Local time, at least `tick`, up to which steps after `tick` do not change any visible element.
    /// canSeek() is true for every tick up to this time.
    virtual base::Ticks restsUntil(base::Ticks tick) const = 0;

    /// Local time, at least `tick`, up to which passTo() may replace steps. Until this time, steps change
    /// only the time of the state, if the conditions of the last step do not change.
    virtual base::Ticks quietUntil(base::Ticks tick) const { return tick; }

    /// Advances the time to `tick`, at most quietUntil(), without steps.
    virtual void passTo(base::Ticks, StepCounters&) {}

    /// Sets the placement after a motion during which the local time did not advance.
    virtual void standAt(const base::Placement&) {}

protected:
    ~SeekableSolver() = default;
};

} // namespace fx::sim
