#include "simulation/world/simulation_pool.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace fx::sim {

namespace {

uint64_t bitsOf(float x, float y)
{
    return std::bit_cast<uint32_t>(x) | (uint64_t(std::bit_cast<uint32_t>(y)) << 32);
}

uint64_t bitsOf(double x)
{
    return std::bit_cast<uint64_t>(x);
}

/// Everything of the conditions as whole words.
std::array<uint64_t, 19> words(const SimulationConditions& c)
{
    const base::Placement& p = c.placement;
    const uint64_t choices =
        (uint64_t(c.quality.level) << 2) | (uint64_t(c.hasContact) << 1) | uint64_t(c.parameters.emitting);
    return {c.seed,
            uint64_t(c.clock.scene),
            uint64_t(c.clock.local),
            c.clock.rate,
            choices,
            bitsOf(c.gravity.x, c.gravity.y),
            bitsOf(c.gravity.z, c.wind.x),
            bitsOf(c.wind.y, c.wind.z),
            bitsOf(c.groundHeight, c.parameters.intensity),
            c.field ? c.field->hash() : 0,
            bitsOf(p.position.x),
            bitsOf(p.position.y),
            bitsOf(p.position.z),
            bitsOf(p.rotation.x, p.rotation.y),
            bitsOf(p.rotation.z, p.rotation.w),
            bitsOf(p.scale, c.worldWind.x),
            bitsOf(c.worldWind.y, c.worldWind.z),
            bitsOf(c.parameters.tint.x, c.parameters.tint.y),
            bitsOf(c.parameters.tint.z, 0.0f)};
}

} // namespace

bool SimulationConditions::equals(const SimulationConditions& other) const
{
    return words(*this) == words(other);
}

uint64_t SimulationConditions::hash() const
{
    uint64_t hash = 0;
    for (const uint64_t word : words(*this))
        hash = base::hashWord(hash, word);
    return hash;
}

void SharedSimulation::save(StateWriter& writer) const
{
    if (kept)
        kept->copyTo(writer);
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->save(writer);
}

void SharedSimulation::saveWithoutElements(StateWriter& writer) const
{
    for (const std::unique_ptr<Solver>& solver : solvers)
        solver->finiteMemory()->saveWithoutElements(writer);
}

base::Ticks SharedSimulation::influenceHorizon() const
{
    if (!changes.empty() || !pendingEvents.empty() || conditions.clock.rate == 0)
        return kNever;
    base::Ticks longest = 0;
    for (const std::unique_ptr<Solver>& solver : solvers) {
        const FiniteMemorySolver* const finite = solver->finiteMemory();
        longest = std::max(longest, finite ? finite->influenceHorizon(conditions.parameters) : kNever);
    }
    return longest;
}

void SharedSimulation::restore(StateReader& reader)
{
    for (const std::unique_ptr<Solver>& solver : solvers)
        if (reader.ok())
            solver->restore(reader);
}

SimulationPool::SimulationPool(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory,
                               bool share)
    : schema_(schema), memory_(memory), share_(share)
{
    chains_.fill(kNoSimulation);
    freeList_.reserve(kMaxFreeSolvers); // adding must not fail
}

SimulationIndex SimulationPool::acquire(const std::shared_ptr<const EffectDef>& effect,
                                        const SimulationConditions& conditions, bool released)
{
    SimulationIndex index = findFresh(effect.get(), conditions);
    if (index == kNoSimulation) {
        index = create(effect, conditions, released);
        publish(index);
    } else if (!released) {
        materialize(index);
    }
    ++simulations_[index].users;
    return index;
}

SimulationIndex SimulationPool::create(const std::shared_ptr<const EffectDef>& effect,
                                       const SimulationConditions& conditions, bool released)
{
    SharedSimulation simulation;
    simulation.effect = effect;
    simulation.conditions = conditions;
    simulation.simulated = conditions.clock.scene;
    simulation.released = released;
    if (!released)
        makeSolvers(simulation);
    simulation.fresh = true;
    simulation.nextFresh = kNoSimulation;
    if (free_.empty()) {
        try {
            free_.reserve(simulations_.size() + 1); // leave() must not fail
            simulations_.push_back(std::move(simulation));
        } catch (...) {
            giveBack(simulation);
            throw;
        }
        ++count_;
        return SimulationIndex(simulations_.size() - 1);
    }
    const SimulationIndex index = free_.back();
    free_.pop_back();
    simulations_[index] = std::move(simulation);
    ++count_;
    return index;
}

