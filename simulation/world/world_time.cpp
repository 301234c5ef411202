// Instances whose time is their own: prewarm, playback rate, jumps.
#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/world.h"

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
    if (instances_[slot].wanted > 0 && wantedOf(slot).clock)
        return *wantedOf(slot).clock;
    const Run& run = runs_.at(instances_[slot].run);
    return run.changes.empty() ? run.conditions.clock : run.changes.back().conditions.clock;
}

void World::setRate(Slot slot, uint32_t rate)
{
    InstanceStart start = wantedOf(slot);
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
    if (runs_.at(index).brief) { // its particles are only known at the present
        uint64_t unlimited = UINT64_MAX;
        catchUp(slot, CatchUp::Analytic, stepTicks, unlimited, counters);
    }
    runs_.materialize(index);
    Run& run = runs_.at(index);
    StateBuffer solvers(memory_);
    run.save(solvers);
    const RunConditions conditions = run.conditions;
    const LocalSpan way{run.reached, run.target};
    const base::Ticks stepLength = run.stepLength, simulated = run.simulated;
    const bool wasArriving = run.arriving, wasFresh = run.fresh;
    StepCounters done;
    bool isThere = false;
    try {
        isThere = playTo(index, to, stepTicks, done, work);
    } catch (...) {
        restoreSolvers(run, solvers);
        run.conditions = conditions;
        run.reached = way.begin;
        run.target = way.end;
        run.stepLength = stepLength;
        run.simulated = simulated;
        run.arriving = wasArriving;
        run.inPart = false;
        run.stepped = 0;
        run.fresh = wasFresh;
        run.linked.reset();
        runs_.welcome(index);
        throw;
    }
    counters += done;
    run.changes.clear();
    run.told.clear();
    run.field.reset();
    instances_[slot].start.clock = run.conditions.clock;
    return isThere;
}

/// Takes the solvers of a run to local time `to`, under the conditions that hold now, as far as the work
/// goes. After an exception the run is anywhere on the way.
bool World::playTo(RunIndex index, base::Ticks to, base::Ticks stepTicks, StepCounters& counters,
                   base::WorkBudget& work)
{
    Run& run = runs_.at(index);
    runs_.touch(index);
    base::Ticks from =
        run.arriving ? run.reached : std::max<base::Ticks>(run.conditions.clock.toLocal(run.simulated), 0);
    run.arriving = false;
    if (!run.changes.empty())
        run.conditions = run.changes.back().conditions;
    for (const std::unique_ptr<Solver>& solver : run.solvers)
        if (SeekableSolver* const seekable = solver->seekable())
            seekable->standAt(
                run.conditions.placement); // a move that is not stepped yet is not part of the past
    if (!jump(index, from, to, counters)) {
        if (to < from) {
            restoreSolvers(run, *run.pristine);
            from = 0;
        }
        setOut(index, {from, to}, stepTicks, counters);
    }
    run.conditions.clock = {now_, to, run.conditions.clock.rate};
    run.simulated = now_;
    return !run.arriving || replay(index, work, counters);
}

/// Gives the solvers of a run a state back that they were in. Takes no memory.
void World::restoreSolvers(Run& run, const StateBuffer& state)
{
    StateReader reader(state.bytes());
    run.restore(reader);
    if (!reader.ok() || reader.left() != 0)
        throw std::logic_error("a solver does not take its own state: " + reader.status().message());
}

} // namespace fx::sim
