/// @file snapshot_revisions.h
/// Revisions of snapshots. Equal revisions mean equal content, so that data derived from it can be reused.
///
/// Threads: one thread at a time. Frames that are no larger than one before allocate nothing.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/frame/row_revisions.h"

#include <array>
#include <cstdint>

namespace fx::render {

/// Whether every group, id, column, constant and placement is the same, bit for bit. The comparison ends at
/// the first difference, so it is cheap for snapshots of moving particles. Rows of pools are compared where
/// they lie; the same groups in another order of rows count as different.
bool holdSame(const base::FrameSnapshot& a, const base::FrameSnapshot& b);

/// Revisions of the two snapshots of a frame; 0: no snapshot.
struct RevisionPair
{
    uint64_t newer = 0;
    uint64_t older = 0;

    bool operator==(const RevisionPair&) const = default;
    bool isSteady() const { return newer == older; } ///< any moment between the two looks the same
};

/// Gives every content its own revision. A snapshot is compared with its predecessor once; scenes in which
/// nothing moves keep their revision however often they publish.
class SnapshotRevisions
{
public:
    explicit SnapshotRevisions(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : rowKinds_(memory),
          rowIds_(memory), known_{Known(memory), Known(memory), Known(memory), Known(memory)}
    {}

    /// Revisions rows of groups of `kind`, which must stay, from the next snapshot on.
    void stampRowsOf(const base::KindDesc& kind) { rowKinds_.push_back(&kind); }

    RevisionPair revisionsOf(const base::SnapshotPair& snapshots);
    /// Revisions of the rows of a snapshot of the last revisionsOf(); valid until the next one.
    SnapshotRowRevisions rowsOf(const base::FrameSnapshot& snapshot) const;

private:
    struct Known
    {
        explicit Known(std::pmr::memory_resource* memory) : rows(memory) {}

        uint64_t snapshot = 0; ///< serial; 0: none
        uint64_t revision = 0;
        RowRevisions rows;
    };
    const Known* find(const base::FrameSnapshot& snapshot) const; ///< null: not known
    void remember(const base::FrameSnapshot& snapshot, const base::FrameSnapshot* older, uint64_t revision);

    std::pmr::vector<const base::KindDesc*> rowKinds_;
    std::pmr::vector<base::KindId> rowIds_; ///< of rowKinds_ in the schema of the last snapshot
    std::array<Known, 4> known_;
    size_t next_ = 0; ///< of known_, to be overwritten
    uint64_t last_ = 0;
    uint64_t lastRows_ = 0;
};

} // namespace fx::render
