/// @file snapshot_ring.h
/// Hands snapshots from the scene thread to readers without copying and without waiting.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <array>
#include <memory>
#include <memory_resource>
#include <mutex>

namespace fx::base {

/// A snapshot together with the one published before it; both stay until release().
struct SnapshotPair
{
    const FrameSnapshot* newer = nullptr; ///< null before the first publication
    const FrameSnapshot* older = nullptr; ///< null before the second
};

/// Snapshots in rotation: the two newest published, one being written, and whatever readers still hold.
/// beginWrite and publish: scene thread. acquire and release: any thread, in pairs.
class SnapshotRing
{
public:
    SnapshotRing(const SnapshotSchema* schema, std::pmr::memory_resource* memory);

    /// @param step [tick] length of the step that ends at `tick`; 0: none does
    /// @return a snapshot without readers, cleared for writing; when all are held, the ring grows by one
    FrameSnapshot& beginWrite(Ticks tick, Ticks step = 0);
    /// Makes what was written the newest. It must not be changed after this.
    void publish();
    /// What was written becomes the predecessor of what is written next, in place of the newest one of now.
    /// Readers see it only when that is published.
    void stageOlder();
    /// The newest has no predecessor any more: time did not lead from that one to it.
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
    FrameSnapshot* staged_ = nullptr; ///< becomes previous_ with the next publication; null: newest_ does
    uint64_t sequence_ = 0;
};

} // namespace fx::base
