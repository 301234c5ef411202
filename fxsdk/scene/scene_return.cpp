// How instances that were out of sight reach the present, and what happens to them meanwhile.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <new>
#include <utility>

namespace fx::scene {

namespace {
constexpr base::Ticks kShortestRest = 4; ///< steps; a shorter rest is not worth the way out and back

/// Whether instances of a policy reach the present as if they had never been hidden.
bool mayForget(sim::CatchUp policy)
{
    return policy == sim::CatchUp::Analytic || policy == sim::CatchUp::Replay;
}
} // namespace

/// Puts a hidden or resting instance on its way to the present. Allocates nothing: place() made room.
void Scene::comeBack(uint32_t index)
{
    takeBack(index);
    Instance& instance = instances_.at(index);
    instance.wasResting = instance.state == InstanceState::Resting;
    instance.state = InstanceState::Waking;
    instance.reason = Reason::CatchingUp;
    waking_.insert(instance.serial, index, instance.slot);
    visibilityStale_ = true;
}

/// The most significant ones first, as far as the budget of an update goes.
void Scene::catchUpWaking(base::WorkBudget& work)
{
    candidates_.clear();
    candidates_.reserve(waking_.size());
    for (const uint32_t index : waking_.keys()) {
        activation::Candidate candidate;
        candidate.significance = significanceOf(instances_.at(index));
        candidate.serial = instances_.at(index).serial;
        candidate.key = index;
        candidates_.push_back(candidate);
    }
    std::sort(candidates_.begin(), candidates_.end(), [](const auto& a, const auto& b) {
        return a.significance != b.significance ? a.significance > b.significance : a.serial < b.serial;
    });
    uint64_t left = options_.catchUpSteps;
    for (const activation::Candidate& candidate : candidates_) {
        try {
            if (catchUp(candidate.key, left, work))
                becomePresent(candidate.key);
        } catch (const std::bad_alloc&) {
            memoryFailed_ = true; // it is tried again in the next update
        }
    }
}

/// @return true when it is at the present, or at its end
bool Scene::catchUp(uint32_t index, uint64_t& ioBudget, base::WorkBudget& work)
{
    const Instance& instance = instances_.at(index);
    const sim::CatchUp policy = instance.wasResting ? sim::CatchUp::Analytic : instance.policy;
    const base::Ticks before = world_.simulated(instance.slot);
    sim::StepCounters counters;
    bool done = false;
    if (policy == sim::CatchUp::Analytic || policy == sim::CatchUp::Skip) {
        uint64_t nothing = 0; // a jump, which needs no steps
        done = world_.catchUp(instance.slot, policy, clock_.stepTicks(), nothing, counters, work);
    }
    if (!done && mayForget(policy))
        world_.passOver(instance.slot, clock_.stepTicks());
    const base::Ticks lag = clock_.simulated() - world_.simulated(instance.slot);
    if (!done && lag > options_.maxCatchUp && !options_.lockStep && !instance.isLate) {
        ++counters_.catchUpsSkipped;
        uint64_t nothing = 0;
        done = world_.catchUp(instance.slot, sim::CatchUp::Skip, clock_.stepTicks(), nothing, counters, work);
    }
    if (!done)
        done = world_.catchUp(instance.slot, policy, clock_.stepTicks(), ioBudget, counters, work);
    update_.catchUpTicks += std::max<base::Ticks>(world_.simulated(instance.slot) - before, 0);
    update_.catchUpParticleSteps += counters.particleSteps;
    counters_.work += counters;
    return done;
}

void Scene::becomePresent(uint32_t index)
{
    takeBack(index);
    Instance& instance = instances_.at(index);
    ++update_.returned;
    if (world_.finished(instance.slot, clock_.simulated()) && instance.setup.startTick < clock_.simulated()) {
        world_.recycle(instance.slot);
        finish(index);
        return;
    }
    instance.isLate = false;
    world_.show(instance.slot);
    if (instance.past)
        instance.past->restart(clock_.simulated());
    instance.state = InstanceState::Active;
    instance.reason = Reason::None;
    active_.insert(instance.serial, index, instance.slot);
}

/// What is due before `until`: ends of hidden lives, memory to be given back, ends of rests.
void Scene::ringAlarms(base::Ticks until)
{
    while (!alarms_.empty() && alarms_.earliest().start <= until) {
        const uint32_t index = alarms_.earliest().key;
        Instance& instance = instances_.at(index);
        const bool isOver = endOf(instance) <= until;
        if (instance.state == InstanceState::Resting) {
            comeBack(index);
            uint64_t unlimited = UINT64_MAX;
            if (catchUp(index, unlimited, work_))
                becomePresent(index);
        } else if (isOver) {
            takeBack(index);
            world_.recycle(instance.slot);
            finish(index);
        } else {
            const base::Ticks next = world_.release(instance.slot, mayForget(instance.policy));
            setAlarm(index, std::min(std::max(next, until + 1), endOf(instance)));
        }
    }
}

/// Instances without particles whose solvers have nothing to do for a while leave the list.
void Scene::restOrNot(base::Ticks now)
{
    if (!options_.culling)
        return;
    active_.removeIf([&](uint32_t index, sim::Slot slot) {
        if (world_.hasElements(slot))
            return false;
        const base::Ticks until = world_.restsUntil(slot);
        if (until < now + kShortestRest * clock_.stepTicks())
            return false;
        try {
            alarms_.reserve(index, alarms_.size() + 1);
            waking_.reserve(waking_.size() + denied_.size() + tree_.size() + hidden_ + resting_ + 1);
        } catch (const std::bad_alloc&) {
            return false;
        }
        world_.hide(slot);
        instances_.at(index).state = InstanceState::Resting;
        instances_.at(index).reason = Reason::NothingMoves;
        ++resting_;
        setAlarm(index, std::min(until, endOf(instances_.at(index))));
        return true;
    });
}

/// Catches all hidden instances up, whatever the cameras see.
/// @param alsoInexact also what cannot be caught up without a trace
void Scene::settle(bool alsoInexact)
{
    world_.endRests();
    if (hidden_ + resting_ + waking_.size() == 0)
        return;
    std::vector<std::pair<uint64_t, uint32_t>> bySerial;
    instances_.forEach([&](uint32_t index, const Instance& instance) {
        if (instance.state >= InstanceState::Waking)
            bySerial.push_back({instance.serial, index});
    });
    std::sort(bySerial.begin(), bySerial.end());
    for (const auto& [serial, index] : bySerial)
        settleOne(index, alsoInexact);
}

void Scene::settleOne(uint32_t index, bool alsoInexact)
{
    Instance& instance = instances_.at(index);
    base::WorkBudget whole;
    if (world_.isArriving(instance.slot)) // no budget decides how much of its past there is
        world_.arrive(instance.slot, clock_.stepTicks(), counters_.work, whole);
    if (!alsoInexact && !isExact(instance.policy))
        return world_.closeStep(instance.slot);
    if (instance.setup.startTick >= clock_.simulated())
        return world_.materialize(instance.slot);
    uint64_t unlimited = UINT64_MAX;
    const bool isResting = instance.state == InstanceState::Resting;
    if (instance.policy == sim::CatchUp::Replay)
        world_.passOver(instance.slot, clock_.stepTicks());
    world_.catchUp(instance.slot, isResting ? sim::CatchUp::Analytic : instance.policy, clock_.stepTicks(),
                   unlimited, counters_.work);
    if (!world_.finished(instance.slot, clock_.simulated())) {
        if (instance.state == InstanceState::Hidden) // its solvers are there again
            setAlarm(index, std::min(clock_.simulated() + options_.releaseAfter, endOf(instance)));
        return;
    }
    takeBack(index);
    world_.recycle(instance.slot);
    finish(index);
}

void Scene::forgetSight()
{
    activation::SphereHierarchy noTree(memory_);
    activation::TimerQueue noAlarms(memory_);
    std::swap(tree_, noTree);
    std::swap(alarms_, noAlarms);
    const auto all = [](uint32_t, sim::Slot) { return true; };
    waking_.removeIf(all);
    denied_.removeIf(all);
    coarse_.removeIf(all);
    hidden_ = resting_ = 0;
    emptyPublications_ = 0;
    sought_ = false;
    visibilityStale_ = true;
}

} // namespace fx::scene
