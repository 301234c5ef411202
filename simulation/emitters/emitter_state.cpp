// What is kept of an emitter in a saved state.
#include "simulation/emitters/emitter_solver.h"

namespace fx::sim {

void EmitterSolver::save(StateWriter& writer) const
{
    saveState(writer, true);
}

void EmitterSolver::saveState(StateWriter& writer, bool withRows) const
{
    catchUpWithPool();
    writer.value(now_);
    writer.flag(started_);
    writer.value(motionBegin_);
    writer.vector(conditions_.pull);
    writer.value(conditions_.intensity);
    writer.flag(conditions_.emitting);
    writer.flag(varied_);
    if (interest_.in(EventKind::Host))
        writer.value(hostEvents_);
    schedule_.save(writer, now_);
    if (!withRows)
        store_.saveEmpty(writer);
    else if (gpu_ && gpu_->isOn())
        saveFromGpu(writer);
    else
        store_.save(writer, now_);
    if (space_)
        space_->save(writer);
    if (trails_)
        trails_->save(writer);
    if (detail_ && withRows)
        detail_->save(writer, store_, now_);
}

void EmitterSolver::restore(StateReader& reader)
{
    open_ = {};
    forgetRefusals();
    leavePool();
    now_ = reader.value<base::Ticks>(0, kForever, "an emitter's clock is out of range");
    started_ = reader.flag();
    motionBegin_ = reader.value<base::Ticks>(0, now_, "an emitter's clock is out of range");
    conditions_.pull = reader.vector();
    conditions_.intensity = reader.value<float>();
    conditions_.emitting = reader.flag();
    varied_ = reader.flag();
    if (interest_.in(EventKind::Host))
        hostEvents_ = reader.value<uint64_t>();
    schedule_.restore(reader);
    store_.restore(reader, now_);
    listenAgain();
    if (space_)
        space_->restore(reader);
    if (trails_)
        trails_->restore(reader, store_, now_);
    if (detail_)
        detail_->restore(reader, store_, now_);
}

} // namespace fx::sim
