/// @file merged_rows.h
/// Rows of many groups are written into few, in one space each.
///
/// Threads: one thread at a time. Frames that are no larger than one before allocate nothing.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/particle_rows/pool_scatter.h"
#include "rendering/particle_rows/row_placing.h"
#include "rendering/particle_rows/row_technique.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// A group of a snapshot whose rows are to be merged, in a pool or not.
struct MergeSource
/// columns and constants; null: no group
{
    const base::SnapshotGroup* rows = nullptr;
    const base::PooledRows* pool = nullptr; ///< the rows are those of a pool, and
    /// The group is an entry of a pool; otherwise both are null.
    const base::GroupRoster::Entry* entry = nullptr;
    uint32_t count = 0;

    /// Rows to be kept free for it: the same in all snapshots where the rows are in a pool.
    uint32_t room() const { return pool ? std::max(count, pool->groupCapacity) : count; }
    const base::Placement& placement() const { return entry ? entry->placement : rows->info().placement; }
};

/// Collects the groups to merge, then writes their rows.
class MergedRows
{
public:
    explicit MergedRows(std::pmr::memory_resource* memory);

    void begin(const base::FrameSnapshot& from, base::FrameSnapshot& to);
    /// A merged group of `rows` rows that looks like `like`, which its rows become relative to.
    /// @param technique has a RowMerge; must stay
    void addGroup(const RowTechnique& technique, const MergeSource& like, uint32_t rows);
    /// Rows of the group that was added last, from `firstRow` on; those that `from` has not are empty.
    /// @param number of the member, from 1: goes into the numbers of strips
    void addRows(const MergeSource& from, uint32_t firstRow, uint32_t rows, uint32_t number);
    /// Writes all groups, and their bounds where all groups that they are of have some.
    void write();
    /// Bounds of the group of the addRows() with this index, in its own space; after write().
    const base::Bounds& bounds(size_t index) const { return members_[index].bounds; }

private:
    struct Member
    {
        MergeSource from;
        uint32_t group, firstRow, rows, number;
        base::Bounds bounds;
    };

    void place(const RowTechnique& technique, size_t begin, size_t end);
    PlacedRows placing(const Member& member, size_t column, size_t radius) const;
    void copyOthers(const RowTechnique& technique, const Member& member);
    void measure(Member& member, const PlacedRows& placed, base::Bounds& ioBounds, bool& ioBounded) const;

    const base::FrameSnapshot* from_ = nullptr;
    base::FrameSnapshot* to_ = nullptr;
    PoolScatter scatter_;
    std::pmr::vector<Member> members_;
    std::pmr::vector<size_t> begin_;                   ///< by group: of its members
    std::pmr::vector<const RowTechnique*> techniques_; ///< by group
    std::pmr::vector<base::SnapshotGroup*> groups_;
    std::pmr::vector<PlacedRows> placed_; ///< of one group
    bool anyPooled_ = false;
};

} // namespace fx::render
