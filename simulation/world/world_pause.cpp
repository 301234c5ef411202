// Hidden simulations: paused, caught up, released.
#include "simulation/world/world.h"

#include "foundation/simd/floating_point_scope.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fx::sim {

namespace {
constexpr size_t kManyChanges = 64; ///< pending changes cost memory: then the simulation is caught up
}

void World::hide(Slot slot)
{
    Instance& instance = instances_[slot];
    if (instance.hidden)
        return;
    endRest(instance.simulation, now_);
    instance.hidden = true;
    ++simulations_.at(instance.simulation).hidden;
}

void World::show(Slot slot)
{
    Instance& instance = instances_[slot];
    if (!instance.hidden)
        return;
    instance.hidden = false;
    --simulations_.at(instance.simulation).hidden;
}

void World::recycle(Slot slot)
{
    Instance& instance = instances_[slot];
    if (instance.hidden)
        --simulations_.at(instance.simulation).hidden;
    leavePool(instance.simulation);
    simulations_.recycle(instance.simulation, now_);
    instance = Instance{};
    free_.push_back(slot);
}

bool World::lags(Slot slot) const
{
    const SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
    return isLagging(simulation) || simulation.arriving;
}

bool World::hasManyChanges(Slot slot) const
{
    return simulations_.at(instances_[slot].simulation).changes.size() >= kManyChanges;
}

/// A lagging simulation gets `wanted` when it reaches the present. @return the simulation of the one user
/// that changes
SimulationIndex World::changeLater(SimulationIndex index, const SimulationConditions& wanted)
{
    const SharedSimulation& simulation = simulations_.at(index);
    if ((simulation.changes.empty() ? simulation.conditions : simulation.changes.back().conditions)
            .equals(wanted))
        return index;
    if (simulation.users == 1) {
        simulations_.at(index).changes.push_back({now_, wanted, environment_.field});
        return index;
    }
    const SimulationIndex own = simulations_.copy(index);
    try {
        simulations_.at(own).changes.push_back({now_, wanted, environment_.field});
    } catch (...) {
        simulations_.leave(own);
        throw;
    }
    simulations_.leave(index);
    return own;
}

bool World::catchUp(Slot slot, CatchUp policy, base::Ticks stepTicks, uint64_t& ioBudget,
                    StepCounters& counters, base::WorkBudget& work)
{
    const base::FloatingPointScope floatingPoint;
    const SimulationIndex index = instances_[slot].simulation;
    simulations_.materialize(index);
    SharedSimulation& simulation = simulations_.at(index);
    if (simulation.arriving && !replay(index, work, counters))
        return false;
    if (!isLagging(simulation))
        return true;
    while (simulation.simulated < now_ && !isFinished(simulation, simulation.simulated)) {
        if (!simulation.inStep && !simulation.changes.empty() &&
            simulation.changes.front().tick <= simulation.simulated)
        {
            simulations_.touch(index); // its chain is that of the old conditions
            simulation.conditions = simulation.changes.front().conditions;
            simulation.field = std::move(simulation.changes.front().field);
            simulation.changes.erase(simulation.changes.begin());
            continue;
        }
        standStill(simulation);
        const base::Ticks target =
            simulation.changes.empty() ? now_ : std::min(now_, simulation.changes.front().tick);
        if (policy == CatchUp::Skip) {
            simulations_.touch(index);
            simulation.simulated = target;
        } else if (policy != CatchUp::Analytic || !seek(index, target, counters)) {
            if (ioBudget == 0 || work.isSpent())
                return false;
            const uint64_t stepsBefore = counters.particleSteps;
            const bool isTaken = stepSimulation(
                index, {simulation.simulated / stepTicks * stepTicks, stepTicks}, work, counters);
            ioBudget -= std::min(ioBudget, 1 + counters.particleSteps - stepsBefore);
            if (!isTaken)
                return false;
        }
    }
    if (!simulation.changes.empty()) { // applied at the present, or after the end
        simulations_.touch(index);
        simulation.conditions = simulation.changes.back().conditions;
        simulation.changes.clear();
    }
    simulation.field.reset();
    simulation.linked.reset();
    return true;
}

void World::stepCoarsely(Slot slot, base::Ticks stepTicks, StepCounters& counters, base::WorkBudget& work)
{
    const base::FloatingPointScope floatingPoint;
    const SimulationIndex index = instances_[slot].simulation;
    if (!isLagging(simulations_.at(index)))
        return;
    if (!simulations_.at(index).changes.empty()) {
        uint64_t unlimited = UINT64_MAX;
        catchUp(slot, CatchUp::Replay, stepTicks, unlimited, counters, work);
        return;
    }
    simulations_.materialize(index);
    const SharedSimulation& simulation = simulations_.at(index);
    if (simulation.inStep)
        stepSimulation(index, {simulation.stepTick, simulation.stepLength}, work, counters);
    else if (!isFinished(simulation, simulation.simulated))
        stepSimulation(index, {simulation.simulated, now_ - simulation.simulated}, work, counters);
}

base::Ticks World::release(Slot slot, bool mayForget)
{
    const SimulationIndex index = instances_[slot].simulation;
    const SharedSimulation& simulation = simulations_.at(index);
    if (!simulation.isPaused())
        return SharedSimulation::kNever;
    closeSimulation(index);
    mayForget = mayForget && !simulation.arriving;
    simulations_.release(index, now_, mayForget);
    return mayForget && !simulation.brief && simulation.kept && simulation.forgottenAt > now_
               ? simulation.forgottenAt
               : SharedSimulation::kNever;
}

base::Ticks World::restsUntil(Slot slot) const
{
    return std::max(now_, restOf(simulations_.at(instances_[slot].simulation)));
}

/// Scene time up to which the simulation, whose state is known, rests; what it has reached when it does not.
base::Ticks World::restOf(const SharedSimulation& simulation) const
{
    const InstanceClock& clock = simulation.conditions.clock;
    if (simulation.pooled)
        return pools_.now(); // it has particles
    const base::Ticks local = clock.toLocal(simulation.simulated);
    if (simulation.solvers.empty() || local <= 0 || clock.rate == 0)
        return simulation.simulated;
    base::Ticks until = simulation.effect->duration > 0 ? simulation.effect->duration : INT64_MAX / 4;
    for (const std::unique_ptr<Solver>& solver : simulation.solvers) {
        const SeekableSolver* const seekable = solver->seekable();
        until = seekable ? std::min(until, seekable->restsUntil(local)) : local;
        if (until <= local)
            return simulation.simulated;
    }
    return clock.toScene(until);
}

/// Takes a simulation that is stepped but rests to `tick`.
void World::endRest(SimulationIndex index, base::Ticks tick)
{
    leavePool(index);
    SharedSimulation& simulation = simulations_.at(index);
    if (simulation.restUntil == 0)
        return;
    StepCounters uncounted; // a rest is no work
    simulation.restUntil = 0;
    if (!simulation.isPaused() && simulation.simulated < tick && !seek(index, tick, uncounted))
        throw std::logic_error("a solver that rests does not seek");
}

void World::endRests()
{
    for (SimulationIndex index = 0; index < simulations_.size(); ++index)
        if (simulations_.at(index).users > 0 &&
            !simulations_.at(index).pooled) // members of a pool do not rest
            endRest(index, now_);
}

void World::setNow(base::Ticks now)
{
    now_ = now;
    for (SimulationIndex index = 0; index < simulations_.size(); ++index)
        simulations_.at(index).simulated = std::max(now, simulations_.at(index).conditions.clock.scene);
}

} // namespace fx::sim
