// Instances whose time is their own: prewarm, playback rate, jumps.
#include "foundation/simd/floating_point_scope.h"
#include "simulation/world.h"

#include <algorithm>
#include <stdexcept>

namespace fx::sim {

/// Gives an instance a run that no other shares.
void World::isolate(Slot slot)
{
    RunIndex& index = instances_[slot].run;
    endRest(index, now_);
    closeRun(index);
    if (runs_.at(index).users == 1)
        return;
    const RunIndex own = runs_.copy(index);
    if (instances_[slot].hidden) {
        --runs_.at(index).hidden;
        ++runs_.at(own).hidden;
    }
    runs_.leave(index);
    index = own;
}

RunClock World::clockOf(Slot slot) const
{
    const Instance& instance = instances_[slot];
    if (instance.changed && instance.start.clock)
        return *instance.start.clock;
    const Run& run = runs_.at(instance.run);
    return run.changes.empty() ? run.conditions.clock : run.changes.back().conditions.clock;
}

void World::setRate(Slot slot, uint32_t rate)
{
    InstanceStart start = instances_[slot].start;
    RunClock clock = clockOf(slot);
    if (now_ > clock.scene)
        clock = {now_, clock.toLocal(now_), rate};
    clock.rate = rate;
    start.clock = clock;
    change(slot, start);
}

bool World::seekTo(Slot slot, base::Ticks to, base::Ticks stepTicks, StepCounters& counters,
                   base::WorkBudget& work)
{
    const base::FloatingPointScope floatingPoint;
    isolate(slot);
    const RunIndex index = instances_[slot].run;
    if (runs_.at(index).brief) { // those who lived then are known again at the present only
        uint64_t unlimited = UINT64_MAX;
        catchUp(slot, CatchUp::Analytic, stepTicks, unlimited, counters);
    }
    runs_.materialize(index);
    Run& run = runs_.at(index);
    runs_.touch(index);
    base::Ticks from =
        run.arriving ? run.reached : std::max<base::Ticks>(run.conditions.clock.toLocal(run.simulated), 0);
    run.arriving = false;
    if (!run.changes.empty()) {
        run.conditions = run.changes.back().conditions;
        run.changes.clear();
    }
    run.told.clear();
    for (const std::unique_ptr<Solver>& solver : run.solvers)
        solver->standAt(run.conditions.placement); // a move that is not stepped yet is not part of the past
    const uint32_t rate = run.conditions.clock.rate;
    if (!jump(index, from, to, counters)) {
        if (to < from) {
            StateReader reader(run.pristine->bytes());
            run.restore(reader);
            if (!reader.ok())
                throw std::logic_error("a solver does not take its first state: " +
                                       reader.status().message());
            from = 0;
        }
        setOut(index, {from, to}, stepTicks, counters);
    }
    run.conditions.clock = {now_, to, rate};
    instances_[slot].start.clock = run.conditions.clock;
    run.simulated = now_;
    run.field.reset();
    return !run.arriving || replay(index, work, counters);
}

} // namespace fx::sim
