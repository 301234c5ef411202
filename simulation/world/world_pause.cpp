// Hidden simulations: paused, caught up, released.
#include "simulation/world/world.h"

#include "foundation/simd/floating_point_scope.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fx::sim {

namespace {
constexpr size_t kManyChanges = 64; ///< pending changes cost memory: then the run is caught up
}

void World::hide(Slot slot)
{
    Instance& instance = instances_[slot];
    if (instance.hidden)
        return;
    endRest(instance.run, now_);
    instance.hidden = true;
    ++runs_.at(instance.run).hidden;
}

void World::show(Slot slot)
{
    Instance& instance = instances_[slot];
    if (!instance.hidden)
        return;
    instance.hidden = false;
    --runs_.at(instance.run).hidden;
}

void World::retire(Slot slot)
{
    Instance& instance = instances_[slot];
    if (instance.hidden)
        --runs_.at(instance.run).hidden;
    leavePool(instance.run);
    runs_.retire(instance.run, now_);
    instance = Instance{};
    free_.push_back(slot);
}

bool World::lags(Slot slot) const
{
    const Run& run = runs_.at(instances_[slot].run);
    return isLagging(run) || run.arriving;
}

bool World::crowded(Slot slot) const
{
    return runs_.at(instances_[slot].run).changes.size() >= kManyChanges;
}

/// A lagging run gets `wanted` when it reaches the present. @return the run of the one user that changes
RunIndex World::changeLater(RunIndex index, const RunConditions& wanted)
{
    const Run& run = runs_.at(index);
    if ((run.changes.empty() ? run.conditions : run.changes.back().conditions).equals(wanted))
        return index;
    if (run.users == 1) {
        runs_.at(index).changes.push_back({now_, wanted, environment_.field});
        return index;
    }
    const RunIndex own = runs_.copy(index);
    try {
        runs_.at(own).changes.push_back({now_, wanted, environment_.field});
    } catch (...) {
        runs_.leave(own);
        throw;
    }
    runs_.leave(index);
    return own;
}

bool World::catchUp(Slot slot, CatchUp policy, base::Ticks stepTicks, uint64_t& ioBudget,
                    StepCounters& counters, base::WorkBudget& work)
{
    const base::FloatingPointScope floatingPoint;
    const RunIndex index = instances_[slot].run;
    runs_.materialize(index);
    Run& run = runs_.at(index);
    if (run.arriving && !replay(index, work, counters))
        return false;
    if (!isLagging(run))
        return true;
    while (run.simulated < now_ && !isFinished(run, run.simulated)) {
        if (!run.inStep && !run.changes.empty() && run.changes.front().tick <= run.simulated) {
            runs_.touch(index); // its chain is that of the old conditions
            run.conditions = run.changes.front().conditions;
            run.field = std::move(run.changes.front().field);
            run.changes.erase(run.changes.begin());
            continue;
        }
        standStill(run);
        const base::Ticks target = run.changes.empty() ? now_ : std::min(now_, run.changes.front().tick);
        if (policy == CatchUp::Skip) {
            runs_.touch(index);
            run.simulated = target;
        } else if (policy != CatchUp::Analytic || !seek(index, target, counters)) {
            if (ioBudget == 0 || work.isSpent())
                return false;
            const uint64_t stepsBefore = counters.particleSteps;
            const bool isTaken =
                stepRun(index, {run.simulated / stepTicks * stepTicks, stepTicks}, work, counters);
            ioBudget -= std::min(ioBudget, 1 + counters.particleSteps - stepsBefore);
            if (!isTaken)
                return false;
        }
    }
    if (!run.changes.empty()) { // applied at the present, or after the end
        runs_.touch(index);
        run.conditions = run.changes.back().conditions;
        run.changes.clear();
    }
    run.field.reset();
    run.linked.reset();
    return true;
}

void World::stepCoarsely(Slot slot, base::Ticks stepTicks, StepCounters& counters, base::WorkBudget& work)
{
    const base::FloatingPointScope floatingPoint;
    const RunIndex index = instances_[slot].run;
    if (!isLagging(runs_.at(index)))
        return;
    if (!runs_.at(index).changes.empty()) {
        uint64_t unlimited = UINT64_MAX;
        catchUp(slot, CatchUp::Replay, stepTicks, unlimited, counters, work);
        return;
    }
    runs_.materialize(index);
    const Run& run = runs_.at(index);
    if (run.inStep)
        stepRun(index, {run.stepTick, run.stepLength}, work, counters);
    else if (!isFinished(run, run.simulated))
        stepRun(index, {run.simulated, now_ - run.simulated}, work, counters);
}

base::Ticks World::release(Slot slot, bool mayForget)
{
    const RunIndex index = instances_[slot].run;
    const Run& run = runs_.at(index);
    if (!run.isPaused())
        return Run::kNever;
    closeRun(index);
    mayForget = mayForget && !run.arriving;
    runs_.release(index, now_, mayForget);
    return mayForget && !run.brief && run.kept && run.forgottenAt > now_ ? run.forgottenAt : Run::kNever;
}

base::Ticks World::restsUntil(Slot slot) const
{
    return std::max(now_, restOf(runs_.at(instances_[slot].run)));
}

/// Scene time up to which the run, whose state is known, rests; what it has reached when it does not.
base::Ticks World::restOf(const Run& run) const
{
    const RunClock& clock = run.conditions.clock;
    if (run.pooled)
        return pools_.now(); // it has particles
    const base::Ticks local = clock.toLocal(run.simulated);
    if (run.solvers.empty() || local <= 0 || clock.rate == 0)
        return run.simulated;
    base::Ticks until = run.effect->duration > 0 ? run.effect->duration : INT64_MAX / 4;
    for (const std::unique_ptr<Solver>& solver : run.solvers) {
        const SeekableSolver* const seekable = solver->seekable();
        until = seekable ? std::min(until, seekable->restsUntil(local)) : local;
        if (until <= local)
            return run.simulated;
    }
    return clock.toScene(until);
}

/// Takes a run that is stepped but rests to `tick`.
void World::endRest(RunIndex index, base::Ticks tick)
{
    leavePool(index);
    Run& run = runs_.at(index);
    if (run.restUntil == 0)
        return;
    StepCounters uncounted; // a rest is no work
    run.restUntil = 0;
    if (!run.isPaused() && run.simulated < tick && !seek(index, tick, uncounted))
        throw std::logic_error("a solver that rests does not seek");
}

void World::endRests()
{
    for (RunIndex index = 0; index < runs_.size(); ++index)
        if (runs_.at(index).users > 0 && !runs_.at(index).pooled) // members of a pool do not rest
            endRest(index, now_);
}

void World::setNow(base::Ticks now)
{
    now_ = now;
    for (RunIndex index = 0; index < runs_.size(); ++index)
        runs_.at(index).simulated = std::max(now, runs_.at(index).conditions.clock.scene);
}

} // namespace fx::sim
