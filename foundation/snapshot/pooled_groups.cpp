#include "foundation/snapshot/pooled_groups.h"

#include "foundation/snapshot/frame_snapshot.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace fx::base {

namespace {

/// Calls f(row) for all rows that show something.
template <class F>
void forEachRow(const PooledRows& pool, F&& f)
{
    const float* const radius = pool.rows.start(pool.radiusColumn);
    for (const PooledRows::Range& range : pool.used)
        for (uint32_t row = range.begin; row < range.end; ++row)
            if (radius[row] > 0.0f)
                f(row);
}

} // namespace

RowCopier::RowCopier(const KindDesc& kind, const SnapshotGroup& pool, uint32_t each)
{
    for (size_t c = 0; c < kind.columns.size(); ++c) {
        if (!pool.has(c))
            continue;
        if (kind.columns[c].type == ColumnType::U64)
            wides_[wideCount_++] = {pool.start(c), floatsInAll_};
        else
            floats_[floatCount_++] = {pool.start(c), floatsInAll_};
        floatsInAll_ += floatsFor({{}, kind.columns.subspan(c, 1), {}, false}, each, 1);
    }
}

void PooledRows::prepare(const SnapshotSchema& schema, KindId kind, size_t capacity, ColumnSet present,
                         uint32_t each)
{
    if (owner.size() < capacity)
        owner.resize(capacity); // the memory may run out: before anything else has changed
    const bool isSame = groupCapacity == each;
    groupCapacity = each;
    if (rows.prepareAgain(kind, capacity, present, false) && isSame)
        return;
    writer = 0;
    rows.prepare(schema, kind, capacity, present);
    copier = RowCopier(schema.kind(kind), rows, each);
}

void SpreadGroups::prepare(const FrameSnapshot& snapshot)
{
    done_.store(false, std::memory_order_relaxed); // publication orders it
    const GroupRoster& roster = *snapshot.roster_;
    size_t members = 0, rows = 0;
    first_.clear();
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        first_.push_back(members);
        members += snapshot.pool(p).counts.size();
        rows += snapshot.pool(p).rows.capacity();
    }
    ends_.resize(members);
    rows_.resize(rows);
    order_.reserve(snapshot.groupCount());
    if (shape_ == roster.shape)
        return;
    while (scratch_.size() < snapshot.poolCount())
        scratch_.emplace_back(memory_);
    while (groups_.size() < roster.entries.size())
        groups_.emplace_back(memory_);
    for (size_t i = 0; i < roster.entries.size(); ++i) {
        open(snapshot, roster.entries[i], groups_[i]);
        open(snapshot, roster.entries[i], scratch_[roster.entries[i].pool]);
    }
    shape_ = roster.shape;
}

const SnapshotGroup& SpreadGroups::group(const FrameSnapshot& snapshot, size_t index)
{
    if (!done_.load(std::memory_order_acquire)) {
        const std::lock_guard lock(mutex_);
        if (!done_.load(std::memory_order_relaxed))
            spread(snapshot);
        done_.store(true, std::memory_order_release);
    }
    return *order_[index];
}

void SpreadGroups::spread(const FrameSnapshot& snapshot)
{
    sortRows(snapshot);
    order_.clear();
    size_t added = 0;
    const GroupRoster& roster = *snapshot.roster_;
    for (size_t i = 0; i < roster.entries.size(); ++i) {
        const GroupRoster::Entry& entry = roster.entries[i];
        for (const size_t end = snapshot.addedBefore(entry); added < end; ++added)
            order_.push_back(&snapshot.groups_[added]);
        fill(snapshot, entry, groups_[i]);
        order_.push_back(&groups_[i]);
    }
    for (; added < snapshot.groupCount_; ++added)
        order_.push_back(&snapshot.groups_[added]);
}

void SpreadGroups::visit(const FrameSnapshot& snapshot, Visitor visitor, void* user)
{
    const std::lock_guard lock(mutex_);
    if (done_.load(std::memory_order_relaxed)) {
        for (const SnapshotGroup* const group : order_)
            visitor(user, *group);
        return;
    }
    sortRows(snapshot);
    size_t added = 0;
    for (const GroupRoster::Entry& entry : snapshot.roster_->entries) {
        for (const size_t end = snapshot.addedBefore(entry); added < end; ++added)
            visitor(user, snapshot.groups_[added]);
        fill(snapshot, entry, scratch_[entry.pool]);
        visitor(user, scratch_[entry.pool]);
    }
    for (; added < snapshot.groupCount_; ++added)
        visitor(user, snapshot.groups_[added]);
}

/// The rows of each member one after another.
void SpreadGroups::sortRows(const FrameSnapshot& snapshot)
{
    std::fill(ends_.begin(), ends_.end(), 0u);
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        const PooledRows& pool = snapshot.pool(p);
        forEachRow(pool, [&](uint32_t row) { ++ends_[first_[p] + pool.memberOf(row)]; });
    }
    uint32_t sum = 0;
    for (uint32_t& end : ends_) // begins yet
        sum += std::exchange(end, sum);
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        const PooledRows& pool = snapshot.pool(p);
        forEachRow(pool, [&](uint32_t row) { rows_[ends_[first_[p] + pool.memberOf(row)]++] = row; });
    }
}

/// The group of an entry, whose rows are empty yet.
void SpreadGroups::open(const FrameSnapshot& snapshot, const GroupRoster::Entry& entry,
                        SnapshotGroup& group) const
{
    const PooledRows& pool = snapshot.pool(entry.pool);
    const KindId kind = pool.rows.info().kind;
    const ColumnSet present = pool.rows.present();
    if (!group.prepareAgain(kind, pool.groupCapacity, present, false))
        group.prepare(snapshot.schema(), kind, pool.groupCapacity, present);
    GroupInfo& info = group.editInfo();
    info.instance = entry.instance;
    info.solver = entry.solver;
    info.count = pool.counts[entry.member];
    info.placement = entry.placement;
    info.isCosmetic = entry.isCosmetic;
    if (!group.keepsConstants(pool.number))
        std::ranges::copy(pool.rows.constants(), group.editConstants().begin());
    std::memset(group.editStorage(), 0, pool.copier.floats() * sizeof(float));
}

void SpreadGroups::fill(const FrameSnapshot& snapshot, const GroupRoster::Entry& entry,
                        SnapshotGroup& group) const
{
    open(snapshot, entry, group);
    constexpr float kFar = std::numeric_limits<float>::infinity();
    const PooledRows& pool = snapshot.pool(entry.pool);
    const float* const radii = pool.rows.start(pool.radiusColumn);
    const size_t member = first_[entry.pool] + entry.member;
    glm::vec3 low(kFar), high(-kFar);
    float radius = 0;
    for (uint32_t i = member == 0 ? 0 : ends_[member - 1]; i < ends_[member]; ++i) {
        const uint32_t row = rows_[i];
        pool.copier.copy(row, group.editStorage(), pool.placeOf(row));
        low = glm::min(low, pool.copier.center(row));
        high = glm::max(high, pool.copier.center(row));
        radius = std::max(radius, radii[row]);
    }
    if (!(low.x <= high.x))
        return;
    group.editInfo().bounds.add(low, radius * pool.corner);
    group.editInfo().bounds.add(high, radius * pool.corner);
}

} // namespace fx::base
