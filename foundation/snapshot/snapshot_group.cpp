#include "foundation/snapshot/snapshot_group.h"

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

} // namespace

size_t floatsFor(const KindDesc& kind, size_t capacity, ColumnSet present)
{
    size_t floats = 0;
    for (size_t c = 0; c < kind.columns.size(); ++c)
        floats += isIn(present, c) ? columnFloats(kind.columns[c].type, capacity) : 0;
    return floats;
}

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

} // namespace fx::base
