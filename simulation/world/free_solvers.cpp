// The free list: solvers of removed and released simulations, reused by the next simulation of the same
// effect.
#include "simulation/world/simulation_pool.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fx::sim {

/// Gives `simulation` solvers in the state before their first step.
void SimulationPool::makeSolvers(SharedSimulation& simulation)
{
    const auto fits = [&](const FreeSolvers& free) {
        return free.effect == simulation.effect && free.level == simulation.conditions.quality.level;
    };
    const auto found = std::find_if(freeList_.begin(), freeList_.end(), fits);
    if (found != freeList_.end()) {
        simulation.solvers = std::move(found->solvers);
        simulation.pristine = std::move(found->pristine);
        freeList_.erase(found);
        StateReader reader(simulation.pristine->bytes());
        simulation.restore(reader);
        if (!reader.ok() || reader.left() != 0)
            throw std::logic_error("a solver does not take its first state: " + reader.status().message());
        simulation.updateOnly();
        return;
    }
    std::vector<std::unique_ptr<Solver>> solvers;
    solvers.reserve(simulation.effect->solvers.size());
    for (const std::unique_ptr<const SolverDef>& def : simulation.effect->solvers)
        solvers.push_back(def->create(*schema_, simulation.conditions.quality, memory_));
    auto pristine =
        std::allocate_shared<StateBuffer>(std::pmr::polymorphic_allocator<StateBuffer>(memory_), memory_);
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->save(*pristine);
    simulation.solvers = std::move(solvers);
    simulation.updateOnly();
    simulation.pristine = std::move(pristine);
}

void SimulationPool::materialize(SimulationIndex index)
{
    SharedSimulation& simulation = simulations_[index];
    if (!simulation.released)
        return;
    SharedSimulation made;
    made.effect = simulation.effect;
    made.conditions.quality = simulation.conditions.quality;
    makeSolvers(made); // may throw; afterwards only a solver that refuses its own state does
    if (simulation.kept) {
        StateReader reader(simulation.kept->bytes());
        made.restore(reader);
        if (!reader.ok() || reader.left() != 0)
            throw std::logic_error("a solver does not take its own state: " + reader.status().message());
    }
    simulation.solvers = std::move(made.solvers);
    simulation.updateOnly();
    simulation.pristine = std::move(made.pristine);
    simulation.kept.reset();
    simulation.released = simulation.brief = false;
}

void SimulationPool::release(SimulationIndex index, base::Ticks now, bool mayForget)
{
    const bool isReleased = simulations_[index].released;
    mayForget = mayForget && simulations_[index].changes.empty();
    if (isReleased && (!mayForget || simulations_[index].brief || simulations_[index].forgottenAt > now))
        return;
    if (isReleased)
        materialize(index);
    SharedSimulation& simulation = simulations_[index];
    if (!isReleased) {
        const InstanceClock& clock = simulation.conditions.clock;
        const base::Ticks horizon = simulation.influenceHorizon();
        simulation.forgottenAt = horizon == SharedSimulation::kNever
                                     ? horizon
                                     : clock.toScene(clock.toLocal(simulation.simulated) + horizon);
    }
    const bool brief = mayForget && simulation.forgottenAt <= now;
    if (!simulation.fresh) {
        StateBuffer state(memory_);
        brief ? simulation.saveWithoutElements(state) : simulation.save(state);
        state.shrink();
        simulation.kept.emplace(std::move(state));
    }
    addToFreeList(simulation, now);
    simulation.released = true;
    simulation.brief = brief;
}

/// Never fails. The oldest make room.
void SimulationPool::addToFreeList(SharedSimulation& simulation, base::Ticks now)
{
    if (simulation.solvers.empty())
        return;
    if (freeList_.size() == kMaxFreeSolvers)
        freeList_.erase(freeList_.begin());
    freeList_.push_back({simulation.effect, simulation.conditions.quality.level,
                         std::move(simulation.solvers), std::move(simulation.pristine), now});
    simulation.solvers.clear();
    simulation.updateOnly();
}

void SimulationPool::trimFreeList(base::Ticks tick)
{
    const auto isOld = [tick](const FreeSolvers& free) { return free.since < tick; };
    freeList_.erase(freeList_.begin(), std::find_if_not(freeList_.begin(), freeList_.end(), isOld));
}

void SimulationPool::recycle(SimulationIndex index, base::Ticks now)
{
    if (SharedSimulation& simulation = simulations_[index]; simulation.users == 1 && !simulation.released)
        addToFreeList(simulation, now);
    leave(index);
}

} // namespace fx::sim
