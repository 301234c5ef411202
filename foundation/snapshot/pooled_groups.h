/// @file pooled_groups.h
/// Many small groups of one kind that are published as one pool of rows. The rows of a pool are in any order.
///
/// Readers call FrameSnapshot::group() as for any other group: the first call copies each row of each pool to
/// its group. Views read the rows in the pools, so that nothing is copied.
#pragma once

#include "foundation/snapshot/snapshot_group.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory_resource>
#include <mutex>
#include <type_traits>
#include <vector>

namespace fx::base {

class FrameSnapshot;

/// Copies rows of a pool into the storage of a group.
class RowCopier
{
public:
    RowCopier() = default;
    /// @param each capacity of each group of the pool
    RowCopier(const KindDesc& kind, const SnapshotGroup& pool, uint32_t each);

    void copy(uint32_t row, float* storage, uint32_t place) const
    {
        for (size_t k = 0; k < floatCount_; ++k)
            storage[floats_[k].to + place] = floats_[k].from[row];
        for (size_t k = 0; k < wideCount_; ++k)
            std::memcpy(storage + wides_[k].to + 2 * size_t(place), wides_[k].from + 2 * size_t(row),
                        2 * sizeof(float));
    }
    glm::vec3 center(uint32_t row) const
    {
        return {floats_[0].from[row], floats_[1].from[row], floats_[2].from[row]};
    }
    size_t floats() const { return floatsInAll_; } ///< size of a group's storage, in floats

private:
    struct Copied
    {
        const float* from;
        size_t to; ///< [float] offset of the column in the storage of each group
    };
    std::array<Copied, kMaxColumns> floats_{};
    std::array<Copied, kMaxColumns> wides_{};
    size_t floatCount_ = 0;
    size_t wideCount_ = 0;
    size_t floatsInAll_ = 0;
};

/// Extent of the rows of a group, from which PooledRows::bounds() computes a box.
struct RowExtent
{
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};
    float reach = 0; ///< [m] largest radius of a row, before multiplication by PooledRows::corner
};

/// The rows of many groups that have the same columns, constants and capacity. The first three columns are
/// positions. The writer numbers the groups; the number of a group is its member number.
struct PooledRows
{
    struct Range
    {
        uint32_t begin = 0;
        uint32_t end = 0;
    };

    explicit PooledRows(std::pmr::memory_resource* memory) : rows(memory), owner(memory), counts(memory) {}
    static constexpr uint32_t kMaxGroupRows = 256; ///< largest number of rows of a group
    static constexpr uint32_t kMaxMembers = 1u << 24;
    static constexpr uint32_t nameOf(uint32_t member, uint32_t place) { return member << 8 | place; }
    uint32_t memberOf(uint32_t row) const { return owner[row] >> 8; }
    uint32_t placeOf(uint32_t row) const { return owner[row] & 0xFF; }
    /// Calls f(row) for all non-empty rows.
    template <class F>
    void forEachRow(F&& f) const
    {
        const float* const radius = rows.start(radiusColumn);
        for (const Range& range : used)
            for (uint32_t row = range.begin; row < range.end; ++row)
                if (radius[row] > 0.0f)
                    f(row);
    }
    /// Bounds of the rows of a group; empty without rows.
    Bounds bounds(const RowExtent& extent) const
    {
        Bounds box;
        if (!(extent.low.x <= extent.high.x))
            return box;
        box.add(extent.low, extent.reach * corner);
        box.add(extent.high, extent.reach * corner);
        return box;
    }
    /// Extends `io` by one row, which must contain a visible element.
    void measure(uint32_t row, RowExtent& io) const
    {
        const glm::vec3 at = copier.center(row);
        float reach = rows.start(radiusColumn)[row];
        if (velocityColumn != 0)
            reach = measureMoving(row, at, reach, io);
        io.low = glm::min(io.low, at);
        io.high = glm::max(io.high, at);
        io.reach = std::max(io.reach, reach);
    }
    /// Makes room for `capacity` rows of the kind. If the arguments equal those of the last call, constants
    /// and owners do not change.
    /// @param each capacity of each group, at most kMaxGroupRows
    void prepare(const SnapshotSchema& schema, KindId kind, size_t capacity, ColumnSet present,
                 uint32_t each);

