#include "rendering/particle_rows/merged_rows.h"

#include "foundation/snapshot/particle_kind.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>

namespace fx::render {

namespace {

namespace constant = base::particle_constant;
using base::SnapshotGroup;

constexpr uint64_t kStripShift = 40; ///< strips of other members have other numbers above it

/// Copies columns that are the same in any space.
class ColumnCopy
{
public:
    ColumnCopy(const SnapshotGroup& from, SnapshotGroup& to, uint32_t firstRow)
        : from_(from), to_(to), firstRow_(firstRow)
    {}

    void numbers(size_t c) const
    {
        if (from_.has(c))
            std::ranges::copy(from_.column(c), to_.editColumn(c).begin() + firstRow_);
    }
    void words(size_t c, uint64_t more = 0) const
    {
        if (from_.has(c))
            std::transform(from_.column64(c).begin(), from_.column64(c).end(),
                           to_.editColumn64(c).begin() + firstRow_, [more](uint64_t w) { return w ^ more; });
    }
    void orientations(size_t c, const glm::quat& rotation) const
    {
        for (uint32_t i = 0; from_.has(c) && i < from_.count(); ++i) {
            const auto at = [&](size_t a) { return from_.column(c + a)[i]; };
            const glm::quat turned = rotation * glm::quat(at(3), at(0), at(1), at(2));
            const float values[] = {turned.x, turned.y, turned.z, turned.w};
            for (size_t a = 0; a < 4; ++a)
                to_.editColumn(c + a)[firstRow_ + i] = values[a];
        }
    }

private:
    const SnapshotGroup& from_;
    SnapshotGroup& to_;
    uint32_t firstRow_;
};

/// With the axis of sprites in the world's axes.
void copyConstants(const MergeSource& like, std::span<float> out)
{
    std::ranges::copy(like.rows->constants(), out.begin());
    if (out[constant::Alignment] < float(base::SpriteAlignment::Axis))
        return;
    const glm::vec3 axis = like.placement().rotation *
                           glm::vec3(out[constant::AxisX], out[constant::AxisY], out[constant::AxisZ]);
    for (size_t a = 0; a < 3; ++a)
        out[constant::AxisX + a] = axis[int(a)];
}

} // namespace

MergedRows::MergedRows(std::pmr::memory_resource* memory)
    : scatter_(memory), members_(memory), begin_(memory), techniques_(memory), groups_(memory),
      placed_(memory)
{}

void MergedRows::begin(const base::FrameSnapshot& from, base::FrameSnapshot& to)
{
    from_ = &from;
    to_ = &to;
    members_.clear();
    begin_.clear();
    techniques_.clear();
    anyPooled_ = false;
}

void MergedRows::addGroup(const RowTechnique& technique, const MergeSource& like, uint32_t rows)
{
    techniques_.push_back(&technique);
    begin_.push_back(members_.size());
    const base::KindId kind = like.rows->info().kind;
    SnapshotGroup& out = to_->addGroup(kind, rows + kRowsBehind, like.rows->present());
    base::GroupInfo& info = out.editInfo();
    if (like.entry) {
        info.instance = like.entry->instance;
        info.solver = like.entry->solver;
        info.isCosmetic = like.entry->isCosmetic;
    } else {
        info = like.rows->info();
    }
    info.kind = kind;
    info.count = rows;
    info.placement = {like.placement().position, glm::quat(1.0f, 0.0f, 0.0f, 0.0f), 1.0f};
    copyConstants(like, out.editConstants());
}

void MergedRows::addRows(const MergeSource& from, uint32_t firstRow, uint32_t rows, uint32_t number)
{
    members_.push_back({from, uint32_t(begin_.size() - 1), firstRow, rows, number, {}});
    anyPooled_ = anyPooled_ || from.entry;
}

void MergedRows::write()
{
    groups_.clear();
    for (size_t g = 0; g < begin_.size(); ++g)
        groups_.push_back(&to_->editGroup(g));
    if (anyPooled_) {
        scatter_.begin(*from_, groups_.size());
        for (const Member& member : members_)
            if (member.from.entry)
                scatter_.send(*member.from.entry, member.group, member.firstRow, member.from.count);
        scatter_.run(*from_, groups_);
    }
    for (size_t g = 0; g < groups_.size(); ++g)
        place(*techniques_[g], begin_[g], g + 1 < begin_.size() ? begin_[g + 1] : members_.size());
}

/// How places or, with `c` the first column of others, directions of a member come to where they belong.
PlacedRows MergedRows::placing(const Member& member, size_t c, size_t radius) const
{
    SnapshotGroup& to = *groups_[member.group];
    const base::Placement& place = member.from.placement();
    PlacedRows rows{};
    const auto from = [&](size_t index) -> const float* {
        return member.from.entry ? to.editColumn(index).data() + member.firstRow // they are there already
                                 : member.from.rows->start(index);
    };
    for (size_t a = 0; a < 3; ++a) {
        rows.from[a] = from(c + a);
        rows.to[a] = to.editColumn(c + a).data() + member.firstRow;
    }
    rows.radius = from(radius);
    rows.toRadius = to.editColumn(radius).data() + member.firstRow;
    rows.count = member.from.count;
    rows.rotation = place.rotation;
    rows.scale = place.scale;
    rows.offset = place.position - to.info().placement.position;
    return rows;
}

/// The members of one group.
void MergedRows::place(const RowTechnique& technique, size_t begin, size_t end)
{
    SnapshotGroup& to = *groups_[members_[begin].group];
    const size_t radius = technique.merge->radius;
    const size_t velocity = technique.merge->velocity;
    const auto placeAll = [&](size_t c, auto&& f) {
        placed_.clear();
        for (size_t m = begin; m < end; ++m)
            if (members_[m].from.rows)
                placed_.push_back(placing(members_[m], c, radius));
        f(placed_);
    };
    if (velocity != RowMerge::kNone && to.has(velocity))
        placeAll(velocity, [](std::span<const PlacedRows> rows) { turnRows(rows); });
    placeAll(0, [](std::span<PlacedRows> rows) { placeRows(rows); });
    base::Bounds bounds;
    bool isBounded = true;
    size_t at = 0;
    for (size_t m = begin; m < end; ++m) {
        Member& member = members_[m];
        const uint32_t filled = member.from.count;
        std::fill_n(to.editColumn(radius).begin() + member.firstRow + filled, member.rows - filled, 0.0f);
        if (!member.from.rows)
            continue;
        measure(member, placed_[at++], bounds, isBounded);
        if (!member.from.entry)
            copyOthers(technique, member);
    }
    to.editInfo().bounds = isBounded ? bounds : base::Bounds{};
}

void MergedRows::measure(Member& member, const PlacedRows& placed, base::Bounds& ioBounds,
                         bool& ioBounded) const
{
    base::Bounds& own = member.bounds;
    if (member.from.entry)
        own = member.from.pool->bounds(
            member.from.pool->velocityColumn != 0 ? scatter_.extentOf(*member.from.entry) : placed.extent);
    else
        own = member.from.rows->info().bounds;
    ioBounded = ioBounded && (!own.empty() || member.from.count == 0);
    if (own.empty())
        return;
    const glm::vec3 middle = 0.5f * (own.min + own.max);
    ioBounds.add(placed.offset + placed.rotation * (placed.scale * middle),
                 0.5f * placed.scale * glm::length(own.max - own.min));
}

void MergedRows::copyOthers(const RowTechnique& technique, const Member& member)
{
    const RowMerge& merge = *technique.merge;
    const ColumnCopy rows(*member.from.rows, *groups_[member.group], member.firstRow);
    for (size_t c = 0; c < technique.columns.size(); ++c) {
        if (((merge.copied >> c) & 1) == 0)
            continue;
        if (technique.columns[c].type != base::ColumnType::U64)
            rows.numbers(c);
        else
            rows.words(c, c == merge.strip ? uint64_t(member.number) << kStripShift : 0);
    }
    if (merge.orientation != RowMerge::kNone)
        rows.orientations(merge.orientation, member.from.placement().rotation);
}

} // namespace fx::render
