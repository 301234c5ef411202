/// @file held_snapshots.h
/// The snapshots that hosts hold now. [any thread]
#pragma once

#include "foundation/snapshot/gpu_particles.h"
#include "fxsdk/api/host_snapshot.h"
#include "fxsdk/scene/scene.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <optional>

namespace fx::api {

class HeldSnapshots
{
public:
    static constexpr uint32_t kCapacity = 16;

    /// Adds a snapshot. Computes GPU particles of the snapshot on the CPU, and converts it to the host's
    /// world.
    /// @return an id for find() and take(); 0 if kCapacity snapshots are held; then `presentation` is not
    ///         added
    scene::LocalId add(const scene::Presentation& presentation, const HostWorld& world,
                       std::pmr::memory_resource* memory)
    {
        Held held{presentation, presentation.snapshots, {}};
        held.replay(held.shown.snapshots.newer, 0, memory);
        held.replay(held.shown.snapshots.older, 1, memory);
        if (!world.isLibraryWorld()) {
            held.convert(held.shown.snapshots.newer, 0, world, memory);
            held.convert(held.shown.snapshots.older, 1, world, memory);
        }
        std::lock_guard lock(mutex_);
        for (uint32_t i = 0; i < kCapacity; ++i) {
            Slot& slot = slots_[i];
            if (slot.held || slot.use == scene::kIdPartMask)
                continue;
            slot.held = std::move(held);
            return (uint64_t(++slot.use) << scene::kIdPartBits) | i;
        }
        return 0;
    }

    std::optional<scene::Presentation> find(scene::LocalId id)
    {
        std::lock_guard lock(mutex_);
        const Slot* slot = slotOf(id);
        return slot && slot->held ? std::optional(slot->held->shown) : std::nullopt;
    }

    bool any()
    {
        std::lock_guard lock(mutex_);
        return std::any_of(slots_.begin(), slots_.end(),
                           [](const Slot& slot) { return slot.held.has_value(); });
    }

    /// Removes the snapshot and returns it for release. Empty when the id is stale.
    std::optional<base::SnapshotPair> take(scene::LocalId id)
    {
        std::optional<Held>
            gone; // destroyed after unlocking, because the host's release callback may call the API
        {
            std::lock_guard lock(mutex_);
            Slot* slot = slotOf(id);
            if (slot)
                gone = std::exchange(slot->held, std::nullopt);
        }
        return gone ? std::optional(gone->taken) : std::nullopt;
    }

private:
    struct Held
    {
        scene::Presentation shown;
        base::SnapshotPair taken; ///< snapshots acquired from the scene
        /// Copies of snapshots with GPU particles, or for a host whose world is not that of the library. In
        /// the copies, the GPU particles are computed. Null for a snapshot that needs no copy.
        std::array<std::unique_ptr<base::FrameSnapshot>, 2> copies;

        void replay(const base::FrameSnapshot*& io, size_t which, std::pmr::memory_resource* memory)
        {
            if (!io || !base::hasGpuParticles(*io))
                return;
            copies[which] = base::replayOnCpu(*io, memory);
            io = copies[which].get();
        }
        void convert(const base::FrameSnapshot*& io, size_t which, const HostWorld& world,
                     std::pmr::memory_resource* memory)
        {
            if (!io)
                return;
            copies[which] = toHostWorld(world, *io, memory);
            io = copies[which].get();
        }
    };
    struct Slot
    {
        std::optional<Held> held;
        uint32_t use = 0;
    };

    Slot* slotOf(scene::LocalId id)
    {
        const uint32_t index = scene::indexOf(id);
        if (index >= kCapacity || slots_[index].use != id >> scene::kIdPartBits)
            return nullptr;
        return &slots_[index];
    }

    std::mutex mutex_;
    std::array<Slot, kCapacity> slots_;
};

} // namespace fx::api
