// Instances that follow paths of the host: at the end of each step they stand where their path is.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <optional>
#include <utility>

namespace fx::scene {

namespace {

/// Lets the bounds of an instance know from where it comes in a step, because births may inherit its
/// velocity.
class CameFrom
{
public:
    /// @param from null: from nowhere
    CameFrom(InstanceSetup& io, const base::Placement* from) : setup_(io), before_(io.cameFrom)
    {
        if (from)
            setup_.cameFrom = *from;
    }
    ~CameFrom() { setup_.cameFrom = before_; }
    CameFrom(const CameFrom&) = delete;
    CameFrom& operator=(const CameFrom&) = delete;

private:
    InstanceSetup& setup_;
    const std::optional<base::Placement> before_;
};

/// @return false: no memory
bool hasRoomFor(size_t count, std::pmr::vector<base::ShownPlacement>& io)
{
    try {
        io.reserve(count);
    } catch (const std::bad_alloc&) {
        return false;
    }
    return true;
}

} // namespace

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
    if (at == motions_.end() || at->id != id) {
        beginMotion(id, instance, pose);
    } else {
        const bool isFull = at->track->isFull(pose.tick);
        if (isFull && at->track->second() > clock_.now())
            return {base::Code::Capacity, "the motion has as many poses in the future as an instance keeps"};
        const bool isLate = isFull && at->track->second() > clock_.simulated(); // the steps are not there yet
        std::lock_guard lock(presentation_);
        if (isLate)
            at->track->removeSecond();
        at->track->add(pose);
    }
    visibilityStale_ = true; // a scene at rest would not look at its motions
    return {};
}

/// The first pose of an instance. The mutex is not held while memory is allocated or freed, because the
/// host's allocator may call. Strong guarantee.
void Scene::beginMotion(LocalId id, const Instance& instance, const MotionPose& pose)
{
    auto track = std::make_unique<MotionTrack>();
    if (pose.tick > present())
        track->add({present(), instance.setup.placement});
    track->add(pose);
    std::pmr::vector<InMotion> grown(motions_.get_allocator());
    const bool grows = motions_.size() == motions_.capacity();
    if (grows)
        grown.reserve(2 * motions_.size() + 1);
    std::lock_guard lock(presentation_);
    if (grows) {
        std::move(motions_.begin(), motions_.end(), std::back_inserter(grown));
        motions_.swap(grown);
    }
    motions_.insert(inMotion(id), {id, std::move(track)});
}

void Scene::endMotion(LocalId id)
{
    const auto at = inMotion(id);
    if (at == motions_.end() || at->id != id)
        return;
    std::unique_ptr<MotionTrack> ended; // outlives the lock
    std::lock_guard lock(presentation_);
    ended = std::move(at->track);
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
        const bool stays = instance.setup.effect->dependsOnPlacement();
        // What starts within the step starts where its path is at the end: from the place at the start, it
        // would go two steps' way in the next one.
        const base::Placement placement = one.track->at(to);
        const base::Placement before = instance.setup.placement;
        if (placement.position == before.position && placement.rotation == before.rotation &&
            placement.scale == before.scale)
            continue;
        if (!isDormant)
            world_.setPlacement(instance.slot, placement); // may throw; the next step tries again
        const CameFrom way(instance.setup, stays && !isDormant ? &before : nullptr);
        placeAt(one.id, instance, placement);
    }
    if (isAhead)
        visibilityStale_ = true; // the next steps are not those of a scene at rest
}

Presentation Scene::acquire(std::pmr::vector<base::ShownPlacement>& outShown)
{
    outShown.clear();
    bool hasRoom = true;
    std::unique_lock lock(presentation_);
    while (hasRoom && outShown.capacity() < motions_.size()) {
        const size_t count = motions_.size();
        lock.unlock(); // the host's allocator may call
        hasRoom = hasRoomFor(count, outShown);
        lock.lock();
    }
    Presentation shown{ring_.acquire(), interpolation_.load(std::memory_order_relaxed),
                       shownTime_.load(std::memory_order_relaxed), hints_.load(std::memory_order_relaxed)};
    if (motions_.empty() || !shown.snapshots.newer || !hasRoom) // without room, at the places of snapshots
        return shown;
    const base::Ticks now =
        shown.snapshots.newer->tick() + base::Ticks(shown.interpolation * double(clock_.stepTicks()));
    for (const InMotion& one : motions_)
        outShown.push_back({one.id, one.track->at(now)}); // has room
    shown.snapshots.shown = outShown;
    return shown;
}

} // namespace fx::scene
