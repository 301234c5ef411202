// Instances that follow paths of the host: at the end of each step they stand where their path is.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <new>

namespace fx::scene {

std::pmr::vector<Scene::InMotion>::iterator Scene::inMotion(LocalId id)
{
    return std::lower_bound(motions_.begin(), motions_.end(), id,
                            [](const InMotion& one, LocalId wanted) { return one.id < wanted; });
}

base::Status Scene::setMotion(LocalId id, const MotionPose& pose)
{
    Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Finished)
        return {};
    auto at = inMotion(id);
    const bool isNew = at == motions_.end() || at->id != id;
    if (!isNew && pose.tick < at->track->newest())
        return {base::Code::InvalidArgument, "motion has an earlier time than the last pose of the instance"};
    std::unique_ptr<MotionTrack> track;
    if (isNew) {
        track = std::make_unique<MotionTrack>();
        if (pose.tick > present())
            track->add({present(), instance.setup.placement});
    }
    std::lock_guard lock(presentation_);
    if (isNew)
        at = motions_.insert(at, {id, std::move(track)});
    at->track->add(pose);
    visibilityStale_ = true; // a scene at rest would not look at its motions
    return {};
}

void Scene::endMotion(LocalId id)
{
    const auto at = inMotion(id);
    if (at == motions_.end() || at->id != id)
        return;
    std::lock_guard lock(presentation_);
    motions_.erase(at);
}

/// Before the step that ends at `to`.
void Scene::followMotions(base::Ticks to)
{
    bool isAhead = false;
    for (const InMotion& one : motions_) {
        Instance& instance = *instances_.find(one.id);
        isAhead = isAhead || one.track->newest() > to;
        const bool isDormant = instance.state == InstanceState::Dormant;
        const base::Placement placement =
            one.track->at(isDormant ? std::max(to - clock_.stepTicks(), instance.setup.startTick) : to);
        const base::Placement& before = instance.setup.placement;
        if (placement.position == before.position && placement.rotation == before.rotation &&
            placement.scale == before.scale)
            continue;
        if (!isDormant)
            world_.setPlacement(instance.slot, placement); // may throw; the next step tries again
        placeAt(one.id, instance, placement);
    }
    if (isAhead)
        visibilityStale_ = true; // the next steps are not those of a scene at rest
}

Presentation Scene::acquire(std::pmr::vector<base::ShownPlacement>& outShown)
{
    outShown.clear();
    std::lock_guard lock(presentation_);
    Presentation shown{ring_.acquire(), interpolation_.load(std::memory_order_relaxed),
                       shownTime_.load(std::memory_order_relaxed), hints_.load(std::memory_order_relaxed)};
    if (motions_.empty() || !shown.snapshots.newer)
        return shown;
    try {
        const base::Ticks now =
            shown.snapshots.newer->tick() + base::Ticks(shown.interpolation * double(clock_.stepTicks()));
        outShown.reserve(motions_.size());
        for (const InMotion& one : motions_)
            outShown.push_back({one.id, one.track->at(now)});
        shown.snapshots.shown = outShown;
    } catch (const std::bad_alloc&) {
        outShown.clear(); // shown at the places of the snapshots
    }
    return shown;
}

} // namespace fx::scene
