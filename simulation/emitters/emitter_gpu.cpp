// Steps of emitters whose particles the GPU computes.
#include "simulation/emitters/emitter_solver.h"

namespace fx::sim {

/// After a step or a jump on the CPU.
/// @param isWanted begin there with the next step, where that is possible
void EmitterSolver::offerToGpu(uint64_t droppedBefore, bool isWanted)
{
    if (!gpu_)
        return;
    if (dropped_ != droppedBefore)
        gpu_->noteDrop(now_);
    gpu_->forget(now_);
    if (isWanted && gpu_->mayBegin(now_) && !mayDieSooner()) {
        store_.clear(store_.next());
        gpu_->begin();
    }
}

/// Whether the instance may end sooner than births tell: only rows tell then.
bool EmitterSolver::mayDieSooner() const
{
    return gpu_->kills() && schedule_.exhausted(now_);
}

/// Only counts births; particles have no rows.
void EmitterSolver::stepOnGpu(const StepContext& context)
{
    const base::Ticks end = context.tick + context.stepTicks;
    context.counters->born +=
        schedule_
            .advance({context.tick, end, double(context.parameters->intensity), context.parameters->emitting},
                     {})
            .total;
    now_ = end;
    const bool fits =
        gpu_->mayGoOn(now_) && !mayDieSooner(); // before those that die in this step are forgotten
    if (!fits)
        leaveGpu();
    gpu_->forget(now_);
    highWater_ = std::max(highWater_, gpu_->count());
}

/// The rows come back.
void EmitterSolver::leaveGpu()
{
    gpu_->end();
    gpu_->rebuild(key_, now_, store_);
    gpu_->noteDrop(now_); // to stay for a lifetime
}

/// After a jump to now_: what happened before is not in the log.
void EmitterSolver::listenAgain()
{
    if (!gpu_)
        return;
    schedule_.setLog(&gpu_->log());
    gpu_->clear(key_, now_, store_.next(), conditions_.pull);
}

uint32_t EmitterSolver::elementCount() const
{
    if (pool_)
        return pool_->countAlive(member_);
    if (!gpu_ || !gpu_->isOn())
        return store_.countAlive(now_);
    const bool mayBeEmpty =
        !conditions_.emitting || schedule_.exhausted(now_); // otherwise it is not examined
    return mayBeEmpty && gpu_->isEmpty(key_, now_) ? 0 : gpu_->count();
}

bool EmitterSolver::hasElements() const
{
    if (pool_)
        return pool_->isAnyAlive(member_);
    return gpu_ && gpu_->isOn() ? elementCount() > 0 : store_.isAnyAlive(now_);
}

/// The bytes that the CPU would have written, had it been there all along.
void EmitterSolver::saveFromGpu(StateWriter& writer) const
{
    ParticleStore rows(program_, rowsByBirth_.get_allocator().resource());
    rows.placed = store_.placed;
    gpu_->rebuild(key_, now_, rows);
    rows.save(writer, now_);
}

} // namespace fx::sim
