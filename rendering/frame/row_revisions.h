/// @file row_revisions.h
/// Revisions of rows of particles and ribbons, by group. Equal revisions show that rows have been uploaded
/// before, or that several groups have the same rows, as instances of a shared simulation.
///
/// Threads: one thread at a time. Frames that are no larger than one before allocate nothing.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Some rows of a group. Equal numbers other than 0 mean equal columns, bit for bit.
struct RowRevision
{
    uint32_t first = 0, count = 0;
    uint64_t revision = 0; ///< 0: nothing is known

    bool operator==(const RowRevision&) const = default;
};

/// Revisions of the rows of all groups of a snapshot.
struct SnapshotRowRevisions
{
    std::span<const RowRevision> parts; ///< of all groups, one after the other
    std::span<const size_t> begin;      ///< of each group, and the end; empty: one part a group
    std::span<const uint32_t> alike;    ///< first group with the same rows, or the group; empty: all differ

    std::span<const RowRevision> of(size_t group) const
    {
        return begin.empty() ? parts.subspan(group, 1)
                             : parts.subspan(begin[group], begin[group + 1] - begin[group]);
    }
    size_t alikeOf(size_t group) const { return alike.empty() ? group : alike[group]; }
};

/// Whether the columns of two groups of one kind are the same, bit for bit; ids, constants and placements may
/// differ.
bool haveSameRows(const base::SnapshotGroup& a, const base::SnapshotGroup& b,
                  std::span<const base::ColumnDesc> columns);

/// Whether two pools that were written one after the other have equal data in all rows, including rows of
/// dead particles. Also false where a comparison would be expensive.
bool haveSameRows(const base::PooledRows& a, const base::PooledRows& b,
                  std::span<const base::ColumnDesc> columns);

/// Whether two groups are in pools with equal rows.
class SamePools
{
public:
    explicit SamePools(std::pmr::memory_resource* memory) : same_(memory) {}
    /// @param older may be null
    void build(const base::FrameSnapshot& newer, const base::FrameSnapshot* older);
    bool holdSame(const base::GroupRoster::Entry& newer, const base::GroupRoster::Entry& older) const
    {
        return newer.member == older.member && same_[newer.pool] == older.pool;
    }

private:
    static constexpr uint32_t kNone = ~0u;
    std::pmr::vector<uint32_t> same_; ///< by pool of the newer snapshot: of the older one
};

/// Gives revisions to the groups of some kinds of snapshots that follow each other.
class RowRevisions
{
public:
    explicit RowRevisions(std::pmr::memory_resource* memory)
        : parts_(memory), before_(memory), alike_(memory), table_(memory), pools_(memory)
    {}

    /// @param older null, or a snapshot of the same scene; rows that it shares with `newer` get the same
    ///         revisions
    /// @param before revisions of `older`; unknown without parts
    /// @param kinds kinds that get revisions; pools always get them
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
    std::pmr::vector<uint32_t> table_; ///< groups by a sample of their rows; open addressing
    SamePools pools_;
};

} // namespace fx::render
