/// @file group_merger.h
/// Small groups that are drawn alike become one, so that many instances of a preset are one draw and are
/// sorted among each other.
#pragma once

#include "foundation/snapshot/particle_kind.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/view/row_thinning.h"
#include "rendering/view/snapshot_stamps.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Owns the merged rows of one view; memory is kept from frame to frame, and nothing is done again while the
/// snapshots hold the same.
///
/// Groups of the kinds "particle" and "ribbon" are merged when no order of theirs is lost (they are sorted by
/// distance, or add, or hide), when they have the same columns and constants, at
/// most kMostMergedRows rows each, and stand within kFarthestMerged of each other; where sprites stand by an
/// axis, also the same rotation. A merged group is relative to where the first of its members stands, with
/// the world's axes; a particle has the same row in both snapshots.
class GroupMerger
{
public:
    static constexpr uint32_t kMostMergedRows = 4096;
    static constexpr double kFarthestMerged = 2000.0; ///< [m]

    GroupMerger(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory);

    /// @param of the snapshots: nothing is done again while they stay
    /// @param newerRows, olderRows  stamps of their groups; without parts: not known
    void build(const base::SnapshotPair& snapshots, const StampPair& of,
               const SnapshotRowStamps& newerRows = {}, const SnapshotRowStamps& olderRows = {});
    /// What build() has merged; without groups when there was nothing to merge.
    base::SnapshotPair merged() const { return {&newer_, hasOlder_ ? &older_ : nullptr}; }
    StampPair stamps() const { return {2 * sequence_, hasOlder_ ? 2 * sequence_ - 1 : 0}; } ///< of merged()
    /// Stamps of the rows of merged(), one part a member. They follow from stamps of what was merged by a
    /// hash of 64 bits.
    SnapshotRowStamps newerRows() const { return {newerStamps_, partsBegin_, {}}; }
    SnapshotRowStamps olderRows() const { return {olderStamps_, partsBegin_, {}}; }
    /// Which rows of a group of merged() came from which group.
    std::span<const RowPart> partsOf(size_t group) const
    {
        return {parts_.data() + partsBegin_[group], partsBegin_[group + 1] - partsBegin_[group]};
    }
    /// By group of the newer snapshot: 1 where it is part of a merged group.
    std::span<const uint8_t> taken() const { return taken_; }

private:
    struct Member
    {
        const base::SnapshotGroup* newer;
        const base::SnapshotGroup* older; ///< null: there is none, or a ribbon
        size_t newerIndex, olderIndex;    ///< in their snapshots
        uint32_t firstRow;
        uint32_t rows;
        uint32_t next; ///< of the same set; kNone ends it
    };
    struct Set
    {
        uint32_t first, last; ///< members
        uint32_t count;
        uint32_t rows;
        size_t group; ///< of the newer snapshot, the first member's
    };
    static constexpr uint32_t kNone = ~0u;

    void collect(const base::SnapshotPair& snapshots);
    bool joins(const Set& set, const base::SnapshotGroup& group) const;
    void write(const base::SnapshotPair& snapshots, const Set& set, bool isOlder);
    RowStamp stampOf(const Set& set, uint32_t member, bool isOlder, bool isRibbon,
                     const SnapshotRowStamps& rows) const;
    void listParts(const base::SnapshotPair& snapshots, const Set& set, const SnapshotRowStamps& newerRows,
                   const SnapshotRowStamps& olderRows);

    StampPair built_; ///< what merged() was made of
    std::pmr::vector<Member> members_;
    std::pmr::vector<Set> sets_;
    std::pmr::vector<uint8_t> taken_;
    std::pmr::vector<RowPart> parts_;
    std::pmr::vector<size_t> partsBegin_;                  ///< by group of newer_, and the end
    std::pmr::vector<RowStamp> newerStamps_, olderStamps_; ///< of parts_
    base::FrameSnapshot newer_, older_;
    bool hasOlder_ = false;
    uint64_t sequence_ = 0;
};

} // namespace fx::render
