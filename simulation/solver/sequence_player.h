/// @file sequence_player.h
/// Base of solvers that play media from numbered files: the local time is their whole state.
#pragma once

#include "simulation/solver/seekable_solver.h"
#include "simulation/solver/sequence_time.h"
#include "simulation/solver/solver.h"

namespace fx::sim {

class SequencePlayer : public Solver, public SeekableSolver
{
public:
    explicit SequencePlayer(const SequenceTime& time) : time_(time) {}

    void step(const StepContext& context) final { tick_ = context.tick + context.stepTicks; }
    void seek(const StepContext&, base::Ticks tick) final { tick_ = tick; }
    bool canSeek(const StepContext&, base::Ticks) const final { return true; }
    bool finished(base::Ticks) const final { return false; }
    base::Ticks restsUntil(base::Ticks tick) const final { return time_.restsUntil(tick); }
    void save(StateWriter& writer) const final { writer.value(tick_); }
    void restore(StateReader& reader) final { tick_ = reader.value<base::Ticks>(); }
    SeekableSolver* seekable() final { return this; }

protected:
    base::Ticks now() const { return tick_; } ///< below 0 before the start
    /// The frame that is shown now, see SequenceTime::frameAt().
    double frame() const { return time_.frameAt(tick_); }

private:
    SequenceTime time_;
    base::Ticks tick_ = 0;
};

} // namespace fx::sim
