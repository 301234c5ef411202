#include "rendering/particle_rows/group_merger.h"

#include "foundation/math/hash.h"
#include "rendering/frame/snapshot_match.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

namespace column = base::particle_column;
namespace constant = base::particle_constant;
using base::SnapshotGroup;

/// Whether rows of several groups may be drawn in one order without changing the picture: in that of their
/// distances, or in any.
bool hasFreeOrder(const SnapshotGroup& group, bool isStrip)
{
    const auto c = group.constants();
    return c[constant::Blend] != float(base::ParticleBlend::Alpha) ||
           (!isStrip && c[constant::Order] == float(base::ParticleOrder::Depth));
}

bool haveSameColumns(const SnapshotGroup& a, const SnapshotGroup& b)
{
    constexpr base::ColumnSet kColumns = (base::ColumnSet(1) << column::Count) - 1;
    return ((a.present() ^ b.present()) & kColumns) == 0;
}

/// Rows of a pool stay where they are; strips are in none.
MergeSource sourceOf(const base::FrameSnapshot& snapshot, size_t g, bool isStrip)
{
    const base::GroupRoster::Entry* const entry = snapshot.pooled(g);
    if (entry && !isStrip) {
        const base::PooledRows& pool = snapshot.pool(entry->pool);
        return {&pool.rows, &pool, entry, pool.counts[entry->member]};
    }
    const SnapshotGroup& group = snapshot.group(g);
    return {&group, nullptr, nullptr, group.count()};
}

base::GroupInfo infoOf(const MergeSource& from, const base::Bounds& bounds)
{
    if (!from.entry)
        return from.rows->info();
    const base::GroupRoster::Entry& entry = *from.entry;
    return {from.rows->info().kind, entry.instance, entry.solver,    from.count,
            entry.placement,        bounds,         entry.isCosmetic};
}

bool staysInWorld(const MergeSource& group)
{
    return !group.entry && group.rows->info().staysInWorld; // no emitter in a pool does
}

bool isSame(const base::Placement& a, const base::Placement& b)
{
    return a.position == b.position && a.rotation == b.rotation && a.scale == b.scale;
}

} // namespace

GroupMerger::GroupMerger(std::span<const RowTechnique* const> techniques, const base::SnapshotSchema* schema,
                         std::pmr::memory_resource* memory)
    : techniques_(techniques), schema_(schema), members_(memory), sets_(memory), taken_(memory),
      parts_(memory), partsBegin_(memory), newerRevisions_(memory), olderRevisions_(memory), layout_(memory),
      layoutBefore_(memory), anchors_(memory), anchorsBefore_(memory), rows_(memory), newer_(schema, memory),
      older_(schema, memory)
{}

bool GroupMerger::joins(const Set& set, const MergeSource& group) const
{
    const MergeSource& first = members_[set.first].newer;
    if (first.rows != group.rows && // those of one pool are alike
        (first.rows->info().kind != group.rows->info().kind || !haveSameColumns(*first.rows, *group.rows) ||
         !std::ranges::equal(first.rows->constants(), group.rows->constants())))
        return false;
    const base::Placement& a = first.placement();
    const base::Placement& b = group.placement();
    const bool hasAxis = group.rows->constants()[constant::Alignment] >= float(base::SpriteAlignment::Axis);
    return glm::length(a.position - b.position) <= kFarthestMerged && (!hasAxis || a.rotation == b.rotation);
}

void GroupMerger::collect(const base::SnapshotPair& snapshots)
{
    const base::FrameSnapshot& newer = *snapshots.newer;
    const RowTechniques techniques(techniques_, newer.schema());
    members_.clear();
    sets_.clear();
    taken_.assign(newer.groupCount(), 0);
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        const base::GroupName name = newer.name(g);
        const RowTechnique* const technique = techniques.of(name.kind);
        if (!technique || !technique->merge)
            continue;
        const bool isStrip = technique->isStrip;
        const MergeSource group = sourceOf(newer, g, isStrip);
        if (!staysInWorld(group) && shownPlacement(snapshots, name.instance))
            continue;
        if (group.count == 0 || group.count > kMaxMergedRows || !hasFreeOrder(*group.rows, isStrip))
            continue;
        const size_t before = isStrip ? kNoGroup : findSameGroup(snapshots.older, newer, g);
        const MergeSource older =
            before == kNoGroup ? MergeSource{} : sourceOf(*snapshots.older, before, isStrip);
        if (older.rows && (older.count > kMaxMergedRows || !haveSameColumns(*group.rows, *older.rows)))
            continue;
        const uint32_t rows = std::max(group.room(), older.room());
        const uint32_t member = uint32_t(members_.size());
        auto set = std::find_if(sets_.begin(), sets_.end(), [&](const Set& s) { return joins(s, group); });
        if (set == sets_.end()) {
            members_.push_back({group, older, g, before, 0, rows, kNone});
            sets_.push_back({technique, member, member, 1, rows, g});
            continue;
        }
        members_.push_back({group, older, g, before, set->rows, rows, kNone});
        members_[set->last].next = member;
        set->last = member;
        set->rows += rows;
        ++set->count;
        taken_[g] = taken_[set->group] = 1;
    }
}

void GroupMerger::forgetStripBounds()
{
    const RowTechniques techniques(techniques_, *schema_);
    for (size_t g = 0; g < older_.groupCount(); ++g)
        if (techniques.of(older_.editGroup(g).info().kind)->isStrip)
            older_.editGroup(g).editInfo().bounds = {};
}

