// Many small emitters that are simulated and published together.
#include "simulation/world/world.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace fx::sim {

namespace {

/// Snapshots may outlive the world that wrote them and be written by the next.
uint64_t nextShape()
{
    static std::atomic<uint64_t> last{0};
    return ++last;
}

} // namespace

/// Whether the simulation, which has just been stepped, is one that a pool may compute: nothing is going to
/// happen but what its emitter does by itself. Pools grow with their members, which those that were reserved
/// must not need.
bool World::canPool(const SharedSimulation& simulation) const
{
    return mayPool_ && !simulation.reserved && simulation.only && simulation.users == 1 &&
           simulation.hidden == 0 && simulation.effect->subSteps <= 1 && simulation.pendingEvents.empty() &&
           simulation.changes.empty() && simulation.conditions.clock.rate == kNormalRate &&
           !simulation.conditions.parameters.isTinted();
}

/// Its solver goes on by itself.
void World::leavePool(SimulationIndex index)
{
    SharedSimulation& simulation = simulations_.at(index);
    if (!simulation.pooled)
        return;
    simulation.only->pooledEmitter()->leavePool();
    simulation.pooled = false;
    simulation.simulated = pools_.now();
    simulation.restUntil = 0;
    simulation.quietUntil = 0;
}

void World::endPools()
{
    pools_.forEach([this](PooledEmitter&, uint32_t user) { leavePool(user); });
}

/// @param isPlanned members are those of the step before
void World::stepPools(std::span<const Slot> active, bool isPlanned, StepCounters& counters)
{
    const uint64_t before = pools_.revision();
    if (!isPlanned)
        pools_.forEach([this](PooledEmitter&, uint32_t user) {
            if (simulations_.at(user).steppedIn != stepNumber_)
                leavePool(user); // time stands still for it
        });
    left_.clear();
    left_.reserve(pools_.members()); // before any member leaves
    pools_.step(now_, counters, left_);
    for (const SimulationIndex index : left_)
        leavePool(index);
    joinPools();
    if (isPlanned && pools_.revision() == before)
        return;
    planStep(active);
}

void World::joinPools()
{
    for (const SimulationIndex index : joining_) {
        SharedSimulation& simulation = simulations_.at(index);
        const InstanceClock& clock = simulation.conditions.clock;
        const PoolRequest request{index, stepNumber_, now_, clock.local - clock.scene};
        PooledEmitter* const emitter = simulation.only->pooledEmitter();
        if (emitter && simulation.simulated == now_ && simulation.restUntil == 0)
            simulation.pooled = emitter->joinPool(pools_, request);
    }
    joining_.clear();
}

void World::planStep(std::span<const Slot> active)
{
    stepPlan_.revision = 0; // of no pools: the memory may be exhausted on the way
    stepPlan_.active.assign(active.begin(), active.end());
    stepPlan_.others.clear();
    for (const Slot slot : active)
        if (!simulations_.at(instances_[slot].simulation).pooled)
            stepPlan_.others.push_back(slot);
    stepPlan_.revision = pools_.revision();
}

/// What is published of whom, where there are pools.
void World::planPublication(std::span<const Slot> active)
{
    const bool isPlanned = publishPlan_.holds(active, pools_.revision());
    if (!isPlanned || placed_ != moves_)
        makeRoster(active);
    if (!isPlanned)
        roster_->shape = nextShape();
    ends_.clear();
}

/// Where the instances stand whose emitters are in pools.
void World::makeRoster(std::span<const Slot> active)
{
    const auto isFree = [](const auto& roster) { return roster.use_count() == 1; };
    const uint64_t shape = roster_ ? roster_->shape : 0;
    roster_.reset();
    const auto found = std::find_if(rosterRoom_.begin(), rosterRoom_.end(), isFree);
    roster_ =
        found != rosterRoom_.end() ? *found : rosterRoom_.emplace_back(std::make_shared<base::GroupRoster>());
    roster_->shape = shape;
    roster_->entries.clear();
    publishPlan_.revision = 0;
    publishPlan_.active.assign(active.begin(), active.end());
    publishPlan_.others.clear();
    for (const Slot slot : active) {
        const Instance& instance = instances_[slot];
        const SharedSimulation& simulation = simulations_.at(instance.simulation);
        if (!simulation.pooled) {
            publishPlan_.others.push_back(slot);
            continue;
        }
        const PooledEmitter& emitter = *simulation.only->pooledEmitter();
        base::GroupRoster::Entry entry;
        entry.instance = instance.start.instance;
        entry.placement = instance.start.placement;
        entry.pool = uint32_t(pools_.indexOf(*emitter.pool()));
        entry.member = emitter.member();
        entry.stretch = uint32_t(publishPlan_.others.size());
        entry.isCosmetic = emitter.program().def.compute != ComputeOn::Cpu;
        roster_->entries.push_back(entry);
    }
    publishPlan_.revision = pools_.revision();
    placed_ = moves_;
}

} // namespace fx::sim
