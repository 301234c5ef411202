/// @file snapshot_revisions.h
/// Revisions of snapshots. Equal revisions mean equal content, so that data derived from the content can be
/// reused.
///
/// Threads: one thread at a time. A frame allocates nothing if an earlier frame was at least as large.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/frame/row_revisions.h"

#include <array>
#include <cstdint>

namespace fx::render {

/// Tests whether all groups, ids, columns, constants and placements of two snapshots are equal, bit for bit.
/// The comparison ends at the first difference, so it is cheap for snapshots of moving particles. Pooled
/// rows are compared in the order of the pool. Snapshots with equal rows in a different order count as
/// different.
bool holdSame(const base::FrameSnapshot& a, const base::FrameSnapshot& b);

/// Revisions of the two snapshots of a frame. A revision is 0 if the snapshot does not exist.
struct RevisionPair
{
    uint64_t newer = 0;
    uint64_t older = 0;

    bool operator==(const RevisionPair&) const = default;
    /// True if both snapshots have equal content.
    bool isSteady() const { return newer == older; }
};

/// Assigns revisions to snapshots. A snapshot is compared once with its predecessor, and gets the same
/// revision if the content is equal. While nothing moves in a scene, all snapshots have the same revision.
class SnapshotRevisions
{
public:
    explicit SnapshotRevisions(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : rowKinds_(memory),
          rowIds_(memory), known_{Known(memory), Known(memory), Known(memory), Known(memory)}
    {}

    /// Requests that from the next snapshot on, rows of groups of `kind` also get revisions. `kind` must stay
    /// valid.
    void stampRowsOf(const base::KindDesc& kind) { rowKinds_.push_back(&kind); }

    RevisionPair revisionsOf(const base::SnapshotPair& snapshots);
    /// Revisions of the rows of a snapshot that was passed to the last revisionsOf(); valid until the next
    /// call of revisionsOf().
    SnapshotRowRevisions rowsOf(const base::FrameSnapshot& snapshot) const;

private:
    struct Known
    {
        explicit Known(std::pmr::memory_resource* memory) : rows(memory) {}

        uint64_t snapshot = 0; ///< FrameSnapshot::serial() of the snapshot; 0: the entry is unused
        uint64_t revision = 0;
        RowRevisions rows;
    };
    const Known* find(const base::FrameSnapshot& snapshot) const; ///< null if `snapshot` is not in known_
    void remember(const base::FrameSnapshot& snapshot, const base::FrameSnapshot* older, uint64_t revision);

    std::pmr::vector<const base::KindDesc*> rowKinds_;
    std::pmr::vector<base::KindId> rowIds_; ///< ids of rowKinds_ in the schema of the last snapshot
    std::array<Known, 4> known_;
    size_t next_ = 0; ///< index in known_ of the entry that is overwritten next
    uint64_t last_ = 0;
    uint64_t lastRows_ = 0;
};

} // namespace fx::render
