// How a world is saved, restored and hashed.
#include "simulation/world/world.h"

#include <algorithm>
#include <utility>

namespace fx::sim {

namespace {

void saveTold(const SharedSimulation& simulation, StateWriter& writer)
{
    if (simulation.effect->hostEvents.empty())
        return;
    writer.value(uint32_t(simulation.pendingEvents.size()));
    for (const SharedSimulation::PendingEvent& pending : simulation.pendingEvents) {
        writer.value(pending.tick);
        writer.value(pending.event.event);
        writer.value(pending.event.count);
    }
}

} // namespace

uint64_t World::hash(std::span<const Slot> slots) const
{
    std::vector<uint64_t> hashes(simulations_.size());
    std::vector<bool> known(simulations_.size());
    StateHasher all;
    for (const Slot slot : slots) {
        const SimulationIndex index = instances_[slot].simulation;
        if (!known[index]) {
            StateHasher hasher;
            simulations_.at(index).save(hasher);
            saveTold(simulations_.at(index), hasher);
            hashes[index] = hasher.hash();
            known[index] = true;
        }
        all.value(hashes[index]);
    }
    return all.hash();
}

void World::save(std::span<const Slot> slots, StateWriter& writer) const
{
    std::vector<uint32_t> firstUse(simulations_.size(), ~0u); // by simulation: place of its first user
    for (uint32_t place = 0; place < slots.size(); ++place) {
        const SimulationIndex index = instances_[slots[place]].simulation;
        const SharedSimulation& simulation = simulations_.at(index);
        const bool isFirst = firstUse[index] == ~0u;
        if (isFirst)
            firstUse[index] = place;
        writer.value(firstUse[index]);
        if (!isFirst)
            continue;
        writer.flag(simulation.fresh);
        simulation.save(writer);
        saveTold(simulation, writer);
    }
}

void World::restore(std::span<const Entry> entries, StateReader& reader, std::span<Slot> outSlots)
{
    instances_.reserve(entries.size());
    free_.reserve(entries.size());
    for (uint32_t place = 0; place < entries.size() && reader.ok(); ++place) {
        const uint32_t first = reader.value<uint32_t>(0, place, "an instance of the state has no simulation");
        if (!reader.ok())
            return;
        const SimulationIndex simulation =
            first == place ? restoreSimulation(entries[place], reader)
                           : joinSimulation(instances_[outSlots[first]].simulation, entries[place], reader);
        if (simulation != kNoSimulation)
            outSlots[place] = takeSlot(entries[place].start, simulation);
    }
}

SimulationIndex World::restoreSimulation(const Entry& first, StateReader& reader)
{
    const bool fresh = reader.flag();
    if (!reader.ok())
        return kNoSimulation;
    const SimulationIndex index = simulations_.create(first.effect, conditionsOf(*first.effect, first.start));
    SharedSimulation& simulation = simulations_.at(index);
    simulation.users = 1;
    simulation.fresh = fresh;
    simulation.restore(reader);
    restorePending(simulation, reader);
    simulations_.publish(index);
    return index;
}

/// @return kNoSimulation after a failure
SimulationIndex World::joinSimulation(SimulationIndex index, const Entry& entry, StateReader& reader)
{
    const SharedSimulation& simulation = simulations_.at(index);
    const SimulationConditions conditions = conditionsOf(*entry.effect, entry.start);
    // They may have shared one as long as nothing was in their way that only is at one of the places.
    SimulationConditions elsewhere = conditions;
    if (conditions.hasContact && !entry.effect->dependsOnPlacement())
        elsewhere.placement = simulation.conditions.placement;
    reader.require(simulation.effect == entry.effect && simulation.conditions.equals(elsewhere),
                   "instances of the state share a simulation although they differ");
    if (!reader.ok())
        return kNoSimulation;
    if (!simulation.conditions.equals(conditions)) {
        const SimulationIndex own = simulations_.copy(index);
        simulations_.at(own).conditions = conditions;
        return own;
    }
    if (!share_)
        return simulations_.copy(index);
    ++simulations_.at(index).users;
    return index;
}

void World::swap(World& other) noexcept
{
    dropStep();
    dropPublication();
    waiting_.clear();
    wanted_.clear();
    leaving_.clear();
    endPools();
    other.endPools();
    simulations_.swap(other.simulations_);
    std::swap(instances_, other.instances_);
    std::swap(free_, other.free_);
    std::swap(stepNumber_, other.stepNumber_);
    if (cues_)
        cues_->clear();
    std::swap(now_, other.now_);
}

} // namespace fx::sim
