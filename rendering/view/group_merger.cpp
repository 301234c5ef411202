#include "rendering/view/group_merger.h"

#include "foundation/math/hash.h"
#include "rendering/view/snapshot_match.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace fx::render {

namespace {

namespace column = base::particle_column;
namespace constant = base::particle_constant;
using base::SnapshotGroup;

constexpr uint64_t kStripShift = 40; ///< strips of other members have other numbers above it

bool isRibbon(const base::FrameSnapshot& snapshot, const SnapshotGroup& group)
{
    return group.info().kind == snapshot.schema().find(base::kRibbonKind.name);
}

/// Whether rows of several groups may be drawn in one order without changing the picture: in that of their
/// distances, or in any.
bool hasFreeOrder(const SnapshotGroup& group, bool ribbon)
{
    const auto c = group.constants();
    return c[constant::Blend] != float(base::ParticleBlend::Alpha) ||
           (!ribbon && c[constant::Order] == float(base::ParticleOrder::Depth));
}

bool isSmall(const base::FrameSnapshot& snapshot, const SnapshotGroup& group)
{
    const base::KindId kind = group.info().kind;
    return (kind == snapshot.schema().find(base::kParticleKind.name) ||
            kind == snapshot.schema().find(base::kRibbonKind.name)) &&
           group.count() > 0 && group.count() <= GroupMerger::kMostMergedRows &&
           hasFreeOrder(group, isRibbon(snapshot, group));
}

bool haveSameColumns(const SnapshotGroup& a, const SnapshotGroup& b)
{
    for (size_t c = 0; c < column::Count; ++c)
        if (a.has(c) != b.has(c))
            return false;
    return true;
}

base::ColumnSet columnsOf(const SnapshotGroup& group)
{
    base::ColumnSet set = 0;
    for (size_t c = 0; c < column::Count; ++c)
        set |= base::ColumnSet(group.has(c) ? 1 : 0) << c;
    return set;
}

/// Copies the rows of a member to where they belong, into the space around `anchor` with the world's axes.
class RowWriter
{
public:
    RowWriter(const SnapshotGroup& from, SnapshotGroup& to, uint32_t firstRow, const glm::dvec3& anchor)
        : from_(from), to_(to), firstRow_(firstRow), rotation_(from.info().placement.rotation),
          scale_(from.info().placement.scale), offset_(from.info().placement.position - anchor)
    {}

    void places(size_t c) const
    {
        eachVector(c, [this](const glm::vec3& v) { return offset_ + rotation_ * (scale_ * v); });
    }
    void directions(size_t c) const
    {
        eachVector(c, [this](const glm::vec3& v) { return rotation_ * (scale_ * v); });
    }
    void lengths(size_t c) const
    {
        for (uint32_t i = 0; i < from_.count(); ++i)
            to_.editColumn(c)[firstRow_ + i] = scale_ * from_.column(c)[i];
    }
    void numbers(size_t c) const
    {
        if (from_.has(c))
            std::copy(from_.column(c).begin(), from_.column(c).end(), to_.editColumn(c).begin() + firstRow_);
    }
    void words(size_t c, uint64_t more = 0) const
    {
        for (uint32_t i = 0; from_.has(c) && i < from_.count(); ++i)
            to_.editColumn64(c)[firstRow_ + i] = from_.column64(c)[i] ^ more;
    }
    void orientations() const
    {
        for (uint32_t i = 0; from_.has(column::OrientationX) && i < from_.count(); ++i) {
            const auto at = [&](size_t a) { return from_.column(column::OrientationX + a)[i]; };
            const glm::quat turned = rotation_ * glm::quat(at(3), at(0), at(1), at(2));
            const float values[] = {turned.x, turned.y, turned.z, turned.w};
            for (size_t a = 0; a < 4; ++a)
                to_.editColumn(column::OrientationX + a)[firstRow_ + i] = values[a];
        }
    }
    /// The member's bounds in the merged space; false when it has none.
    bool bounds(base::Bounds& ioBounds) const
    {
        const base::Bounds& own = from_.info().bounds;
        if (own.empty())
            return false;
        const glm::vec3 middle = 0.5f * (own.min + own.max);
        ioBounds.add(offset_ + rotation_ * (scale_ * middle), 0.5f * scale_ * glm::length(own.max - own.min));
        return true;
    }

private:
    template <class F>
    void eachVector(size_t c, const F& changed) const
    {
        for (uint32_t i = 0; from_.has(c) && i < from_.count(); ++i) {
            const glm::vec3 v = changed({from_.column(c)[i], from_.column(c + 1)[i], from_.column(c + 2)[i]});
            for (size_t a = 0; a < 3; ++a)
                to_.editColumn(c + a)[firstRow_ + i] = v[int(a)];
        }
    }