/// Two layouts that are the same, of the same groups, give the same rows.
void GroupMerger::listLayout()
{
    layout_.clear();
    anchors_.clear();
    forEachSet([this](const Set& set) {
        anchors_.push_back(members_[set.first].newer.placement());
        forEachMember(set, [this](uint32_t m) {
            const Member& member = members_[m];
            layout_.push_back({nameOf(infoOf(member.newer, base::Bounds())), member.firstRow, member.rows});
        });
    });
}

void GroupMerger::mergeSets(const base::SnapshotPair& snapshots, bool isOlder)
{
    rows_.begin(isOlder ? *snapshots.older : *snapshots.newer, isOlder ? older_ : newer_);
    forEachSet([&](const Set& set) {
        rows_.addGroup(*set.technique, members_[set.first].newer, set.rows);
        forEachMember(set, [&](uint32_t m) {
            const Member& member = members_[m];
            rows_.addRows(isOlder ? member.older : member.newer, member.firstRow, member.rows, m + 1);
        });
    });
    rows_.write();
}

/// What decides the rows that mergeSets() makes of a member.
RowRevision GroupMerger::revisionOf(const Set& set, uint32_t member, bool isOlder,
                                    const SnapshotRowRevisions& rows) const
{
    const Member& m = members_[member];
    RowRevision part{m.firstRow, m.rows, 0};
    const MergeSource& from = isOlder ? m.older : m.newer;
    const uint64_t own =
        from.rows && !rows.parts.empty() ? rows.of(isOlder ? m.olderIndex : m.newerIndex)[0].revision : 0;
    if (own == 0)
        return part;
    const base::Placement& place = from.placement();
    const glm::vec3 offset = place.position - members_[set.first].newer.placement().position;
    const auto two = [](float a, float b) {
        return uint64_t(std::bit_cast<uint32_t>(a)) << 32 | std::bit_cast<uint32_t>(b);
    };
    uint64_t hash =
        base::hashWord(own, set.technique->isStrip ? member + 1 : 0); // is in the numbers of strips
    for (const uint64_t word :
         {two(offset.x, offset.y), two(offset.z, place.scale), two(place.rotation.x, place.rotation.y),
          two(place.rotation.z, place.rotation.w)})
        hash = base::hashWord(hash, word);
    part.revision = hash | 1;
    return part;
}

void GroupMerger::listRevisions(bool isOlder, const SnapshotRowRevisions& rows)
{
    std::pmr::vector<RowRevision>& out = isOlder ? olderRevisions_ : newerRevisions_;
    out.clear();
    forEachSet([&](const Set& set) {
        forEachMember(set, [&](uint32_t m) { out.push_back(revisionOf(set, m, isOlder, rows)); });
    });
}

/// Of the newer rows, which have just been written.
void GroupMerger::listParts()
{
    parts_.clear();
    partsBegin_.assign(1, 0);
    forEachSet([this](const Set& set) {
        forEachMember(set, [this](uint32_t m) {
            const Member& member = members_[m];
            parts_.push_back(
                {infoOf(member.newer, rows_.bounds(parts_.size())), member.firstRow, member.rows});
        });
        partsBegin_.push_back(parts_.size());
    });
}

void GroupMerger::build(const base::SnapshotPair& snapshots, const RevisionPair& of,
                        const SnapshotRowRevisions& newerRows, const SnapshotRowRevisions& olderRows)
{
    uint64_t apart = 0; // hash of the instances that are not merged
    for (const base::ShownPlacement& one : snapshots.shown)
        apart = base::hashWord(apart, one.instance);
    if (of == built_ && apart == apart_ && sequence_ > 0)
        return;
    const RevisionPair before = built_;
    const uint64_t newerBefore = revisions_.newer;
    built_ = {}; // until it is done
    hasOlder_ = snapshots.older != nullptr;
    taken_.clear();
    sets_.clear();
    if (snapshots.newer)
        collect(snapshots);
    layout_.swap(layoutBefore_);
    anchors_.swap(anchorsBefore_);
    listLayout();
    const bool isKept = hasOlder_ && before.newer != 0 && before.newer == of.older &&
                        newer_.tick() == snapshots.older->tick() && layout_ == layoutBefore_ &&
                        std::ranges::equal(anchors_, anchorsBefore_, isSame);
    if (isKept) {
        std::swap(newer_, older_);
        newerRevisions_.swap(olderRevisions_);
        forgetStripBounds(); // strips that are merged as older have none
    }
    newer_.begin(snapshots.newer ? snapshots.newer->tick() : 0, ++sequence_);
    revisions_ = {sequence_, 0};
    if (hasOlder_ && isKept) {
        revisions_.older = newerBefore;
    } else {
        older_.begin(snapshots.older ? snapshots.older->tick() : 0, ++sequence_);
        revisions_.older = hasOlder_ ? sequence_ : 0;
    }
    if (snapshots.newer) {
        if (hasOlder_ && !isKept) {
            mergeSets(snapshots, true);
            listRevisions(true, olderRows);
        }
        mergeSets(snapshots, false);
        listRevisions(false, newerRows);
    }
    listParts();
    built_ = of;
    apart_ = apart;
}

} // namespace fx::render
