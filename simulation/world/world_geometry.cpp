// Geometry of the host, and how it reaches simulations.
#include "simulation/world/world.h"

#include <algorithm>
#include <utility>

namespace fx::sim {

/// Instances that meet geometry at different places no longer share a simulation. What each is does not
/// change.
void World::divideByPlacement()
{
    std::vector<const base::Placement*> places(simulations_.size(),
                                               nullptr); // of the first user of each simulation
    for (Instance& instance : instances_) {
        if (instance.simulation == kNoSimulation || !simulations_.at(instance.simulation).effect->collides())
            continue;
        const base::Placement& here = instance.start.placement;
        const base::Placement*& first = places[instance.simulation];
        if (!first)
            first = &here;
        if (first->position == here.position && first->rotation == here.rotation &&
            first->scale == here.scale)
            continue;
        const SimulationIndex shared = instance.simulation;
        instance.simulation = simulations_.copy(shared);
        if (instance.hidden) {
            --simulations_.at(shared).hidden;
            ++simulations_.at(instance.simulation).hidden;
        }
        simulations_.leave(shared);
        places.resize(simulations_.size(), nullptr);
        places[instance.simulation] = &here;
    }
}

void World::setField(std::shared_ptr<const DistanceField> field)
{
    endRests();
    if (field)
        divideByPlacement();
    reserveUpdates();
    for (const Instance& instance : instances_) // paused simulations still have to meet the old one
        if (instance.simulation != kNoSimulation && isLagging(simulations_.at(instance.simulation)) &&
            !simulations_.at(instance.simulation).field)
            simulations_.at(instance.simulation).field = environment_.field;
    std::swap(environment_.field, field); // the old one lives on until no simulation names it
    updateConditions();
}

void World::setContact(const HostContact& contact)
{
    endRests();
    if (contact.meet)
        divideByPlacement();
    reserveUpdates();
    contact_ = contact;
    updateConditions();
}

/// Room for updateConditions(), which must not fail half way.
void World::reserveUpdates()
{
    for (const Instance& instance : instances_) {
        if (instance.simulation == kNoSimulation || !isLagging(simulations_.at(instance.simulation)))
            continue;
        std::vector<SharedSimulation::Change>& changes = simulations_.at(instance.simulation).changes;
        const size_t most = changes.size() + simulations_.at(instance.simulation).users;
        if (changes.capacity() < most)
            changes.reserve(std::max(most, 2 * changes.size()));
    }
}

/// Applies the present conditions to all simulations. Never fails after reserveUpdates().
void World::updateConditions()
{
    for (const Instance& instance : instances_) {
        if (instance.simulation == kNoSimulation)
            continue;
        const SimulationConditions wanted =
            conditionsOf(*simulations_.at(instance.simulation).effect, instance.start);
        if (isLagging(simulations_.at(instance.simulation)))
            simulations_.at(instance.simulation).changes.push_back({now_, wanted, environment_.field});
        else
            simulations_.reset(instance.simulation, wanted);
    }
}

} // namespace fx::sim
