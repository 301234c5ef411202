/// @file snapshot_ring.h
/// Passes snapshots from the scene thread to readers, without copying and without waiting.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <array>
#include <memory>
#include <memory_resource>
#include <mutex>

namespace fx::base {

/// A snapshot and the snapshot published before it. Both snapshots stay valid and constant until release().
struct SnapshotPair
{
    const FrameSnapshot* newer = nullptr; ///< null before the first publication
    const FrameSnapshot* older = nullptr; ///< null before the second publication
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

    SnapshotPair acquire();
    void release(const SnapshotPair& pair);

private:
    struct Slot
    {
        std::unique_ptr<FrameSnapshot> snapshot;
        int readers = 0;
    };
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
