/// @file frame_snapshot.h
/// The state of a scene after one step. The simulation passes snapshots to rendering and hosts, and shares no
/// other data with them.
///
/// A snapshot is a list of groups in creation order. A group holds the elements of one kind that one solver
/// of one instance published: typed columns, shared constants, bounds, and an id per element. The id
/// identifies the same element in the previous snapshot. Many small groups of one kind may be published as
/// one pool of rows, see pooled_groups.h, and the rows of a group may be computed when they are first read,
/// see late_groups.h; readers of the snapshot see ordinary groups. Threads: one thread writes a snapshot and
/// publishes it through a SnapshotRing. A published snapshot does not change, and any thread may read it.
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

/// Identifies the instance and the solver that published a group. The name is the same in all snapshots of a
/// scene.
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

class FrameSnapshot;
class LateGroups;

/// Computes the rows of a group that has been added by FrameSnapshot::addLateGroup(), from groups that were
/// added before it. Any thread may call it, once for each publication.
/// @param place the group is FrameSnapshot::added(place) @param io has room for info().count rows
using LateRows = void (*)(const FrameSnapshot& snapshot, size_t place, SnapshotGroup& io);

/// All groups of a scene at the end of the step that ended at `tick`.
class FrameSnapshot
{
public:
    FrameSnapshot(const SnapshotSchema* schema, std::pmr::memory_resource* memory);

    const SnapshotSchema& schema() const { return *schema_; }
    std::pmr::memory_resource* memory() const { return memory_; }
    Ticks tick() const { return tick_; }
    /// Number of the publication: 1 for the first published snapshot, then increasing by 1; 0 before the
    /// first publication.
    uint64_t sequence() const { return sequence_; }
    /// Serial number of this content. The number is unique among all snapshots of all scenes in the process.
    /// begin() assigns a new number.
    uint64_t serial() const { return serial_; }
    /// [s] length of the step that ended with this snapshot; 0 if no step ended with this snapshot. Particles
    /// that were born within the step are drawn from their birth on.
    float secondsBack() const { return float(toSeconds(step_)); }
    Ticks step() const { return step_; } ///< [tick] length of the step, as passed to begin()
    size_t groupCount() const { return groupCount_ + (roster_ ? roster_->entries.size() : 0); }
    /// The group at `index`. The first call for a pooled group copies the rows of all pools to the pooled
    /// groups, and allocates nothing. The first call for a late group computes its rows.
    const SnapshotGroup& group(size_t index) const
    {
        const uint32_t place = placeOf(index);
        if ((place & kPooled) != 0)
            return spread_->group(*this, place & ~kPooled);
        return groups_[place].info().isLate ? lateGroup(place) : groups_[place];
    }
    /// The group at `index` without the rows of a late group, which this does not compute. The group must not
    /// be pooled.
    const SnapshotGroup& unread(size_t index) const { return groups_[placeOf(index)]; }
    /// Added group number `place`, without pooled groups. A late group has no rows here.
    const SnapshotGroup& added(size_t place) const { return groups_[place]; }
    /// Roster entry of a pooled group, by which its rows can be read in the pool; null if the group has its
    /// own rows.
    const GroupRoster::Entry* pooled(size_t index) const
    {
        const uint32_t place = placeOf(index);
        return (place & kPooled) != 0 ? &roster_->entries[place & ~kPooled] : nullptr;
    }
    /// True if group() has been called for a pooled group, so that the rows of all pools have been copied.
    bool hasGivenRows() const { return roster_ && spread_->isDone(); }
    GroupName name(size_t index) const ///< name of the group at `index`; does not copy rows
    {
        const GroupRoster::Entry* const entry = pooled(index);
        return entry ? GroupName{entry->instance, entry->solver, pool(entry->pool).rows.info().kind}
                     : nameOf(groups_[placeOf(index)].info());
    }

    /// Hash of the tick and of every id, column, constant and placement, computed at each call.
    uint64_t hash() const { return hashAt(tick_); }
    /// The hash that this content would have at `tick`. This hash is needed because a snapshot without
    /// elements also represents later steps.
    uint64_t hashAt(Ticks tick) const;

