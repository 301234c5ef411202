#include "foundation/snapshot/frame_snapshot.h"

#include "foundation/math/hash.h"
#include "foundation/snapshot/late_groups.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace fx::base {

namespace {

uint64_t hashGroup(uint64_t h, const SnapshotGroup& group, std::span<const ColumnDesc> columns)
{
    const GroupInfo& info = group.info();
    h = hashWord(h, info.kind);
    h = hashWord(h, info.instance);
    h = hashWord(h, info.solver);
    h = hashBytes(h, &info.placement.position, sizeof info.placement.position);
    h = hashBytes(h, &info.placement.rotation, sizeof info.placement.rotation);
    h = hashBytes(h, &info.placement.scale, sizeof info.placement.scale);
    h = hashBytes(h, group.constants().data(), group.constants().size_bytes());
    h = hashBytes(h, group.ids().data(), group.ids().size_bytes());
    for (size_t c = 0; c < columns.size(); ++c)
        h = hashBytes(h, group.column(c).data(), group.column(c).size() * columnElementSize(columns[c].type));
    return h;
}

uint64_t nextSerial()
{
    static std::atomic<uint64_t> last = 0;
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

} // namespace

FrameSnapshot::FrameSnapshot(const SnapshotSchema* schema, std::pmr::memory_resource* memory)
    : schema_(schema), memory_(memory), serial_(nextSerial()), groups_(memory), ends_(memory), places_(memory)
{}

void FrameSnapshot::begin(Ticks tick, uint64_t sequence, Ticks step)
{
    tick_ = tick;
    sequence_ = sequence;
    serial_ = nextSerial();
    step_ = step;
    groupCount_ = 0;
    poolCount_ = 0;
    roster_.reset();
    if (late_)
        late_->clear();
}

SnapshotGroup& FrameSnapshot::addLateGroup(KindId kind, LateRows rows)
{
    if (!late_)
        late_ = std::make_shared<LateGroups>(memory_);
    late_->add(groupCount_, rows);
    return addGroup(kind, 0);
}

const SnapshotGroup& FrameSnapshot::lateGroup(size_t place) const
{
    return late_->group(*this, place);
}

PooledRows& FrameSnapshot::addPool(KindId kind, size_t capacity, ColumnSet present, uint32_t each)
{
    if (poolCount_ == pools_.size())
        pools_.push_back(std::make_unique<PooledRows>(memory_));
    PooledRows& pool = *pools_[poolCount_++];
    pool.prepare(*schema_, kind, capacity, present, each);
    return pool;
}

void FrameSnapshot::setRoster(std::shared_ptr<const GroupRoster> roster, std::span<const uint32_t> ends)
{
    if (!spread_)
        spread_ = std::make_unique<UnpackedGroups>(memory_);
    const size_t count = groupCount_ + roster->entries.size();
    const bool isListed =
        listed_ == roster->shape && places_.size() == count && std::ranges::equal(ends_, ends);
    listed_ = 0; // the memory may run out on the way
    ends_.assign(ends.begin(), ends.end());
    places_.resize(count);
    roster_ = std::move(roster);
    if (!isListed)
        listPlaces();
    spread_->prepare(*this);
    listed_ = roster_->shape;
}

/// Each entry of the roster stands behind the stretches of added groups that it counts.
void FrameSnapshot::listPlaces()
{
    uint32_t added = 0;
    size_t at = 0;
    for (uint32_t i = 0; i < roster_->entries.size(); ++i) {
        const uint32_t stretch = roster_->entries[i].stretch;
        for (const uint32_t end = stretch == 0 ? 0 : ends_[stretch - 1]; added < end; ++added)
            places_[at++] = added;
        places_[at++] = i | kPooled;
    }
    for (; added < groupCount_; ++added)
        places_[at++] = added;
}

SnapshotGroup& FrameSnapshot::findGroup(KindId kind, size_t capacity, ColumnSet present)
{
    const KindDesc& desc = schema_->kind(kind);
    const size_t ids = desc.hasIds ? capacity * sizeof(uint64_t) : 0;
    const size_t least = floatsFor(desc, capacity, present) * sizeof(float) + ids;
    size_t best = groups_.size();
    // The smallest spare that is large enough; mostly the next one, which held the same group before.
    for (size_t i = groupCount_;
         i < groups_.size() && (best == groups_.size() || groups_[best].bytes() > least); ++i)
        if (groups_[i].fits(desc, capacity, present) &&
            (best == groups_.size() || groups_[i].bytes() < groups_[best].bytes()))
            best = i;
    if (best == groups_.size()) {
        SnapshotGroup added(memory_);
        added.prepare(*schema_, kind, capacity, present); // nothing stays of it when memory runs out
        groups_.push_back(std::move(added));
    }
    if (best != groupCount_)
        std::swap(groups_[groupCount_], groups_[best]);
    SnapshotGroup& group = groups_[groupCount_];
    group.prepare(*schema_, kind, capacity, present);
    ++groupCount_;
    return group;
}

uint64_t FrameSnapshot::hashAt(Ticks tick) const
{
    uint64_t h = hashWord(0, uint64_t(tick));
    const auto add = [&h, this](const SnapshotGroup& group) {
        const bool isHashed = !group.info().isCosmetic && !group.info().isLate;
        if (group.count() > 0 && isHashed) // what shows nothing is as if it were not there
            h = hashGroup(h, group, schema_->kind(group.info().kind).columns);
    };
    if (roster_)
        spread_->forEach(*this, add);
    else
        std::for_each(groups_.begin(), groups_.begin() + std::ptrdiff_t(groupCount_), add);
    return h;
}

} // namespace fx::base
