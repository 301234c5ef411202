/// @file pool_scatter.h
/// Copies the rows of pools to merged groups, in one pass over each pool.
///
/// Threads: one thread at a time. A frame allocates nothing if an earlier frame was at least as large.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/particle_kind.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

class PoolScatter
{
public:
    explicit PoolScatter(std::pmr::memory_resource* memory);

    /// Begins a new copy.
    /// @param snapshot snapshot to whose roster the entries belong
    /// @param groups number of merged groups
    void begin(const base::FrameSnapshot& snapshot, size_t groups);
    /// Requests that run() copies the rows of `entry` to the merged group with the index `group`. The copied
    /// rows begin at `firstRow`, where `rows` rows are reserved.
    void send(const base::GroupRoster::Entry& entry, uint32_t group, uint32_t firstRow, uint32_t rows)
    {
        targets_[first_[entry.pool] + entry.member] = {&entry, group, firstRow, rows};
        isSentTo_[group] = 1;
    }
    /// Writes all columns of non-empty rows. Orientations are rotated. Reserved rows without a source are
    /// set to 0.
    /// @param groups the merged groups, whose count() is already set; groups without a source do not change
    void run(const base::FrameSnapshot& snapshot, std::span<base::SnapshotGroup* const> groups);
    /// Extent of the rows of an entry. The pool of the entry must have velocities.
    const base::RowExtent& extentOf(const base::GroupRoster::Entry& entry) const
    {
        return extents_[first_[entry.pool] + entry.member];
    }

private:
    struct Target
    {
        const base::GroupRoster::Entry* entry = nullptr; ///< null: the entry is not copied
        uint32_t group = 0, firstRow = 0, rows = 0;
    };
    struct Move
    {
        uint32_t from, to; ///< rows in the pool and in the merged group
    };
    void list(const base::PooledRows& pool, std::span<const Target> targets,
              std::span<base::RowExtent> extents);
    void move(const base::PooledRows& pool, std::span<const base::ColumnDesc> columns, uint32_t group,
              base::SnapshotGroup& out) const;
    void turn(const base::PooledRows& pool, std::span<const Target> targets, uint32_t group,
              base::SnapshotGroup& out) const;
    std::span<const Move> movesOf(uint32_t group) const
    {
        return {moves_.data() + begin_[group], ends_[group] - begin_[group]};
    }

    std::pmr::vector<size_t> first_;   ///< for each pool: index of its first member in targets_
    std::pmr::vector<Target> targets_; ///< one target for each member, pool after pool
    /// For each member: extent of its rows. Empty if there are no velocities.
    std::pmr::vector<base::RowExtent> extents_;
    std::pmr::vector<Move> moves_;       ///< rows of one pool to copy, group after group
    std::pmr::vector<uint32_t> begin_;   ///< for each group: begin of its range in moves_
    std::pmr::vector<uint32_t> ends_;    ///< for each group: end of its range in moves_
    std::pmr::vector<uint8_t> isSentTo_; ///< for each group: 1 if send() was called for the group
};

} // namespace fx::render
