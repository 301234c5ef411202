/// @file row_revisions.h
/// Revisions of the rows of particles and ribbons, by group. Equal revisions mean equal rows. Rows get equal
/// revisions if they have not changed since an earlier snapshot, or if instances share one simulation.
///
/// Threads: one thread at a time. A frame allocates nothing if an earlier frame was at least as large.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// A range of rows of a group. Ranges with equal revisions other than 0 have equal columns, bit for bit.
struct RowRevision
{
    uint32_t first = 0, count = 0;
    uint64_t revision = 0; ///< revision of the columns; 0: the content is unknown

    bool operator==(const RowRevision&) const = default;
};

/// Revisions of the rows of all groups of a snapshot.
struct SnapshotRowRevisions
{
    std::span<const RowRevision> parts; ///< ranges of all groups, one group after another
    /// Index of the first part of each group, followed by the number of parts. Empty: each group has one
    /// part.
    std::span<const size_t> begin;
    /// For each group: index of the first group with equal rows, possibly the group itself. Empty: all
    /// groups differ.
    std::span<const uint32_t> alike;

    std::span<const RowRevision> of(size_t group) const
    {
        return begin.empty() ? parts.subspan(group, 1)
                             : parts.subspan(begin[group], begin[group + 1] - begin[group]);
    }
    size_t alikeOf(size_t group) const { return alike.empty() ? group : alike[group]; }
};

/// Tests whether the columns of two groups of one kind are equal, bit for bit; ids, constants and placements
/// may differ.
bool haveSameRows(const base::SnapshotGroup& a, const base::SnapshotGroup& b,
                  std::span<const base::ColumnDesc> columns);

/// Tests whether two pools of successive snapshots have equal data in all rows, including rows of dead
/// particles. Also returns false if a comparison would be expensive.
bool haveSameRows(const base::PooledRows& a, const base::PooledRows& b,
                  std::span<const base::ColumnDesc> columns);

/// Finds the pools of two snapshots that have equal rows.
class SamePools
{
public:
    explicit SamePools(std::pmr::memory_resource* memory) : same_(memory) {}
    /// Compares the pools of two snapshots.
    /// @param older may be null
    void build(const base::FrameSnapshot& newer, const base::FrameSnapshot* older);
    bool holdSame(const base::GroupRoster::Entry& newer, const base::GroupRoster::Entry& older) const
    {
        return newer.member == older.member && same_[newer.pool] == older.pool;
    }

private:
    static constexpr uint32_t kNone = ~0u;
    /// For each pool of the newer snapshot: index of the equal pool of the older snapshot, or kNone.
    std::pmr::vector<uint32_t> same_;
};

/// Assigns revisions to the rows of groups, for successive snapshots.
class RowRevisions
{
public:
    explicit RowRevisions(std::pmr::memory_resource* memory)
        : parts_(memory), before_(memory), alike_(memory), table_(memory), pools_(memory)
    {}

    /// Assigns a revision to the rows of each group.
    /// @param older null, or a snapshot of the same scene; rows that are equal in both snapshots get equal
    ///         revisions
    /// @param before revisions of the rows of `older`; empty: the revisions are unknown
    /// @param kinds kinds of groups that get revisions; pools always get revisions
    /// @param ioLast last assigned revision; increased for each new revision
    void build(const base::FrameSnapshot& newer, const base::FrameSnapshot* older,
               const SnapshotRowRevisions& before, std::span<const base::KindId> kinds, uint64_t& ioLast);
    SnapshotRowRevisions revisions() const { return {parts_, {}, alike_}; }

private:
    uint64_t revisionOf(const base::FrameSnapshot& newer, size_t group, const base::FrameSnapshot* older,
                        uint64_t& ioLast) const;
    void findAlike(const base::FrameSnapshot& snapshot, size_t group);

    std::pmr::vector<RowRevision> parts_;
    std::pmr::vector<RowRevision> before_;
    std::pmr::vector<uint32_t> alike_;
    /// Hash table of groups with open addressing; the hash uses a sample of the rows.
    std::pmr::vector<uint32_t> table_;
    SamePools pools_;
};

} // namespace fx::render
