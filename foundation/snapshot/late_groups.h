/// @file late_groups.h
/// Groups of a snapshot whose rows are computed when they are first read. Rows that are never read cost
/// nothing.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <atomic>
#include <memory>
#include <mutex>

namespace fx::base {

/// The rows of the late groups of one snapshot. Memory is reused by later publications.
class LateGroups
{
public:
    explicit LateGroups(std::pmr::memory_resource* memory) : memory_(memory) {}

    /// Begins a new publication. Called by the thread that writes the snapshot.
    void clear() { count_ = 0; }
    /// @param place number of the added group, ascending in consecutive calls
    void add(size_t place, LateRows rows);
    /// The group `place` with its rows. Any thread may call this function; concurrent first calls wait for
    /// each other.
    const SnapshotGroup& group(const FrameSnapshot& snapshot, size_t place);

private:
    struct Entry
    {
        explicit Entry(std::pmr::memory_resource* memory) : group(memory) {}
        SnapshotGroup group;
        LateRows rows = nullptr;
        size_t place = 0;
        std::atomic<bool> isDone{false}; ///< true: `group` is constant until the next publication
    };

    std::pmr::memory_resource* memory_;
    std::mutex mutex_; ///< guards the groups of entries while they are computed
    size_t count_ = 0; ///< the first count_ entries are valid
    std::vector<std::unique_ptr<Entry>> entries_;
};

} // namespace fx::base
