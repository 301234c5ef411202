/// @file seekable_solver.h
/// Time and place reached without the steps between.
#pragma once

#include "simulation/solver/solver.h"

namespace fx::sim {

/// A solver that can leave out steps. See Solver::seekable().
class SeekableSolver
{
public:
    /// Whether seek() can move it from its state to local time `tick`.
    virtual bool canSeek(const StepContext& context, base::Ticks tick) const = 0;

    /// Moves to local time `tick` under the conditions of `context`, with the same bits as steps from its
    /// state (forwards) or from 0 (backwards). Requires canSeek(); the context's own tick and stepTicks are
    /// ignored.
    virtual void seek(const StepContext& context, base::Ticks tick) = 0;

    /// Local time, at least `tick`, up to which steps from `tick` on change no visible element. canSeek()
    /// holds for any tick up to it.
    virtual base::Ticks restsUntil(base::Ticks tick) const = 0;

    /// Local time, at least `tick`, up to which steps under the conditions of the last one can be replaced by
    /// passTo(), because the state does not change except for time.
    virtual base::Ticks quietUntil(base::Ticks tick) const { return tick; }

    /// Advances the time to `tick`, at most quietUntil(), without taking steps.
    virtual void passTo(base::Ticks, StepCounters&) {}

    /// Sets the placement after a motion during which the local time did not advance.
    virtual void standAt(const base::Placement&) {}

protected:
    ~SeekableSolver() = default;
};

} // namespace fx::sim
