#include "foundation/snapshot/pooled_groups.h"

#include "foundation/snapshot/frame_snapshot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fx::base {

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

float PooledRows::measureMoving(uint32_t row, const glm::vec3& at, float radius, RowExtent& io) const
{
    const glm::vec3 v(rows.start(velocityColumn)[row], rows.start(velocityColumn + 1)[row],
                      rows.start(velocityColumn + 2)[row]);
    const float back = std::min(rows.start(ageColumn)[row], secondsBack) + along;
    const glm::vec3 head = at + v * along, tail = at - v * back;
    io.low = glm::min(io.low, glm::min(head, tail));
    io.high = glm::max(io.high, glm::max(head, tail));
    return radius + across * std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

void UnpackedGroups::prepare(const FrameSnapshot& snapshot)
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

const SnapshotGroup& UnpackedGroups::group(const FrameSnapshot& snapshot, size_t entry)
{
    if (!done_.load(std::memory_order_acquire)) {
        const std::lock_guard lock(mutex_);
        if (!done_.load(std::memory_order_relaxed))
            spread(snapshot);
        done_.store(true, std::memory_order_release);
    }
    return groups_[entry];
}

void UnpackedGroups::spread(const FrameSnapshot& snapshot)
{
    sortRows(snapshot);
    const GroupRoster& roster = *snapshot.roster_;
    for (size_t i = 0; i < roster.entries.size(); ++i)
        fill(snapshot, roster.entries[i], groups_[i]);
}

void UnpackedGroups::visit(const FrameSnapshot& snapshot, Visitor visitor, void* user)
{
    const std::lock_guard lock(mutex_);
    const bool isSpread = done_.load(std::memory_order_relaxed);
    if (!isSpread)
        sortRows(snapshot);
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const GroupRoster::Entry* const entry = snapshot.pooled(g);
        if (entry && !isSpread)
            fill(snapshot, *entry, scratch_[entry->pool]);
        if (!entry)
            visitor(user, snapshot.groups_[snapshot.placeOf(g)]); // a late group stays without rows
        else
            visitor(user, isSpread ? snapshot.group(g) : scratch_[entry->pool]);
    }
}

/// The rows of each member one after another.
void UnpackedGroups::sortRows(const FrameSnapshot& snapshot)
{
    std::fill(ends_.begin(), ends_.end(), 0u);
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        const PooledRows& pool = snapshot.pool(p);
        pool.forEachRow([&](uint32_t row) { ++ends_[first_[p] + pool.memberOf(row)]; });
    }
    uint32_t sum = 0;
    for (uint32_t& end : ends_) // begins yet
        sum += std::exchange(end, sum);
    for (size_t p = 0; p < snapshot.poolCount(); ++p) {
        const PooledRows& pool = snapshot.pool(p);
        pool.forEachRow([&](uint32_t row) { rows_[ends_[first_[p] + pool.memberOf(row)]++] = row; });
    }
}

/// The group of an entry, whose rows are empty yet.
void UnpackedGroups::open(const FrameSnapshot& snapshot, const GroupRoster::Entry& entry,
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

void UnpackedGroups::fill(const FrameSnapshot& snapshot, const GroupRoster::Entry& entry,
                          SnapshotGroup& group) const
{
    open(snapshot, entry, group);
    const PooledRows& pool = snapshot.pool(entry.pool);
    const size_t member = first_[entry.pool] + entry.member;
    RowExtent extent;
    for (uint32_t i = member == 0 ? 0 : ends_[member - 1]; i < ends_[member]; ++i) {
        const uint32_t row = rows_[i];
        pool.copier.copy(row, group.editStorage(), pool.placeOf(row));
        pool.measure(row, extent);
    }
    group.editInfo().bounds = pool.bounds(extent);
}

} // namespace fx::base
