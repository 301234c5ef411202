/// @file merged_rows.h
/// Transforms the rows of many groups to the spaces of a few merged groups, and writes the rows to these
/// groups.
///
/// Threads: one thread at a time. A frame allocates nothing if an earlier frame was at least as large.
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

/// A group of a snapshot, whose rows are merged. The rows may be pooled.
struct MergeSource
{
    /// Columns and constants of the group; null: there is no group.
    const base::SnapshotGroup* rows = nullptr;
    const base::PooledRows* pool = nullptr; ///< pool that contains the rows; null: the group is not pooled
    /// Roster entry of a pooled group; null: the group is not pooled.
    const base::GroupRoster::Entry* entry = nullptr;
    uint32_t count = 0;

    /// Number of rows to reserve in the merged group; constant over all snapshots for pooled groups.
    uint32_t room() const { return pool ? std::max(count, pool->groupCapacity) : count; }
    const base::Placement& placement() const { return entry ? entry->placement : rows->info().placement; }
};

/// Collects the groups to merge, then writes their rows.
class MergedRows
{
public:
    explicit MergedRows(std::pmr::memory_resource* memory);

    void begin(const base::FrameSnapshot& from, base::FrameSnapshot& to);
    /// Adds a merged group with `rows` rows. Columns, constants and position are copied from `like`.
    /// @param technique technique with a RowMerge, which must stay valid
    void addGroup(const RowTechnique& technique, const MergeSource& like, uint32_t rows);
    /// Fills `rows` rows of the last added group, from `firstRow` on, with the rows of `from`. If `from` has
    /// fewer rows, the remaining rows are empty.
    /// @param number number of the member, >= 1; included in strip numbers, so that different members have
    ///     different strip numbers
    void addRows(const MergeSource& from, uint32_t firstRow, uint32_t rows, uint32_t number);
    /// Writes all merged groups. A merged group gets bounds if all its members have bounds.
    void write();
    /// Bounds of the source group of call number `index` of addRows(), in the local space of the source
    /// group. Valid after write().
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
    std::pmr::vector<size_t> begin_;                   ///< for each merged group: index of its first member
    std::pmr::vector<const RowTechnique*> techniques_; ///< one technique for each merged group
    std::pmr::vector<base::SnapshotGroup*> groups_;
    std::pmr::vector<PlacedRows> placed_; ///< rows of one merged group
    bool anyPooled_ = false;
};

} // namespace fx::render