    const SnapshotGroup& from_;
    SnapshotGroup& to_;
    uint32_t firstRow_;
    glm::quat rotation_;
    float scale_;
    glm::vec3 offset_;
};

void copyParticles(const RowWriter& rows)
{
    rows.places(column::PositionX);
    rows.numbers(column::Age);
    rows.lengths(column::Radius);
    rows.words(column::Color);
    rows.directions(column::VelocityX);
    rows.numbers(column::Angle);
    rows.numbers(column::Frame);
    rows.orientations();
    rows.words(column::Index);
}

void copyRibbon(const RowWriter& rows, uint64_t member)
{
    namespace ribbon = base::ribbon_column;
    rows.places(ribbon::PositionX);
    rows.lengths(ribbon::HalfWidth);
    rows.numbers(ribbon::Arc);
    rows.words(ribbon::Color);
    rows.words(ribbon::Strip, member << kStripShift);
    rows.numbers(ribbon::Age);
}

} // namespace

GroupMerger::GroupMerger(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory)
    : members_(memory), sets_(memory), taken_(memory), parts_(memory), partsBegin_(memory),
      newerStamps_(memory), olderStamps_(memory), newer_(schema, memory), older_(schema, memory)
{}

bool GroupMerger::joins(const Set& set, const SnapshotGroup& group) const
{
    const SnapshotGroup& first = *members_[set.first].newer;
    if (first.info().kind != group.info().kind || !haveSameColumns(first, group) ||
        !std::equal(first.constants().begin(), first.constants().end(), group.constants().begin(),
                    group.constants().end()))
        return false;
    const base::Placement& a = first.info().placement;
    const base::Placement& b = group.info().placement;
    const bool hasAxis = group.constants()[constant::Alignment] >= float(base::SpriteAlignment::Axis);
    return glm::length(a.position - b.position) <= kFarthestMerged && (!hasAxis || a.rotation == b.rotation);
}

void GroupMerger::collect(const base::SnapshotPair& snapshots)
{
    const base::FrameSnapshot& newer = *snapshots.newer;
    members_.clear();
    sets_.clear();
    taken_.assign(newer.groupCount(), 0);
    for (size_t g = 0; g < newer.groupCount(); ++g) {
        const SnapshotGroup& group = newer.group(g);
        if (!isSmall(newer, group))
            continue;
        const bool ribbon = isRibbon(newer, group);
        const size_t before = ribbon ? kNoGroup : findSameGroup(snapshots.older, group.info(), g);
        const SnapshotGroup* older = before == kNoGroup ? nullptr : &snapshots.older->group(before);
        if (older && (older->count() > kMostMergedRows || !haveSameColumns(group, *older)))
            continue;
        const uint32_t rows = std::max(group.count(), older ? older->count() : 0u);
        const uint32_t member = uint32_t(members_.size());
        auto set = std::find_if(sets_.begin(), sets_.end(), [&](const Set& s) { return joins(s, group); });
        if (set == sets_.end()) {
            members_.push_back({&group, older, g, before, 0, rows, kNone});
            sets_.push_back({member, member, 1, rows, g});
            continue;
        }
        members_.push_back({&group, older, g, before, set->rows, rows, kNone});
        members_[set->last].next = member;
        set->last = member;
        set->rows += rows;
        ++set->count;
        taken_[g] = taken_[set->group] = 1;
    }
}

