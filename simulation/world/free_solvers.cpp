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

/// Gives a simulation the solvers of a set, in their first state. After an exception the set can be taken
/// again.
void SimulationPool::takeSet(FreeSolvers& set, SharedSimulation& simulation)
{
    StateReader reader(set.pristine->bytes());
    for (const std::unique_ptr<Solver>& solver : set.solvers)
        if (reader.ok())
            solver->restore(reader);
    if (!reader.ok() || reader.left() != 0)
        throw std::logic_error("a solver does not take its first state: " + reader.status().message());
    simulation.solvers = std::move(set.solvers);
    simulation.pristine = std::move(set.pristine);
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

/// Number of simulations of an effect that have solvers.
uint32_t SimulationPool::usedSets(const EffectDef& effect, QualityLevel level) const
{
    uint32_t used = 0;
    for (const SharedSimulation& simulation : simulations_)
        used += simulation.effect.get() == &effect && simulation.conditions.quality.level == level &&
                        !simulation.solvers.empty()
                    ? 1
                    : 0;
    return used;
}

size_t SimulationPool::idleAfter(const EffectDef& effect, QualityLevel level, uint32_t count) const
{
    const uint32_t used = count > 0 ? usedSets(effect, level) : 0;
    size_t idle = count > used ? count - used : 0;
    for (const Reserved& one : reserved_)
        if (one.is.effect.get() != &effect || one.is.level != level)
            idle += one.sets.size();
    return idle;
}

size_t SimulationPool::reservedSets() const
{
    size_t sum = 0;
    for (const Reserved& one : reserved_)
        sum += one.is.count;
    return sum;
}

void SimulationPool::reserveEntries(size_t more)
{
    simulations_.reserve(simulations_.size() + more);
    free_.reserve(simulations_.size() + more);
}

uint32_t SimulationPool::reserve(const std::shared_ptr<const EffectDef>& effect, QualityLevel level,
                                 uint32_t count)
{
    Reserved* reserved = reservedFor(*effect, level);
    if (!reserved && count == 0)
        return 0;
    const uint32_t used = usedSets(*effect, level);
    const uint32_t wanted = count > used ? count - used : 0; // sets that no simulation uses
    const size_t idle = reserved ? reserved->sets.size() : 0;
    std::vector<FreeSolvers> made; // all before anything changes
    made.reserve(count);
    for (size_t i = idle; i < wanted; ++i)
        made.push_back(makeSet(effect, qualityOf(level)));
    if (count > 0)
        reserveEntries(idleAfter(*effect, level, count));
    if (!reserved) {
        reserved_.reserve(reserved_.size() + 1);
        reserved = &reserved_.emplace_back(Reserved{{effect, level}, {}});
    }
    const uint32_t more = uint32_t(made.size());
    for (FreeSolvers& set : reserved->sets)
        if (made.size() < wanted)
            made.push_back(std::move(set));
    reserved->sets = std::move(made);
    reserved->is.count = count;
    settle(*reserved);
    if (count == 0)
        reserved_.erase(reserved_.begin() + (reserved - reserved_.data()));
    return more;
}

void SimulationPool::shrinkReservation(const EffectDef& effect, QualityLevel level, uint32_t count) noexcept
{
    Reserved* const reserved = reservedFor(effect, level);
    if (!reserved || reserved->is.count <= count)
        return;
    reserved->is.count = count;
    settle(*reserved);
    if (count == 0)
        reserved_.erase(reserved_.begin() + (reserved - reserved_.data()));
}

/// Lets all simulations of the effect return their solvers to the reservation, and frees the sets beyond its
/// count.
void SimulationPool::settle(Reserved& reserved) noexcept
{
    const EffectDef& effect = *reserved.is.effect;
    const uint32_t count = reserved.is.count, used = usedSets(effect, reserved.is.level);
    for (SharedSimulation& simulation : simulations_)
        if (simulation.effect.get() == &effect && simulation.conditions.quality.level == reserved.is.level)
            simulation.reserved = count > 0 && !simulation.solvers.empty();
    const size_t wanted = count > used ? count - used : 0;
    while (reserved.sets.size() > wanted)
        reserved.sets.pop_back();
}

void SimulationPool::publishReserved(const EffectDef& effect, QualityLevel level,
                                     base::FrameSnapshot& snapshot) const
{
    const auto publish = [&snapshot](const std::vector<std::unique_ptr<Solver>>& solvers) {
        base::GroupInfo info;
        for (const std::unique_ptr<Solver>& solver : solvers) {
            solver->publish(info, snapshot);
            ++info.solver;
        }
    };
    for (const Reserved& one : reserved_)
        if (one.is.effect.get() == &effect && one.is.level == level && !one.sets.empty())
            return publish(one.sets.back().solvers);
    for (const SharedSimulation& simulation : simulations_)
        if (simulation.reserved && !simulation.inPart && simulation.effect.get() == &effect &&
            simulation.conditions.quality.level == level)
            return publish(simulation.solvers);
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

/// Restores the state that a released simulation has kept. It may need memory.
void SimulationPool::restoreKept(const SharedSimulation& released, SharedSimulation& made)
{
    if (!released.kept)
        return;
    StateReader reader(released.kept->bytes());
    made.restore(reader);
    if (!reader.ok() || reader.left() != 0)
        throw std::logic_error("a solver does not take its own state: " + reader.status().message());
}

void SimulationPool::materialize(SimulationIndex index)
{
    SharedSimulation& simulation = simulations_[index];
    if (!simulation.released)
        return;
    SharedSimulation made;
    made.effect = simulation.effect;
    made.conditions.quality = simulation.conditions.quality;
    makeSolvers(made);
    try {
        restoreKept(simulation, made);
    } catch (...) {
        giveBack(made);
        throw;
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