    // ---- for the writer, before publication ----
    /// Discards the groups and begins a new content.
    /// @param step [tick] length of the step that ends at `tick`; 0 if no step ends there
    void begin(Ticks tick, uint64_t sequence, Ticks step = 0);
    /// Adds a group with room for `capacity` elements. The caller fills the group and sets its info (count,
    /// bounds). If any group of an earlier content has enough memory, the memory of that group is reused.
    /// @param present columns of the kind that the group will have
    SnapshotGroup& addGroup(KindId kind, size_t capacity, ColumnSet present = kAllColumns)
    {
        if (groupCount_ < groups_.size() && groups_[groupCount_].prepareAgain(kind, capacity, present, true))
            return groups_[groupCount_++]; // the group at this index fits exactly, and no other group fits
                                           // better
        return findGroup(kind, capacity, present);
    }
    /// Does the same as addGroup(), but does not clear the constants. Writers use this function if they call
    /// SnapshotGroup::keepsConstants() before they write constants.
    SnapshotGroup& addGroupAgain(KindId kind, size_t capacity, ColumnSet present)
    {
        if (groupCount_ + 2 < groups_.size())
            __builtin_prefetch(&groups_[groupCount_ + 2], 1);
        if (groupCount_ < groups_.size() && groups_[groupCount_].prepareAgain(kind, capacity, present, false))
            return groups_[groupCount_++];
        return findGroup(kind, capacity, present);
    }
    /// Adds a group whose rows are computed by the first call of group(). The caller sets its info with
    /// isLate (count, bounds) and its constants. The snapshot's hash does not include the group.
    SnapshotGroup& addLateGroup(KindId kind, LateRows rows);
    SnapshotGroup& editGroup(size_t index) { return groups_[index]; }
    /// Adds a pool of rows. The caller fills the pool. The memory of the previous content's pool with the
    /// same index is reused.
    /// @param each capacity of each group of the pool
    PooledRows& addPool(KindId kind, size_t capacity, ColumnSet present, uint32_t each);
    size_t poolCount() const { return poolCount_; }
    const PooledRows& pool(size_t index) const { return *pools_[index]; }
    /// Sets the list of the groups that the pools contain, and their positions between the added groups. Must
    /// be called once, after all groups and pools have been added.
    /// @param ends for each run of consecutive added groups, the number of added groups up to its end, see
    ///         GroupRoster::Entry::stretch
    void setRoster(std::shared_ptr<const GroupRoster> roster, std::span<const uint32_t> ends);
    size_t addedCount() const { return groupCount_; } ///< number of added groups, without pooled groups
    /// Adds memory for the groups that `write(snapshot)` adds, beyond that of the present and of earlier
    /// contents. The present content does not change. No other thread may use the snapshot meanwhile.
    template <class F>
    void addSpares(F&& write)
    {
        const size_t count = groupCount_;
        groupCount_ = groups_.size(); // so that no group is written to memory that exists
        try {
            write(*this);
        } catch (...) {
            groupCount_ = count;
            throw;
        }
        groupCount_ = count;
    }
    /// Frees the memory of all groups that the present content does not have.
    void dropSpares()
    {
        groups_.erase(groups_.begin() + std::ptrdiff_t(groupCount_), groups_.end());
        groups_.shrink_to_fit();
    }

private:
    friend class UnpackedGroups;
    static constexpr uint32_t kPooled = 1u << 31;
    /// Index of a group in groups_; or, if the bit kPooled is set, its index in the roster.
    uint32_t placeOf(size_t index) const { return roster_ ? places_[index] : uint32_t(index); }
    const SnapshotGroup& lateGroup(size_t place) const;
    void listPlaces();
    SnapshotGroup& findGroup(KindId kind, size_t capacity, ColumnSet present);

    const SnapshotSchema* schema_;
    std::pmr::memory_resource* memory_;
    Ticks tick_ = 0;
    uint64_t sequence_ = 0;
    uint64_t serial_;
    Ticks step_ = 0;
    size_t groupCount_ = 0;
    /// The first groupCount_ groups are valid; the memory of the other groups is reused.
    std::pmr::vector<SnapshotGroup> groups_;
    size_t poolCount_ = 0;
    std::vector<std::unique_ptr<PooledRows>> pools_; ///< the first poolCount_ pools are valid
    std::shared_ptr<const GroupRoster> roster_;      ///< null if there are no pools
    std::pmr::vector<uint32_t> ends_;                ///< see setRoster()
    std::pmr::vector<uint32_t> places_;      ///< by group: result of placeOf(); used only if there are pools
    uint64_t listed_ = 0;                    ///< GroupRoster::shape to which places_ and ends_ belong
    std::unique_ptr<UnpackedGroups> spread_; ///< null if there are no pools
    std::shared_ptr<LateGroups> late_;       ///< null if there are no late groups
};

} // namespace fx::base
