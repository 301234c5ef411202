/// @file snapshot_ring.h
/// Passes snapshots from the scene thread to readers, without copying and without waiting.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <array>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace fx::base {

/// The place at which a frame shows an instance, instead of the places in the snapshots.
struct ShownPlacement
{
    uint64_t instance = 0;
    Placement placement;
};

/// A snapshot and the snapshot published before it. Both snapshots stay valid and constant until release().
struct SnapshotPair
{
    const FrameSnapshot* newer = nullptr; ///< null before the first publication
    const FrameSnapshot* older = nullptr; ///< null before the second publication
    /// Instances that the frame shows elsewhere, ascending by instance.
    std::span<const ShownPlacement> shown{};
};

/// Snapshots in rotation: the two newest published snapshots, the snapshot that is being written, and the
/// snapshots that readers hold. The scene thread calls beginWrite() and publish(). Any thread may call
/// acquire() and release(), in pairs.
class SnapshotRing
{
public:
    SnapshotRing(const SnapshotSchema* schema, std::pmr::memory_resource* memory);

    /// Begins to write a snapshot.
    /// @param step [tick] length of the step that ends at `tick`; 0 if no step ends there
    /// @return a snapshot without readers, cleared for writing; if readers hold all snapshots, a new snapshot
    ///         is added
    FrameSnapshot& beginWrite(Ticks tick, Ticks step = 0);
    /// Makes the written snapshot the newest one. The snapshot must not be changed afterwards.
    void publish();
    /// Ends writing without publication. The written snapshot becomes SnapshotPair::older at the next
    /// publication, instead of the snapshot that is the newest now.
    void stageOlder();
    /// Sets SnapshotPair::older to null, for a jump in time between the two snapshots.
    void forgetOlder();

    /// Calls f(snapshot) for every snapshot that the ring will write, so that f can add or drop spare memory.
    /// Snapshots that readers hold are replaced by new ones. [writing thread, not between beginWrite() and
    /// publish()]
    template <class F>
    void forEachSpare(F&& f)
    {
        std::lock_guard lock(mutex_);
        forgetReplaced();
        for (size_t i = 0, count = slots_.size(); i < count; ++i) {
            if (slots_[i].isReplaced)
                continue;
            if (slots_[i].readers > 0) {
                auto replacement = std::make_unique<FrameSnapshot>(schema_, memory_);
                f(*replacement);
                slots_.push_back({std::move(replacement)});
                slots_[i].isReplaced = true;
            } else {
                f(*slots_[i].snapshot);
            }
        }
    }

    SnapshotPair acquire();
    void release(const SnapshotPair& pair);

private:
    struct Slot
    {
        std::unique_ptr<FrameSnapshot> snapshot;
        int readers = 0;
        bool isReplaced = false; ///< true: the snapshot is not written again
    };
    void forgetReplaced();
    bool isInUse(const Slot& slot) const
    {
        const FrameSnapshot* const snapshot = slot.snapshot.get();
        return slot.readers > 0 || snapshot == newest_ || snapshot == previous_ || snapshot == staged_;
    }
    Slot* slotOf(const FrameSnapshot* snapshot);

    const SnapshotSchema* schema_;
    std::pmr::memory_resource* memory_;
    std::mutex mutex_; ///< guards the members below, not the snapshots' contents
    std::vector<Slot> slots_;
    FrameSnapshot* writing_ = nullptr;
    FrameSnapshot* newest_ = nullptr;
    FrameSnapshot* previous_ = nullptr;
    /// Snapshot that becomes previous_ at the next publication; null: newest_ becomes previous_.
    FrameSnapshot* staged_ = nullptr;
    uint64_t sequence_ = 0;
};

} // namespace fx::base
