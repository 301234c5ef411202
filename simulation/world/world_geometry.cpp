// Geometry of the host, and how it reaches runs.
#include "simulation/world/world.h"

#include <algorithm>
#include <utility>

namespace fx::sim {

/// Instances that meet geometry at different places no longer share a run. What each is does not change.
void World::divideByPlacement()
{
    std::vector<const base::Placement*> places(runs_.size(), nullptr); // of the first user of each run
    for (Instance& instance : instances_) {
        if (instance.run == kNoRun || !runs_.at(instance.run).effect->collides())
            continue;
        const base::Placement& here = instance.start.placement;
        const base::Placement*& first = places[instance.run];
        if (!first)
            first = &here;
        if (first->position == here.position && first->rotation == here.rotation &&
            first->scale == here.scale)
            continue;
        const RunIndex shared = instance.run;
        instance.run = runs_.copy(shared);
        if (instance.hidden) {
            --runs_.at(shared).hidden;
            ++runs_.at(instance.run).hidden;
        }
        runs_.leave(shared);
        places.resize(runs_.size(), nullptr);
        places[instance.run] = &here;
    }
}

void World::setField(std::shared_ptr<const DistanceField> field)
{
    endRests();
    if (field)
        divideByPlacement();
    reserveTelling();
    for (const Instance& instance : instances_) // paused runs still have to meet the old one
        if (instance.run != kNoRun && isLagging(runs_.at(instance.run)) && !runs_.at(instance.run).field)
            runs_.at(instance.run).field = environment_.field;
    std::swap(environment_.field, field); // the old one lives on until no run names it
    tellAll();
}

void World::setContact(const HostContact& contact)
{
    endRests();
    if (contact.meet)
        divideByPlacement();
    reserveTelling();
    contact_ = contact;
    tellAll();
}

/// Room for tellAll(), which must not fail half way.
void World::reserveTelling()
{
    for (const Instance& instance : instances_) {
        if (instance.run == kNoRun || !isLagging(runs_.at(instance.run)))
            continue;
        std::vector<Run::Change>& changes = runs_.at(instance.run).changes;
        const size_t most = changes.size() + runs_.at(instance.run).users;
        if (changes.capacity() < most)
            changes.reserve(std::max(most, 2 * changes.size()));
    }
}

/// Applies the present conditions to all runs. Never fails after reserveTelling().
void World::tellAll()
{
    for (const Instance& instance : instances_) {
        if (instance.run == kNoRun)
            continue;
        const RunConditions wanted = conditionsOf(*runs_.at(instance.run).effect, instance.start);
        if (isLagging(runs_.at(instance.run)))
            runs_.at(instance.run).changes.push_back({now_, wanted, environment_.field});
        else
            runs_.reset(instance.run, wanted);
    }
}

} // namespace fx::sim
