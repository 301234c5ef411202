/// @file frame_snapshot.h
/// The state of a scene after one step, as rendering and hosts see it: the only place where both sides meet.
///
/// A snapshot is a list of groups in creation order. A group holds the elements of one kind that one solver
/// of one instance published: typed columns, shared constants, bounds, and an id per element by which the
/// same element is found in the snapshot before. Many small groups of one kind may be published as one pool
/// of rows, see pooled_groups.h; readers of the snapshot see ordinary groups. Threads: written by one thread,
/// then published through a SnapshotRing and never changed again; read by any.
#pragma once

#include "foundation/snapshot/pooled_groups.h"
#include "foundation/snapshot/snapshot_group.h"
#include "foundation/time/ticks.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::base {

/// Identifies the instance and solver that published a group; equal in all snapshots of a scene.
struct GroupName
{
    uint64_t instance = 0;
    uint32_t solver = 0;
    KindId kind = 0;

    bool operator==(const GroupName&) const = default;
};

inline GroupName nameOf(const GroupInfo& info)
{
    return {info.instance, info.solver, info.kind};
}

/// All groups after the step that ended at `tick`.
class FrameSnapshot
{
public:
    FrameSnapshot(const SnapshotSchema* schema, std::pmr::memory_resource* memory);

    const SnapshotSchema& schema() const { return *schema_; }
    std::pmr::memory_resource* memory() const { return memory_; }
    Ticks tick() const { return tick_; }
    uint64_t sequence() const { return sequence_; } ///< 1 for the first published, then rising by 1; 0: never
    /// Serial number of this content: no other snapshot of the process has the same number, whatever its
    /// address and its scene. begin() assigns a new number.
    uint64_t serial() const { return serial_; }
    /// [s] length of the step that ended with this snapshot; 0 if no step did. Particles that were born
    /// within the step are drawn from their birth on.
    float secondsBack() const { return float(toSeconds(step_)); }
    Ticks step() const { return step_; } ///< the same, as passed to begin()
    size_t groupCount() const { return groupCount_ + (roster_ ? roster_->entries.size() : 0); }
    /// The first call for a group of a pool gives all rows of pools to their groups. It allocates nothing.
    const SnapshotGroup& group(size_t index) const
    {
        const uint32_t place = placeOf(index);
        return (place & kPooled) != 0 ? spread_->group(*this, place & ~kPooled) : groups_[place];
    }
    /// Position of the rows of a group in a pool, to read them in place; null: the group has its own rows.
    const GroupRoster::Entry* pooled(size_t index) const
    {
        const uint32_t place = placeOf(index);
        return (place & kPooled) != 0 ? &roster_->entries[place & ~kPooled] : nullptr;
    }
    /// Whether group() has been called for a group of a pool.
    bool hasGivenRows() const { return roster_ && spread_->isDone(); }
    GroupName name(size_t index) const ///< of a group, whose rows stay where they are
    {
        const GroupRoster::Entry* const entry = pooled(index);
        return entry ? GroupName{entry->instance, entry->solver, pool(entry->pool).rows.info().kind}
                     : nameOf(groups_[placeOf(index)].info());
    }

    /// Hash of the tick and of every id, column, constant and placement, computed anew at each call.
    uint64_t hash() const { return hashAt(tick_); }
    /// The hash for a step that ended at `tick`. A snapshot without elements also represents later steps.
    uint64_t hashAt(Ticks tick) const;

    // ---- for the writer, before publication ----
    /// @param step [tick] length of the step that ends at `tick`; 0: none does
    void begin(Ticks tick, uint64_t sequence, Ticks step = 0);
    /// A group with room for `capacity` elements; fill it and set its info (count, bounds). If a group of an
    /// earlier snapshot has enough memory, that memory is reused, whatever the position of that group was.
    /// @param present columns of the kind that the group is to have
    SnapshotGroup& addGroup(KindId kind, size_t capacity, ColumnSet present = kAllColumns)
    {
        if (groupCount_ < groups_.size() && groups_[groupCount_].prepareAgain(kind, capacity, present, true))
            return groups_[groupCount_++]; // at the same index as in the previous snapshot; no other one fits
                                           // better
        return findGroup(kind, capacity, present);
    }
    /// The same for a writer that respects SnapshotGroup::keepsConstants().
    SnapshotGroup& addGroupAgain(KindId kind, size_t capacity, ColumnSet present)
    {
        if (groupCount_ + 2 < groups_.size())
            __builtin_prefetch(&groups_[groupCount_ + 2], 1);
        if (groupCount_ < groups_.size() && groups_[groupCount_].prepareAgain(kind, capacity, present, false))
            return groups_[groupCount_++];
        return findGroup(kind, capacity, present);
    }
    SnapshotGroup& editGroup(size_t index) { return groups_[index]; }
    /// The next pool of rows; fill it. The memory of the pool that had this place before is reused.
    /// @param each capacity of each of its groups
    PooledRows& addPool(KindId kind, size_t capacity, ColumnSet present, uint32_t each);
    size_t poolCount() const { return poolCount_; }
    const PooledRows& pool(size_t index) const { return *pools_[index]; }
    /// Sets which groups the pools contain and their order among the groups that were added. Called once,
    /// after all groups and pools are added.
    /// @param ends number of groups added by the end of each run of added groups, see
    ///         GroupRoster::Entry::stretch
    void setRoster(std::shared_ptr<const GroupRoster> roster, std::span<const uint32_t> ends);
    size_t addedCount() const { return groupCount_; } ///< groups that were added, without those of pools

private:
    friend class UnpackedGroups;
    static constexpr uint32_t kPooled = 1u << 31;
    /// Among the groups that were added, or with kPooled in the roster.
    uint32_t placeOf(size_t index) const { return roster_ ? places_[index] : uint32_t(index); }
    void listPlaces();
    SnapshotGroup& findGroup(KindId kind, size_t capacity, ColumnSet present);

    const SnapshotSchema* schema_;
    std::pmr::memory_resource* memory_;
    Ticks tick_ = 0;
    uint64_t sequence_ = 0;
    uint64_t serial_;
    Ticks step_ = 0;
    size_t groupCount_ = 0;
    std::pmr::vector<SnapshotGroup>
        groups_; ///< the first groupCount_ are valid, the rest keep memory for later
    size_t poolCount_ = 0;
    std::vector<std::unique_ptr<PooledRows>> pools_; ///< the first poolCount_ are valid
    std::shared_ptr<const GroupRoster> roster_;      ///< null without pools
    std::pmr::vector<uint32_t> ends_;                ///< see setRoster()
    std::pmr::vector<uint32_t> places_;              ///< by group, see placeOf(); where pools are
    uint64_t listed_ = 0;                            ///< shape of the roster that they and ends_ are of
    std::unique_ptr<UnpackedGroups> spread_;         ///< where pools are
};

} // namespace fx::base
