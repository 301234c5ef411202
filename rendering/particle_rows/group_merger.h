/// @file group_merger.h
/// Merges small groups with equal drawing state, so that the particles of many instances of a preset are
/// sorted together and drawn by one call.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/frame/snapshot_revisions.h"
#include "rendering/lod/stochastic_simplification.h"
#include "rendering/particle_rows/merged_rows.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Owns the merged rows of one view. Memory is kept from frame to frame. Rows are merged again only when the
/// snapshots change. The merged newer snapshot becomes the merged older snapshot of the next frame, if the
/// groups and their ranges of rows have not changed. Pooled rows are read directly from the pool. Pooled
/// groups get space for their full capacity, so that the ranges of other groups do not change.
///
/// Only groups of techniques with a RowMerge are merged, and not those of SnapshotPair::shown that follow
/// their instances. The groups must be sorted by distance, additive or opaque, so that the order of groups
/// does not matter. The groups must have equal columns and constants, and at most kMaxMergedRows rows each.
/// Their positions must be within kFarthestMerged of each other. Sprites aligned to an axis must also have
/// equal rotations. The origin of a merged group is the position of its first member. The axes of a merged
/// group are the world axes. A particle has the same row index in both snapshots.
class GroupMerger
{
public:
    static constexpr uint32_t kMaxMergedRows = 4096;
    static constexpr double kFarthestMerged = 2000.0; ///< [m]

    /// @param techniques techniques whose groups are merged; the techniques must stay valid
    GroupMerger(std::span<const RowTechnique* const> techniques, const base::SnapshotSchema* schema,
                std::pmr::memory_resource* memory);

    /// Merges the groups of two snapshots.
    /// @param of revisions of the snapshots; if the revisions have not changed since the last call, the last
    ///     result is reused
    /// @param newerRows, olderRows revisions of the rows of each group; empty: the revisions are unknown
    void build(const base::SnapshotPair& snapshots, const RevisionPair& of,
               const SnapshotRowRevisions& newerRows = {}, const SnapshotRowRevisions& olderRows = {});
    /// Snapshots that contain the merged groups. The snapshots may be empty.
    base::SnapshotPair merged() const { return {&newer_, hasOlder_ ? &older_ : nullptr}; }
    RevisionPair revisions() const { return revisions_; } ///< revisions of the snapshots of merged()
    /// Revisions of the rows of merged(), with one part per member of a merged group. A revision is a 64-bit
    /// hash of the revisions of the merged rows.
    SnapshotRowRevisions newerRows() const { return {newerRevisions_, partsBegin_, {}}; }
    SnapshotRowRevisions olderRows() const { return {olderRevisions_, partsBegin_, {}}; }
    /// Ranges of the rows of a group of merged(), with the effect to which each range belongs.
    std::span<const RowPart> partsOf(size_t group) const
    {
        return {parts_.data() + partsBegin_[group], partsBegin_[group + 1] - partsBegin_[group]};
    }
    /// For each group of the newer snapshot: 1 if the group is part of a merged group.
    std::span<const uint8_t> taken() const { return taken_; }

private:
    struct Member
    {
        MergeSource newer;
        MergeSource older;             ///< empty if there is no older group, and for strips
        size_t newerIndex, olderIndex; ///< indices of the group in the two snapshots
        uint32_t firstRow;
        uint32_t rows;
        uint32_t next; ///< index of the next member of the set, or kNone
    };
    struct Set
    {
        const RowTechnique* technique;
        uint32_t first, last; ///< first and last member, as indices in members_
        uint32_t count;
        uint32_t rows;
        size_t group; ///< index of the first member's group in the newer snapshot
    };
    /// The source of a range of rows of a merged group.
    struct Layout
    {
        base::GroupName name;
        uint32_t firstRow, rows;

        bool operator==(const Layout&) const = default;
    };
    static constexpr uint32_t kNone = ~0u;

    void collect(const base::SnapshotPair& snapshots);
    bool joins(const Set& set, const MergeSource& group) const;
    void listLayout();
    void mergeSets(const base::SnapshotPair& snapshots, bool isOlder);
    void forgetStripBounds();
    RowRevision revisionOf(const Set& set, uint32_t member, bool isOlder,
                           const SnapshotRowRevisions& rows) const;
    void listRevisions(bool isOlder, const SnapshotRowRevisions& rows);
    void listParts();
    /// Calls f(set) for each set that becomes a merged group.
    template <class F>
    void forEachSet(F&& f)
    {
        for (const Set& set : sets_)
            if (set.count > 1)
                f(set);
    }
    template <class F>
    void forEachMember(const Set& set, F&& f)
    {
        for (uint32_t m = set.first; m != kNone; m = members_[m].next)
            f(m);
    }

    std::span<const RowTechnique* const> techniques_;
    const base::SnapshotSchema* schema_;
    RevisionPair built_; ///< revisions of the snapshots from which merged() was built
    uint64_t apart_ = 0; ///< hash of the instances that were not merged, see SnapshotPair::shown
    RevisionPair revisions_;
    std::pmr::vector<Member> members_;
    std::pmr::vector<Set> sets_;
    std::pmr::vector<uint8_t> taken_;
    std::pmr::vector<RowPart> parts_;
    /// For each group of newer_: index of its first part; at the end, the number of parts.
    std::pmr::vector<size_t> partsBegin_;
    /// One revision for each element of parts_.
    std::pmr::vector<RowRevision> newerRevisions_, olderRevisions_;
    std::pmr::vector<Layout> layout_, layoutBefore_; ///< the present and the previous layout of newer_
    /// Placements of the first members of merged groups.
    std::pmr::vector<base::Placement> anchors_, anchorsBefore_;
    MergedRows rows_;
    base::FrameSnapshot newer_, older_;
    bool hasOlder_ = false;
    uint64_t sequence_ = 0;
};

} // namespace fx::render
