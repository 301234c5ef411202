/// @file pool_scatter.h
/// Copies the rows of pools to merged groups in one pass over each pool, without gathering single groups.
///
/// Threads: one thread at a time. Frames that are no larger than one before allocate nothing.
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

    /// A snapshot whose entries are to be sent.
    /// @param groups merged groups, of at most `rows` rows each
    void begin(const base::FrameSnapshot& snapshot, size_t groups);
    /// The rows of `entry` go to `rows` of a merged group from `firstRow` on.
    void send(const base::GroupRoster::Entry& entry, uint32_t group, uint32_t firstRow, uint32_t rows)
    {
        targets_[first_[entry.pool] + entry.member] = {&entry, group, firstRow, rows};
        isSentTo_[group] = 1;
    }
    /// Writes all columns of non-empty rows, with rotated orientations; rows without a source are zero.
    /// @param groups each with count() rows; groups without a source do not change
    void run(const base::FrameSnapshot& snapshot, std::span<base::SnapshotGroup* const> groups);
    /// Extent of the rows of an entry whose pool has velocities.
    const base::RowExtent& extentOf(const base::GroupRoster::Entry& entry) const
    {
        return extents_[first_[entry.pool] + entry.member];
    }

private:
    struct Target
    /// null: none
    {
        const base::GroupRoster::Entry* entry = nullptr;
        uint32_t group = 0, firstRow = 0, rows = 0;
    };
    struct Move
    /// rows
    {
        uint32_t from, to;
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

    std::pmr::vector<size_t> first_;            ///< by pool: of its members in targets_
    std::pmr::vector<Target> targets_;          ///< by member, pool after pool
    std::pmr::vector<base::RowExtent> extents_; ///< extents of rows; empty without velocities
    std::pmr::vector<Move> moves_;              ///< of one pool, group after group
    std::pmr::vector<uint32_t> begin_;          ///< by group: in moves_
    std::pmr::vector<uint32_t> ends_;           ///< by group: end of its range in moves_
    std::pmr::vector<uint8_t> isSentTo_;        ///< by group: 1 where rows were uploaded
};

} // namespace fx::render