void GroupMerger::write(const base::SnapshotPair& snapshots, const Set& set, bool isOlder)
{
    const SnapshotGroup& first = *members_[set.first].newer;
    const glm::dvec3 anchor = first.info().placement.position;
    const bool ribbon = isRibbon(*snapshots.newer, first);
    SnapshotGroup& out = (isOlder ? older_ : newer_).addGroup(first.info().kind, set.rows, columnsOf(first));
    base::GroupInfo& info = out.editInfo();
    info = first.info();
    info.count = set.rows;
    info.placement = {anchor, glm::quat(1.0f, 0.0f, 0.0f, 0.0f), 1.0f};
    std::copy(first.constants().begin(), first.constants().end(), out.editConstants().begin());
    if (first.constants()[constant::Alignment] >= float(base::SpriteAlignment::Axis)) {
        const auto c = out.editConstants();
        const glm::vec3 axis = first.info().placement.rotation *
                               glm::vec3(c[constant::AxisX], c[constant::AxisY], c[constant::AxisZ]);
        for (size_t a = 0; a < 3; ++a)
            c[constant::AxisX + a] = axis[int(a)];
    }
    base::Bounds bounds;
    bool isBounded = true;
    for (uint32_t m = set.first; m != kNone; m = members_[m].next) {
        const Member& member = members_[m];
        const SnapshotGroup* from = isOlder ? member.older : member.newer;
        const uint32_t filled = from ? from->count() : 0;
        const size_t size = ribbon ? size_t(base::ribbon_column::HalfWidth) : size_t(column::Radius);
        std::fill_n(out.editColumn(size).begin() + member.firstRow + filled, member.rows - filled, 0.0f);
        if (!from)
            continue;
        const RowWriter rows(*from, out, member.firstRow, anchor);
        if (ribbon)
            copyRibbon(rows, m + 1);
        else
            copyParticles(rows);
        isBounded = rows.bounds(bounds) && isBounded;
    }
    info.bounds = isBounded ? bounds : base::Bounds{};
}

/// What decides the rows that write() makes of a member.
RowStamp GroupMerger::stampOf(const Set& set, uint32_t member, bool isOlder, bool isRibbon,
                              const SnapshotRowStamps& rows) const
{
    const Member& m = members_[member];
    RowStamp part{m.firstRow, m.rows, 0};
    const SnapshotGroup* from = isOlder ? m.older : m.newer;
    const uint64_t own =
        from && !rows.parts.empty() ? rows.of(isOlder ? m.olderIndex : m.newerIndex)[0].stamp : 0;
    if (own == 0)
        return part;
    const base::Placement& place = from->info().placement;
    const glm::vec3 offset = place.position - members_[set.first].newer->info().placement.position;
    const float turned[] = {offset.x,         offset.y,         offset.z,         place.scale,
                            place.rotation.x, place.rotation.y, place.rotation.z, place.rotation.w};
    const uint64_t number = isRibbon ? member + 1 : 0; // is in the numbers of strips
    part.stamp = base::hashBytes(base::hashWord(own, number), turned, sizeof turned) | 1;
    return part;
}

void GroupMerger::listParts(const base::SnapshotPair& snapshots, const Set& set,
                            const SnapshotRowStamps& newerRows, const SnapshotRowStamps& olderRows)
{
    const bool ribbon = isRibbon(*snapshots.newer, *members_[set.first].newer);
    for (uint32_t m = set.first; m != kNone; m = members_[m].next) {
        parts_.push_back({members_[m].newer->info(), members_[m].firstRow, members_[m].rows});
        newerStamps_.push_back(stampOf(set, m, false, ribbon, newerRows));
        olderStamps_.push_back(stampOf(set, m, true, ribbon, olderRows));
    }
    partsBegin_.push_back(parts_.size());
}

void GroupMerger::build(const base::SnapshotPair& snapshots, const StampPair& of,
                        const SnapshotRowStamps& newerRows, const SnapshotRowStamps& olderRows)
{
    if (of == built_ && sequence_ > 0)
        return;
    built_ = {}; // until it is done
    ++sequence_;
    newer_.begin(snapshots.newer ? snapshots.newer->tick() : 0, sequence_);
    older_.begin(snapshots.older ? snapshots.older->tick() : 0, sequence_);
    taken_.clear();
    parts_.clear();
    newerStamps_.clear();
    olderStamps_.clear();
    partsBegin_.assign(1, 0);
    hasOlder_ = snapshots.older != nullptr;
    if (!snapshots.newer)
        return;
    collect(snapshots);
    for (const Set& set : sets_) {
        if (set.count < 2)
            continue;
        write(snapshots, set, false);
        listParts(snapshots, set, newerRows, olderRows);
        if (hasOlder_)
            write(snapshots, set, true);
    }
    built_ = of;
}

} // namespace fx::render
