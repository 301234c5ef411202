#include "foundation/snapshot/frame_snapshot.h"

#include "foundation/math/hash.h"

#include <algorithm>
#include <utility>

namespace fx::base {

namespace {

/// Floats from the beginning of a column to that of the next.
size_t columnFloats(ColumnType type, size_t capacity)
{
    const size_t line = 64 / sizeof(float);
    const size_t rows = (capacity + line - 1) / line * line;
    return rows * columnElementSize(type) / sizeof(float);
}

bool isIn(ColumnSet present, size_t column)
{
    return (present >> column & 1) != 0;
}

size_t floatsFor(const KindDesc& kind, size_t capacity, ColumnSet present)
{
    size_t floats = 0;
    for (size_t c = 0; c < kind.columns.size(); ++c)
        floats += isIn(present, c) ? columnFloats(kind.columns[c].type, capacity) : 0;
    return floats;
}

} // namespace

bool SnapshotGroup::fits(const KindDesc& kind, size_t capacity, ColumnSet present) const
{
    return floatsFor(kind, capacity, present) <= storage_.capacity() &&
           (!kind.hasIds || capacity <= ids_.size());
}

void SnapshotGroup::prepare(const SnapshotSchema& schema, KindId kind, size_t capacity, ColumnSet present)
{
    const KindDesc& desc = schema.kind(kind);
    const size_t floats = floatsFor(desc, capacity, present);
    if (storage_.capacity() < floats)
        storage_ = Column<float>(memory_, floats);
    if (desc.hasIds && ids_.size() < capacity)
        ids_.resize(capacity);
    size_t offset = 0;
    for (size_t c = 0; c < desc.columns.size(); ++c) {
        lines_[c] = uint32_t(offset / kRowsPerLine);
        offset += isIn(present, c) ? columnFloats(desc.columns[c].type, capacity) : 0;
    }
    constantCount_ = uint32_t(desc.constants.size());
    forgetConstants();
    capacity_ = capacity;
    present_ = present;
    hasIds_ = desc.hasIds;
    isExact_ = bytes() == floats * sizeof(float) + (desc.hasIds ? capacity * sizeof(uint64_t) : 0);
    info_ = GroupInfo{};
    info_.kind = kind;
    program_.reset();
}

FrameSnapshot::FrameSnapshot(const SnapshotSchema* schema, std::pmr::memory_resource* memory)
    : schema_(schema), memory_(memory), groups_(memory)
{}

void FrameSnapshot::begin(Ticks tick, uint64_t sequence)
{
    tick_ = tick;
    sequence_ = sequence;
    secondsBack_ = 0;
    groupCount_ = 0;
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
    if (best == groups_.size())
        groups_.emplace_back(memory_);
    if (best != groupCount_)
        std::swap(groups_[groupCount_], groups_[best]);
    SnapshotGroup& group = groups_[groupCount_];
    group.prepare(*schema_, kind, capacity, present);
    ++groupCount_;
    return group;
}

uint64_t FrameSnapshot::hash() const
{
    uint64_t h = hashWord(0, uint64_t(tick_));
    for (size_t g = 0; g < groupCount_; ++g) {
        const SnapshotGroup& group = groups_[g];
        const GroupInfo& info = group.info();
        if (group.count() == 0 || info.isCosmetic)
            continue; // what shows nothing is as if it were not there
        h = hashWord(h, info.kind);
        h = hashWord(h, info.instance);
        h = hashWord(h, info.solver);
        h = hashBytes(h, &info.placement.position, sizeof info.placement.position);
        h = hashBytes(h, &info.placement.rotation, sizeof info.placement.rotation);
        h = hashBytes(h, &info.placement.scale, sizeof info.placement.scale);
        h = hashBytes(h, group.constants().data(), group.constants().size_bytes());
        h = hashBytes(h, group.ids().data(), group.ids().size_bytes());
        const std::span<const ColumnDesc> columns = schema_->kind(info.kind).columns;
        for (size_t c = 0; c < columns.size(); ++c)
            h = hashBytes(h, group.column(c).data(),
                          group.column(c).size() * columnElementSize(columns[c].type));
    }
    return h;
}

} // namespace fx::base
