/// @file seekable_solver.h
/// Time and place reached without the steps between.
#pragma once

#include "simulation/solver/solver.h"

namespace fx::sim {

/// A solver that can leave out steps. See Solver::seekable().
class SeekableSolver
{
public:
    /// Whether seek() can take it from where it is to local time `tick`.
    virtual bool canSeek(const StepContext& context, base::Ticks tick) const = 0;

    /// Goes to local time `tick` at once, under the conditions of `context`: forwards as steps from where it
    /// is would, bit for bit, backwards as steps from 0 would. Only where canSeek() holds; the context's own
    /// tick and stepTicks are ignored.
    virtual void seek(const StepContext& context, base::Ticks tick) = 0;

    /// Local time, at least `tick`, up to which steps from `tick` on change nothing that is seen. canSeek()
    /// holds for any tick up to it.
    virtual base::Ticks restsUntil(base::Ticks tick) const = 0;

    /// Local time, at least `tick`, up to which steps from `tick` on, under the conditions of the last one,
    /// do nothing but let time pass, however much of what is seen changes with it: passTo() may stand for
    /// them.
    virtual base::Ticks quietUntil(base::Ticks tick) const { return tick; }

    /// Steps to local time `tick`, at most quietUntil(), that need not be taken.
    virtual void passTo(base::Ticks, StepCounters&) {}

    /// The instance stands at `placement` now, and got there while its own time stood still.
    virtual void standAt(const base::Placement&) {}

protected:
    ~SeekableSolver() = default;
};

} // namespace fx::sim
