#include "foundation/snapshot/frame_snapshot.h"

#include "foundation/math/hash.h"

#include <algorithm>
#include <utility>

namespace fx::base {

void SnapshotGroup::prepare(const SnapshotSchema& schema, KindId kind, size_t capacity)
{
    const KindDesc& desc = schema.kind(kind);
    if (storage_.size() < desc.columns.size() * capacity)
        storage_.resize(desc.columns.size() * capacity);
    if (ids_.size() < capacity)
        ids_.resize(capacity);
    constants_.assign(desc.constants.size(), 0.0f);
    capacity_ = capacity;
    info_ = GroupInfo{};
    info_.kind = kind;
}

FrameSnapshot::FrameSnapshot(const SnapshotSchema* schema, std::pmr::memory_resource* memory)
    : schema_(schema), memory_(memory), groups_(memory)
{}

void FrameSnapshot::begin(Ticks tick, uint64_t sequence)
{
    tick_ = tick;
    sequence_ = sequence;
    groupCount_ = 0;
}

SnapshotGroup& FrameSnapshot::addGroup(KindId kind, size_t capacity)
{
    const size_t columns = schema_->kind(kind).columns.size();
    size_t best = groups_.size();
    for (size_t i = groupCount_; i < groups_.size(); ++i) { // the smallest spare that is large enough
        const size_t room = groups_[i].room(columns);
        if (room >= capacity && (best == groups_.size() || room < groups_[best].room(columns)))
            best = i;
    }
    if (best == groups_.size())
        groups_.emplace_back(memory_);
    std::swap(groups_[groupCount_], groups_[best]);
    SnapshotGroup& group = groups_[groupCount_];
    group.prepare(*schema_, kind, capacity);
    ++groupCount_;
    return group;
}

uint64_t FrameSnapshot::hash() const
{
    uint64_t h = hashWord(0, uint64_t(tick_));
    for (size_t g = 0; g < groupCount_; ++g) {
        const SnapshotGroup& group = groups_[g];
        const GroupInfo& info = group.info();
        h = hashWord(h, info.kind);
        h = hashWord(h, info.instance);
        h = hashWord(h, info.solver);
        h = hashBytes(h, &info.placement.position, sizeof info.placement.position);
        h = hashBytes(h, &info.placement.rotation, sizeof info.placement.rotation);
        h = hashBytes(h, &info.placement.scale, sizeof info.placement.scale);
        h = hashBytes(h, group.constants().data(), group.constants().size_bytes());
        h = hashBytes(h, group.ids().data(), group.ids().size_bytes());
        for (size_t c = 0; c < schema_->kind(info.kind).columns.size(); ++c)
            h = hashBytes(h, group.column(c).data(), group.column(c).size_bytes());
    }
    return h;
}

} // namespace fx::base
