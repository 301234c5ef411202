// Living instances that go on with another effect, as when a preset is edited while a game runs.
#include "foundation/simd/floating_point_scope.h"
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <utility>

namespace fx::scene {

struct Scene::Successor
{
    uint32_t index = 0;
    Instance next;
    bool isInWorld = false;
    bool isThere = true; ///< false: its past needs more work than one call may do
};

/// Leaves the world as it was unless all successors take over.
class Scene::Succession
{
public:
    Succession(sim::World& world, std::pmr::memory_resource* memory) : list(memory), world_(world) {}
    ~Succession()
    {
        for (const Successor& one : list)
            if (one.isInWorld)
                world_.remove(one.next.slot);
    }
    Succession(const Succession&) = delete;
    Succession& operator=(const Succession&) = delete;

    std::pmr::vector<Successor> list; ///< those that have not taken over

private:
    sim::World& world_;
};

base::Ticks Scene::localTime(LocalId id)
{
    const Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Dormant)
        return clock_.simulated() - instance.setup.startTick;
    return instance.state == InstanceState::Finished
               ? 0
               : world_.clockOf(instance.slot).toLocal(clock_.simulated());
}

/// The instance with another effect, not in the world yet.
Scene::Successor Scene::successorOf(uint32_t index, const std::shared_ptr<const sim::EffectDef>& effect,
                                    Replacement mode) const
{
    const Instance& instance = instances_.at(index);
    const base::Ticks now = clock_.simulated();
    const bool isInWorld =
        instance.state != InstanceState::Dormant && instance.state != InstanceState::Finished;
    Successor successor;
    successor.index = index;
    Instance& next = successor.next;
    next.setup = instance.setup;
    next.setup.effect = effect;
    next.setup.cameFrom.reset(); // its past is that of an instance that has always been here
    next.serial = instance.serial;
    next.state = instance.state;
    next.reason = instance.reason;
    next.hints = instance.hints;
    next.policy = effect->catchUp();
    const bool hasBegun = instance.setup.clock || instance.setup.startTick < now;
    if (isInWorld && hasBegun) {
        const sim::InstanceClock clock = world_.clockOf(instance.slot);
        const bool keepsTime = mode == Replacement::Seek && clock.scene <= now;
        next.setup.clock = {std::max(clock.scene, now),
                            keepsTime ? std::max<base::Ticks>(clock.toLocal(now), 0) : effect->prewarm,
                            clock.rate};
    }
    measure(next);
    return successor;
}

uint32_t Scene::replace(const sim::EffectDef& from, const std::shared_ptr<const sim::EffectDef>& to,
                        Replacement mode)
{
    completeStep();
    const base::FloatingPointScope floatingPoint;
    const auto isOld = [&from](const Instance& instance) { return instance.setup.effect.get() == &from; };
    size_t count = 0;
    instances_.forEach([&](uint32_t, const Instance& instance) { count += isOld(instance) ? 1 : 0; });
    Succession succession(world_, memory_);
    std::pmr::vector<Successor>& list = succession.list;
    list.reserve(count);
    instances_.forEach([&](uint32_t index, const Instance& instance) {
        if (isOld(instance))
            list.push_back(successorOf(index, to, mode));
    });
    for (Successor& one : list) { // all before the first is simulated, so that equal ones share a simulation
        if (one.next.state == InstanceState::Dormant || one.next.state == InstanceState::Finished)
            continue;
        sim::InstanceStart start = startOf(instances_, one.index);
        start.clock = one.next.setup.clock;
        one.next.slot = world_.add(to, start);
        one.isInWorld = true;
    }
    base::WorkBudget work(options_.workBudget);
    sim::StepCounters counters;
    for (Successor& one : list)
        if (one.isInWorld)
            one.isThere = world_.arrive(one.next.slot, clock_.stepTicks(), counters, work);
    for (const Successor& one : list)
        if (!one.isThere)
            world_.hide(one.next.slot);
    active_.reserve(instances_.count() + size_t(1));
    waking_.reserve(instances_.count() + size_t(1));

    counters_.work += counters; // nothing throws from here on
    uint32_t living = 0;
    for (; !list.empty(); list.pop_back()) {
        living += list.back().next.state != InstanceState::Finished ? 1 : 0;
        sought_ = sought_ || list.back().isInWorld;
        succeed(list.back());
    }
    replaced_ = replaced_ || sought_;
    visibilityStale_ = true;
    return living;
}

/// An instance becomes its successor. Allocates nothing.
void Scene::succeed(Successor& successor)
{
    Instance& instance = instances_.at(successor.index);
    const bool hasEnded = instance.state == InstanceState::Finished;
    if (!hasEnded)
        countHints(instance, -1);
    if (successor.isInWorld) {
        if (instance.state == InstanceState::Active)
            active_.remove(instance.serial);
        else
            takeBack(successor.index);
        world_.remove(instance.slot);
    }
    instance = std::move(successor.next);
    if (!hasEnded)
        countHints(instance, 1);
    if (!successor.isInWorld)
        return;
    instance.isLate = !successor.isThere;
    instance.state = successor.isThere ? InstanceState::Active : InstanceState::Waking;
    instance.reason = successor.isThere ? Reason::None : Reason::CatchingUp;
    (successor.isThere ? active_ : waking_).insert(instance.serial, successor.index, instance.slot);
}

} // namespace fx::scene
