// What the host does to one instance of a running scene besides moving it.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <new>

namespace fx::scene {

base::Status Scene::postEvent(LocalId id, std::string_view name, uint32_t count)
{
    Instance& instance = *instances_.find(id);
    const std::vector<std::string>& known = instance.setup.effect->hostEvents;
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
        return {base::Code::NotFound,
                "the preset has no event that the host calls \"" + std::string(name.substr(0, 128)) + "\""};
    if (instance.state == InstanceState::Dormant)
        return {base::Code::InvalidArgument, "the instance has not started yet"};
    if (instance.state == InstanceState::Finished || count == 0)
        return {};
    world_.postEvent(instance.slot, {uint32_t(found - known.begin()), count});
    if (instance.state == InstanceState::Resting)
        comeBack(indexOf(id));
    return {};
}

void Scene::setRate(LocalId id, uint32_t rate)
{
    Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Finished)
        return;
    if (instance.state == InstanceState::Dormant) {
        instance.setup.rate = rate;
        return;
    }
    world_.setRate(instance.slot, rate); // may throw
    instance.setup.clock = world_.clockOf(instance.slot);
    measure(instance);
    if (instance.state == InstanceState::Resting || instance.state == InstanceState::Hidden)
        comeBack(indexOf(id));
}

base::Status Scene::seek(LocalId id, base::Ticks local)
{
    Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Dormant)
        return {base::Code::InvalidArgument, "the instance has not started yet"};
    if (instance.state == InstanceState::Finished)
        return {base::Code::InvalidArgument, "the instance has ended"};
    if (world_.isStepping()) {
        seeks_.push_back({id, local});
        return {};
    }
    waking_.reserve(instances_.count()); // where it goes when the way is long
    base::WorkBudget work(options_.workBudget);
    const bool isThere = world_.seekTo(instance.slot, local, clock_.stepTicks(), counters_.work, work);
    instance.setup.clock = world_.clockOf(instance.slot);
    instance.setup.cameFrom.reset(); // it has been where it is now from its first step on
    sought_ = true;
    if (instance.state == InstanceState::Resting || instance.state == InstanceState::Hidden)
        comeBack(indexOf(id));
    else if (instance.state == InstanceState::Active && !isThere)
        wait(indexOf(id));
    instance.isLate = !isThere;
    return {};
}

/// Publishes the last step again, with instances that have been sought to another time since. Both published
/// steps have the same time, so that all is shown as it is at this step.
void Scene::showSought()
{
    if (waking_.size() > 0) { // resting before
        base::WorkBudget late = lateWork();
        catchUpWaking(late);
        work_.spend(late.spent());
    }
    if (active_.size() > 0 || emptyPublications_ <= kMaxEmptyPublications) {
        const base::Ticks now = clock_.simulated();
        published_ = now;
        world_.publish(active_.slots(), ring_.beginWrite(now, clock_.stepTicks()));
        emptyPublications_ = 0;
        showsNothing_.store(false, std::memory_order_release);
        std::lock_guard lock(presentation_);
        ring_.publish();
        ring_.forgetOlder();
        show(now, clock_.interpolation());
        replaced_ = false;
    }
    sought_ = false;
}

/// After reconsider(). What was sought is what the first step of the update begins with.
void Scene::heedSought(const base::StepPlan& plan)
{
    try {
        if (plan.steps == 0)
            showSought();
        else if (plan.steps == 1 && update_.returned == 0)
            stageReturned(plan.firstStep);
        sought_ = false;
    } catch (const std::bad_alloc&) {
        memoryFailed_ = true; // with no step taken, it is tried again
    }
}

} // namespace fx::scene