SimulationIndex SimulationPool::copy(SimulationIndex index)
{
    StateBuffer state(memory_);
    simulations_[index].save(state);
    const std::shared_ptr<const EffectDef> effect = simulations_[index].effect;
    std::vector<SharedSimulation::Change> changes = simulations_[index].changes;
    std::vector<SharedSimulation::PendingEvent> pendingEvents = simulations_[index].pendingEvents;
    const SimulationIndex made = create(effect, simulations_[index].conditions, simulations_[index].released);
    const SharedSimulation& from = simulations_[index];
    SharedSimulation& simulation = simulations_[made];
    simulation.users = 1;
    simulation.fresh = from.fresh;
    simulation.simulated = from.simulated;
    simulation.arriving = from.arriving;
    simulation.reached = from.reached;
    simulation.target = from.target;
    simulation.stepLength = from.stepLength;
    simulation.changes = std::move(changes);
    simulation.pendingEvents = std::move(pendingEvents);
    simulation.field = from.field;
    if (simulation.released) {
        simulation.pristine = from.pristine;
        simulation.brief = from.brief;
        simulation.forgottenAt = from.forgottenAt;
        if (from.kept)
            simulation.kept.emplace(std::move(state));
        return made;
    }
    try {
        StateReader reader(state.bytes());
        simulation.restore(reader);
        if (reader.ok() && reader.left() == 0)
            return made;
        throw std::logic_error("a solver does not take its own state: " + reader.status().message());
    } catch (...) {
        leave(made);
        throw;
    }
}

void SimulationPool::reset(SimulationIndex index, const SimulationConditions& conditions)
{
    unlink(index); // the chain is that of the old conditions
    simulations_[index].conditions = conditions;
    simulations_[index].quietUntil = 0;
    publish(index);
}

SimulationIndex SimulationPool::change(SimulationIndex index, const SimulationConditions& conditions)
{
    if (simulations_[index].conditions.equals(conditions))
        return index;
    const bool isAlone = simulations_[index].users == 1;
    if (simulations_[index].fresh &&
        (!isAlone || findFresh(simulations_[index].effect.get(), conditions) != kNoSimulation))
    {
        const std::shared_ptr<const EffectDef> effect = simulations_[index].effect;
        const SimulationIndex other =
            acquire(effect, conditions, simulations_[index].released); // there is no past to copy
        leave(index);
        return other;
    }
    if (isAlone) {
        reset(index, conditions);
        return index;
    }
    const SimulationIndex own = copy(index);
    simulations_[own].conditions = conditions;
    leave(index);
    return own;
}

void SimulationPool::leave(SimulationIndex index)
{
    SharedSimulation& simulation = simulations_[index];
    if (simulation.users > 1) {
        --simulation.users;
        return;
    }
    unlink(index);
    giveBack(simulation);
    simulation = SharedSimulation{};
    free_.push_back(index);
    --count_;
}

void SimulationPool::touch(SimulationIndex index)
{
    unlink(index);
    simulations_[index].fresh = false;
    simulations_[index].quietUntil = 0; // of the conditions and the state before
}

void SimulationPool::publish(SimulationIndex index)
{
    SharedSimulation& simulation = simulations_[index];
    if (!share_ || !simulation.fresh)
        return;
    uint32_t& first = chainOf(simulation);
    simulation.nextFresh = first;
    first = index;
}

SimulationIndex SimulationPool::findFresh(const EffectDef* effect,
                                          const SimulationConditions& conditions) const
{
    SimulationIndex index = chains_[conditions.hash() % kChains];
    while (index != kNoSimulation &&
           !(simulations_[index].effect.get() == effect && simulations_[index].conditions.equals(conditions)))
        index = simulations_[index].nextFresh;
    return index;
}

/// Takes a simulation out of its chain, if it is in one.
void SimulationPool::unlink(SimulationIndex index)
{
    if (!simulations_[index].fresh)
        return;
    uint32_t* at = &chainOf(simulations_[index]);
    while (*at != kNoSimulation && *at != index)
        at = &simulations_[*at].nextFresh;
    if (*at == index)
        *at = simulations_[index].nextFresh;
    simulations_[index].nextFresh = kNoSimulation;
}

void SimulationPool::swap(SimulationPool& other) noexcept
{
    for (SharedSimulation& simulation : simulations_)
        giveBack(simulation);
    std::swap(simulations_, other.simulations_);
    std::swap(free_, other.free_);
    std::swap(chains_, other.chains_);
    std::swap(count_, other.count_);
    for (Reserved& reserved : reserved_)
        settle(reserved);
}

} // namespace fx::sim
