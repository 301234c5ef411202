// Instances whose time is their own: prewarm, playback rate, jumps.
#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/world.h"

#include <algorithm>
#include <stdexcept>

namespace fx::sim {

/// Gives an instance a simulation that no other shares.
void World::isolate(Slot slot)
{
    SimulationIndex& index = instances_[slot].simulation;
    endRest(index, now_);
    closeSimulation(index);
    if (simulations_.at(index).users == 1)
        return;
    const SimulationIndex own = simulations_.copy(index);
    if (instances_[slot].hidden) {
        --simulations_.at(index).hidden;
        ++simulations_.at(own).hidden;
    }
    simulations_.leave(index);
    index = own;
}

InstanceClock World::clockOf(Slot slot) const
{
    if (instances_[slot].wanted > 0 && wantedOf(slot).clock)
        return *wantedOf(slot).clock;
    const SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
    return simulation.changes.empty() ? simulation.conditions.clock
                                      : simulation.changes.back().conditions.clock;
}

void World::setRate(Slot slot, uint32_t rate)
{
    InstanceStart start = wantedOf(slot);
    InstanceClock clock = clockOf(slot);
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
    const SimulationIndex index = instances_[slot].simulation;
    if (simulations_.at(index).brief) { // its particles are only known at the present
        uint64_t unlimited = UINT64_MAX;
        catchUp(slot, CatchUp::Analytic, stepTicks, unlimited, counters);
    }
    simulations_.materialize(index);
    SharedSimulation& simulation = simulations_.at(index);
    StateBuffer solvers(memory_);
    simulation.save(solvers);
    const SimulationConditions conditions = simulation.conditions;
    const LocalSpan way{simulation.reached, simulation.target};
    const base::Ticks stepLength = simulation.stepLength, simulated = simulation.simulated;
    const bool wasArriving = simulation.arriving, wasFresh = simulation.fresh;
    StepCounters done;
    bool isThere = false;
    try {
        isThere = playTo(index, to, stepTicks, done, work);
    } catch (...) {
        restoreSolvers(simulation, solvers);
        simulation.conditions = conditions;
        simulation.reached = way.begin;
        simulation.target = way.end;
        simulation.stepLength = stepLength;
        simulation.simulated = simulated;
        simulation.arriving = wasArriving;
        simulation.inPart = false;
        simulation.stepped = 0;
        simulation.fresh = wasFresh;
        simulation.linked.reset();
        simulations_.publish(index);
        throw;
    }
    counters += done;
    simulation.changes.clear();
    simulation.pendingEvents.clear();
    simulation.field.reset();
    instances_[slot].start.clock = simulation.conditions.clock;
    return isThere;
}

/// Takes the solvers of a simulation to local time `to`, under the conditions that hold now, as far as the
/// work goes. After an exception the simulation is anywhere on the way.
bool World::playTo(SimulationIndex index, base::Ticks to, base::Ticks stepTicks, StepCounters& counters,
                   base::WorkBudget& work)
{
    SharedSimulation& simulation = simulations_.at(index);
    base::Ticks from =
        simulation.arriving
            ? simulation.reached
            : std::max<base::Ticks>(simulation.conditions.clock.toLocal(simulation.simulated), 0);
    if (simulation.fresh && !simulation.arriving) // its past, prewarm, is not simulated yet: see arrive()
        from = 0;
    simulations_.touch(index);
    simulation.arriving = false;
    if (!simulation.changes.empty())
        simulation.conditions = simulation.changes.back().conditions;
    for (const std::unique_ptr<Solver>& solver : simulation.solvers)
        if (SeekableSolver* const seekable = solver->seekable())
            seekable->standAt(
                simulation.conditions.placement); // a move that is not stepped yet is not part of the past
    if (!jump(index, from, to, counters)) {
        if (to < from) {
            restoreSolvers(simulation, *simulation.pristine);
            from = 0;
        }
        setOut(index, {from, to}, stepTicks, counters);
    }
    simulation.conditions.clock = {now_, to, simulation.conditions.clock.rate};
    simulation.simulated = now_;
    return !simulation.arriving || replay(index, work, counters);
}

/// Gives the solvers of a simulation a state back that they were in. Takes no memory.
void World::restoreSolvers(SharedSimulation& simulation, const StateBuffer& state)
{
    StateReader reader(state.bytes());
    simulation.restore(reader);
    if (!reader.ok() || reader.left() != 0)
        throw std::logic_error("a solver does not take its own state: " + reader.status().message());
}

} // namespace fx::sim
