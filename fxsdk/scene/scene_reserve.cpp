// Memory of instances that is allocated in advance.
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <new>
#include <string>

namespace fx::scene {

namespace {

/// [byte] Estimated memory of an instance: that of its solvers and snapshots.
uint64_t bytesOf(const sim::EffectDef& effect, sim::QualityLevel level)
{
    const uint64_t bytes = std::max(effect.cost.memory, effect.bytes());
    return uint64_t(double(bytes) * std::max(double(sim::qualityOf(level).particles), 1.0));
}

} // namespace

std::optional<Scene::Reservation> Scene::reservation(const sim::EffectDef& effect,
                                                     sim::QualityLevel level) const
{
    const auto found = world_.reservations().reservation(effect, level);
    if (!found)
        return std::nullopt;
    return Reservation{found->effect, level, found->count, found->idle, bytesOf(effect, level) * found->count,
                       found->misses};
}

base::Status Scene::reserve(const std::shared_ptr<const sim::EffectDef>& effect, sim::QualityLevel level,
                            uint32_t count)
{
    const auto isIt = [&](const Reservation& one) { return one.effect == effect && one.level == level; };
    uint64_t others = 0;
    for (const Reservation& one : reservations_)
        others += isIt(one) ? 0 : one.bytes;
    const uint64_t bytes = bytesOf(*effect, level) * count;
    if (count > 0 && (bytes > options_.reserveLimit || others > options_.reserveLimit - bytes))
        return {base::Code::Capacity,
                "the reservation needs about " + std::to_string(bytes) + " bytes for " +
                    std::to_string(count) + " instances, and others of the scene hold " +
                    std::to_string(others) + "; the limit is " + std::to_string(options_.reserveLimit) +
                    " bytes: reserve fewer instances, or raise FxSceneDef::reserveLimit"};
    completeStep();
    reservations_.reserve(reservations_.size() + 1);
    if (count > 0)
        reserveLists(world_.reservations().idleAfter(*effect, level, count));
    const uint32_t before =
        world_.reservations().reservation(*effect, level).value_or(sim::SimulationPool::Reservation{}).count;
    const uint32_t made = world_.reserve(effect, level, count);
    try {
        if (made > 0)
            world_.rehearse(effect, level);
        if (count > before) // also of instances that exist, which not all snapshots may have yet
            ring_.forEachSpare([&](base::FrameSnapshot& snapshot) {
                addSnapshotRoom(snapshot, *effect, level, count - before);
            });
    } catch (...) {
        world_.shrinkReservation(*effect, level, before);
        renewSnapshotRoom();
        throw;
    }
    std::erase_if(reservations_, isIt);
    if (count > 0)
        reservations_.push_back({effect, level, count, 0, bytes, 0});
    reservedBytes_.store(count > 0 ? others + bytes : others, std::memory_order_relaxed);
    if (count < before)
        renewSnapshotRoom();
    return {};
}

/// Room for `more` instances in everything that instances are listed in.
void Scene::reserveLists(size_t more)
{
    const size_t most = std::min<size_t>(instances_.count() + more, options_.maxInstances);
    instances_.reserve(most);
    active_.reserve(most);
    waking_.reserve(most);
    dormant_.reserve(uint32_t(most), most);
    alarms_.reserve(uint32_t(most), most);
    arrived_.reserve(most);
    moved_.reserve(most);
}

/// Room for the groups of `count` more instances in a snapshot.
void Scene::addSnapshotRoom(base::FrameSnapshot& snapshot, const sim::EffectDef& effect,
                            sim::QualityLevel level, uint32_t count) const
{
    snapshot.addSpares([&](base::FrameSnapshot& spare) {
        for (uint32_t i = 0; i < count; ++i)
            world_.reservations().publishReserved(effect, level, spare);
    });
}

/// Frees the room in snapshots that is beyond the reservations of the scene. Never fails: if memory runs out,
/// snapshots allocate what is missing when they are written.
void Scene::renewSnapshotRoom()
{
    try {
        ring_.forEachSpare([this](base::FrameSnapshot& snapshot) {
            snapshot.dropSpares();
            for (const Reservation& one : reservations_)
                addSnapshotRoom(snapshot, *one.effect, one.level, one.count);
        });
    } catch (const std::bad_alloc&) {
    }
}

} // namespace fx::scene