    SnapshotGroup rows; ///< columns and constants of the rows; of its GroupInfo, only the kind is valid
    std::array<Range, 2> used; ///< ranges of rows that may contain visible elements
    /// By row: nameOf(member, place) for the member number of its group and its index in that group.
    std::pmr::vector<uint32_t> owner;
    std::pmr::vector<uint32_t> counts; ///< by member number: number of elements of the group
    uint32_t groupCapacity = 0;        ///< capacity of each group
    RowCopier copier;
    size_t radiusColumn = 0; ///< column of the radius; a row of radius 0 is empty
    uint64_t number = 0;     ///< identifies the constants, see SnapshotGroup::keepsConstants()
    /// [1] Distance of the farthest drawn corner of an element from its position, divided by the radius.
    float corner = 1;
    size_t ageColumn = 0;      ///< column of the age; used only if rows have velocities
    size_t velocityColumn = 0; ///< first of the three columns of the velocity; 0: rows have no velocity
    /// [s] a row extends along its velocity, forwards and backwards, by its speed times this time.
    float along = 0;
    /// [s] For rows of arbitrary orientation: speed times this time is added to the radius of a row, before
    /// multiplication by `corner`.
    float across = 0;
    float secondsBack = 0;    ///< [s] a row is also drawn along its path during this time before the snapshot
    uint64_t writer = 0;      ///< identifies the writer of `owner`; 0: none
    uint64_t writtenUpTo = 0; ///< number of the last write, counted by the writer

private:
    /// Extends the box of `io` by the path of a moving row.
    /// @return [m] the radius that RowExtent::reach has to include
    float measureMoving(uint32_t row, const glm::vec3& at, float radius, RowExtent& io) const;
};

/// List of the pooled groups, in the order of the snapshot. Immutable while a snapshot refers to it.
struct GroupRoster
{
    struct Entry
    {
        uint64_t instance = 0;
        Placement placement;
        uint32_t solver = 0;
        uint32_t pool = 0;    ///< index of the pool in the snapshot
        uint32_t member = 0;  ///< member number in the pool
        uint32_t stretch = 0; ///< number of runs of added groups before this group
        bool isCosmetic = false;
    };
    std::vector<Entry> entries;
    /// Identifies the pools and their entries; rosters with the same value have equal lists.
    uint64_t shape = 0;
};

/// Copies of the pooled groups with rows of their own, created on first access.
class UnpackedGroups
{
public:
    explicit UnpackedGroups(std::pmr::memory_resource* memory)
        : memory_(memory), groups_(memory), scratch_(memory), first_(memory), ends_(memory), rows_(memory)
    {}

    /// Begins a new publication: discards the groups and reserves memory for all. Called by the thread that
    /// writes the snapshot.
    void prepare(const FrameSnapshot& snapshot);
    /// The group of an entry of the snapshot's roster. Any thread may call this function.
    const SnapshotGroup& group(const FrameSnapshot& snapshot, size_t entry);
    /// True if group() has been called since prepare().
    bool isDone() const { return done_.load(std::memory_order_acquire); }
    /// Calls f(group) for all groups in order. Each pooled group is valid only during its call of f; no
    /// memory is allocated for it. Any thread may call this function; concurrent calls wait for each other.
    template <class F>
    void forEach(const FrameSnapshot& snapshot, F&& f)
    {
        const auto call = [](void* user, const SnapshotGroup& group) {
            (*static_cast<std::remove_reference_t<F>*>(user))(group);
        };
        visit(snapshot, call, const_cast<void*>(static_cast<const void*>(&f)));
    }

private:
    using Visitor = void (*)(void* user, const SnapshotGroup& group);
    void spread(const FrameSnapshot& snapshot);
    void visit(const FrameSnapshot& snapshot, Visitor visitor, void* user);
    void sortRows(const FrameSnapshot& snapshot);
    void open(const FrameSnapshot& snapshot, const GroupRoster::Entry& entry, SnapshotGroup& group) const;
    void fill(const FrameSnapshot& snapshot, const GroupRoster::Entry& entry, SnapshotGroup& group) const;

    std::mutex mutex_; ///< guards the members below while groups are created
    /// True: the groups have been copied, and are constant until the next publication.
    std::atomic<bool> done_{false};
    uint64_t shape_ = 0; ///< GroupRoster::shape for which memory is reserved
    std::pmr::memory_resource* memory_;
    std::pmr::vector<SnapshotGroup> groups_; ///< by entry of the roster: the group with a copy of its rows
    /// By pool: a group that visit() reuses for all groups of the pool.
    std::pmr::vector<SnapshotGroup> scratch_;
    std::pmr::vector<size_t> first_;  ///< by pool: index of its first member in ends_
    std::pmr::vector<uint32_t> ends_; ///< by member, pool after pool: index of the end of its rows in rows_
    std::pmr::vector<uint32_t> rows_; ///< rows of the pools, grouped by member
};

} // namespace fx::base
