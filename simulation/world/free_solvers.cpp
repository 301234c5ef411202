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
    const QualityLevel level = simulation.conditions.quality.level;
    if (Reserved* const reserved = reservedFor(*simulation.effect, level)) {
        if (!reserved->sets.empty()) {
            takeSet(reserved->sets.back(), simulation);
            reserved->sets.pop_back();
            simulation.reserved = true;
            return;
        }
        ++reserved->is.misses;
    }
    const auto fits = [&](const FreeSolvers& free) {
        return free.effect == simulation.effect && free.level == level;
    };
    const auto found = std::find_if(freeList_.begin(), freeList_.end(), fits);
    if (found != freeList_.end()) {
        takeSet(*found, simulation);
        freeList_.erase(found);
        return;
    }
    FreeSolvers made = makeSet(simulation.effect, simulation.conditions.quality);
    simulation.solvers = std::move(made.solvers);
    simulation.updateOnly();
    simulation.pristine = std::move(made.pristine);
}

/// New solvers and their first state.
SimulationPool::FreeSolvers SimulationPool::makeSet(const std::shared_ptr<const EffectDef>& effect,
                                                    const Quality& quality) const
{
    std::vector<std::unique_ptr<Solver>> solvers;
    solvers.reserve(effect->solvers.size());
    for (const std::unique_ptr<const SolverDef>& def : effect->solvers)
        solvers.push_back(def->create(*schema_, quality, memory_));
    auto pristine =
        std::allocate_shared<StateBuffer>(std::pmr::polymorphic_allocator<StateBuffer>(memory_), memory_);
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->save(*pristine);
    return {effect, quality.level, std::move(solvers), std::move(pristine), 0};
}

/// Gives a simulation the solvers of a set, in their first state.
void SimulationPool::takeSet(FreeSolvers& set, SharedSimulation& simulation)
{
    simulation.solvers = std::move(set.solvers);
    simulation.pristine = std::move(set.pristine);
    StateReader reader(simulation.pristine->bytes());
    simulation.restore(reader);
    if (!reader.ok() || reader.left() != 0)
        throw std::logic_error("a solver does not take its first state: " + reader.status().message());
    simulation.updateOnly();
}

SimulationPool::Reserved* SimulationPool::reservedFor(const EffectDef& effect, QualityLevel level)
{
    for (Reserved& one : reserved_)
        if (one.is.effect.get() == &effect && one.is.level == level)
            return &one;
    return nullptr;
}

std::optional<SimulationPool::Reservation> SimulationPool::reservation(const EffectDef& effect,
                                                                       QualityLevel level) const
{
    for (const Reserved& one : reserved_)
        if (one.is.effect.get() == &effect && one.is.level == level) {
            Reservation is = one.is;
            is.idle = uint32_t(one.sets.size());
            return is;
        }
    return std::nullopt;
}

uint32_t SimulationPool::reserve(const std::shared_ptr<const EffectDef>& effect, QualityLevel level,
                                 uint32_t count)
{
    Reserved* reserved = reservedFor(*effect, level);
    uint32_t used = 0;
    for (const SharedSimulation& simulation : simulations_)
        used += simulation.effect == effect && simulation.conditions.quality.level == level &&
                        !simulation.solvers.empty()
                    ? 1
                    : 0;
    const uint32_t wanted = count > used ? count - used : 0; // sets that no simulation uses
    const size_t idle = reserved ? reserved->sets.size() : 0;
    std::vector<FreeSolvers> made; // all before anything changes
    made.reserve(count);
    for (size_t i = idle; i < wanted; ++i)
        made.push_back(makeSet(effect, qualityOf(level)));
    if (!reserved && count > 0) {
        reserved_.reserve(reserved_.size() + 1);
        simulations_.reserve(simulations_.size() + count);
        free_.reserve(simulations_.size() + count);
        reserved = &reserved_.emplace_back(Reserved{{effect, level}, {}});
    } else if (count > 0) {
        simulations_.reserve(simulations_.size() + count);
        free_.reserve(simulations_.size() + count);
    }
    if (!reserved)
        return 0;
    const uint32_t more = uint32_t(made.size());
    for (FreeSolvers& set : reserved->sets)
        if (made.size() < wanted)
            made.push_back(std::move(set));
    reserved->sets = std::move(made);
    reserved->is.count = count;
    for (SharedSimulation& simulation : simulations_)
        if (simulation.effect == effect && simulation.conditions.quality.level == level)
            simulation.reserved = count > 0 && !simulation.solvers.empty();
    if (count == 0)
        reserved_.erase(reserved_.begin() + (reserved - reserved_.data()));
    return more;
}

void SimulationPool::publishReserved(const EffectDef& effect, QualityLevel level,
                                     base::FrameSnapshot& snapshot) const
{
    for (const Reserved& one : reserved_)
        if (one.is.effect.get() == &effect && one.is.level == level && !one.sets.empty()) {
            base::GroupInfo info;
            for (const std::unique_ptr<Solver>& solver : one.sets.back().solvers) {
                solver->publish(info, snapshot);
                ++info.solver;
            }
        }
}

/// Returns the solvers to their reservation. Never fails. @return false: there is none, or it is complete
bool SimulationPool::giveBack(SharedSimulation& simulation)
{
    if (!simulation.reserved || simulation.solvers.empty())
        return false;
    const QualityLevel level = simulation.conditions.quality.level;
    Reserved* const reserved = reservedFor(*simulation.effect, level);
    simulation.reserved = false;
    if (!reserved || reserved->sets.size() >= reserved->is.count)
        return false;
    reserved->sets.push_back(
        {simulation.effect, level, std::move(simulation.solvers), std::move(simulation.pristine), 0});
    simulation.solvers.clear();
    simulation.updateOnly();
    return true;
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
    simulation.reserved = made.reserved;
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
    if (simulation.solvers.empty() || giveBack(simulation))
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
