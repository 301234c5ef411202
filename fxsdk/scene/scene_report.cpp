// What a scene tells about what it does and why.
#include "fxsdk/scene/scene.h"

#include <algorithm>

namespace fx::scene {

namespace {
constexpr double kForgetting = 0.05;       ///< share of the last step in the mean cost
constexpr uint64_t kMinParticleSteps = 64; ///< fewer say more about overheads than about particles
} // namespace

InstanceState Scene::state(LocalId id)
{
    const uint32_t index = indexOf(id);
    if (options_.lockStep && instances_.at(index).state >= InstanceState::Waking) {
        completeStep();
        settleOne(index, false);
    }
    const Instance* instance = instances_.find(id); // may have ended and gone
    return instance ? instance->state : InstanceState::Finished;
}

Scene::Activity Scene::activity(LocalId id)
{
    const Instance& instance = *instances_.find(id);
    Activity activity;
    activity.state = instance.state;
    activity.reason = instance.state == InstanceState::Dormant ? Reason::NotStarted : instance.reason;
    activity.policy = instance.policy;
    activity.significance = significanceOf(instance);
    activity.reach = instance.reach;
    activity.particles = particles(id);
    if (instance.state == InstanceState::Active)
        activity.milliseconds = double(activity.particles) * nanosecondsPerParticle() * 1e-6;
    if (instance.state >= InstanceState::Waking && world_.lags(instance.slot))
        activity.lag = clock_.simulated() -
                       std::max(world_.simulated(instance.slot), instance.setup.startTick) +
                       world_.missing(instance.slot);
    return activity;
}

double Scene::nanosecondsPerParticle() const
{
    return budget_.nanosecondsPerParticle > 0 ? budget_.nanosecondsPerParticle : measuredNanoseconds_;
}

void Scene::measureTime(double seconds, uint64_t particleSteps)
{
    if (particleSteps < kMinParticleSteps)
        return;
    const double now = seconds * 1e9 / double(particleSteps);
    measuredNanoseconds_ += kForgetting * (now - measuredNanoseconds_);
}

void Scene::leaveMarks()
{
    newMarks_.clear();
    instances_.forEach([this](uint32_t, const Instance& instance) {
        if (instance.state != InstanceState::Finished)
            newMarks_.push_back(
                {instance.setup.placement.position, instance.reach, instance.state, instance.reason});
    });
    std::lock_guard lock(presentation_);
    std::swap(marks_, newMarks_);
}

void Scene::copyMarks(std::pmr::vector<Mark>& out)
{
    std::unique_lock lock(presentation_);
    while (out.capacity() < marks_.size()) {
        const size_t count = marks_.size();
        lock.unlock(); // the host's allocator may call
        out.reserve(count);
        lock.lock();
    }
    out.assign(marks_.begin(), marks_.end());
}

} // namespace fx::scene
