// What a world publishes, which a budget of work may divide: between solvers, and inside of those that can be
// divided.
#include "foundation/simd/floating_point_scope.h"
#include "simulation/world/group_tint.h"
#include "simulation/world/world.h"

#include <algorithm>

namespace fx::sim {

namespace {
constexpr uint64_t kTintedRows = 2; ///< rows that are tinted in one unit of work
}

void World::publish(std::span<const Slot> active, base::FrameSnapshot& snapshot)
{
    base::WorkBudget unlimited;
    beginPublication(active, snapshot);
    proceedPublication(unlimited);
}

void World::beginPublication(std::span<const Slot> active, base::FrameSnapshot& snapshot)
{
    PublicationInHand& hand = publication_;
    hand.isOpen = false;
    hand.hasPools = !pools_.empty();
    if (hand.hasPools)
        planPublication(active);
    hand.list = hand.hasPools ? publishPlan_.others : active;
    hand.place = 0;
    hand.solver = 0;
    hand.part = {};
    hand.firstGroup = 0;
    hand.snapshot = &snapshot;
    hand.isOpen = true;
}

bool World::proceedPublication(base::WorkBudget& work)
{
    PublicationInHand& hand = publication_;
    if (!hand.isOpen)
        return true;
    const base::FloatingPointScope floatingPoint;
    struct Ending // also after an exception, which ends the publication
    {
        PublicationInHand& hand;
        bool goesOn = false;
        ~Ending() { hand.isOpen = goesOn; }
    } ending{hand};
    spawnBatch_.beginPublication(*hand.snapshot, tasks_);
    const bool areWritten = publishSlots(work);
    work.spend(spawnBatch_.endPublication());
    if (!areWritten) {
        if (!hand.hasPools && hand.list.data() != hand.own.data()) { // the list may be gone by the next call
            hand.own.assign(hand.list.begin(), hand.list.end());
            hand.list = hand.own;
        }
        ending.goesOn = true;
        return false;
    }
    if (hand.hasPools) {
        pools_.publish(schema_->find(base::kParticleKind.name), *tasks_, *hand.snapshot);
        hand.snapshot->setRoster(roster_, ends_);
    }
    return true;
}

bool World::publishSlots(base::WorkBudget& work)
{
    PublicationInHand& hand = publication_;
    for (; hand.place < hand.list.size(); ++hand.place) {
        fetchAhead(hand.list, hand.place);
        if (!publishSlot(hand.list[hand.place], work))
            return false;
        hand.solver = 0;
        hand.firstGroup = hand.snapshot->addedCount();
        if (hand.hasPools)
            ends_.push_back(uint32_t(hand.snapshot->addedCount()));
    }
    return true;
}

/// The solvers of an instance that are still to be published.
bool World::publishSlot(Slot slot, base::WorkBudget& work)
{
    PublicationInHand& hand = publication_;
    const Instance& instance = instances_[slot];
    const SharedSimulation& simulation = simulations_.at(instance.simulation);
    base::GroupInfo info;
    info.instance = instance.start.instance;
    info.placement = instance.start.placement;
    const InstanceClock& clock = simulation.conditions.clock;
    info.step =
        clock.toLocal(hand.snapshot->tick()) - clock.toLocal(hand.snapshot->tick() - hand.snapshot->step());
    const bool isTinted = instance.start.parameters.isTinted();
    for (; hand.solver < simulation.solvers.size(); ++hand.solver) {
        if (work.isSpent())
            return false;
        info.solver = hand.solver;
        Solver& solver = simulation.only ? *simulation.only : *simulation.solvers[hand.solver];
        const PooledEmitter* const emitter = solver.pooledEmitter();
        if (emitter && !isTinted && emitter->joinPublication(info, *hand.snapshot, spawnBatch_))
            continue;
        if (!publishWithin(solver, info, *hand.snapshot, hand.part, work))
            return false;
        hand.part = {};
    }
    if (isTinted)
        work.spend(tintGroups(instance.start.parameters.tint, hand.firstGroup, *hand.snapshot) / kTintedRows);
    return true;
}

} // namespace fx::sim
