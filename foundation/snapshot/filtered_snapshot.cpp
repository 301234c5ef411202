#include "foundation/snapshot/filtered_snapshot.h"

#include "foundation/snapshot/expanded_blocks.h"

#include <algorithm>
#include <cstring>

namespace fx::base {

namespace {

void copyGroup(const SnapshotGroup& from, FrameSnapshot& out)
{
    const GroupInfo& info = from.info();
    if (info.isLate) {
        SnapshotGroup& to = out.addLateGroup(info.kind, lateRowsOf(out.schema().kind(info.kind)));
        to.editInfo() = info;
        std::ranges::copy(from.constants(), to.editConstants().begin());
        return;
    }
    SnapshotGroup& to = out.addGroup(info.kind, from.capacity(), from.present());
    to.editInfo() = info;
    to.setProgram(from.program());
    std::ranges::copy(from.constants(), to.editConstants().begin());
    std::ranges::copy(from.ids(), to.editIds().begin());
    const size_t floats = floatsFor(out.schema().kind(info.kind), from.capacity(), from.present());
    if (floats > 0) // all columns, one after another
        std::memcpy(to.editStorage(), from.start(0), floats * sizeof(float));
}

bool contains(std::span<const uint64_t> instances, uint64_t instance)
{
    return std::binary_search(instances.begin(), instances.end(), instance);
}

} // namespace

bool hasGroupOf(const FrameSnapshot& snapshot, std::span<const uint64_t> instances)
{
    for (size_t g = 0; !instances.empty() && g < snapshot.groupCount(); ++g)
        if (contains(instances, snapshot.name(g).instance))
            return true;
    return false;
}

void copyWithout(const FrameSnapshot& snapshot, std::span<const uint64_t> left, FrameSnapshot& out)
{
    out.begin(snapshot.tick(), snapshot.sequence(), snapshot.step());
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        if (!contains(left, snapshot.name(g).instance))
            copyGroup(snapshot.pooled(g) ? snapshot.group(g) : snapshot.unread(g), out);
}

void copyGroups(const FrameSnapshot& snapshot, std::span<const uint32_t> groups, FrameSnapshot& out)
{
    out.begin(snapshot.tick(), snapshot.sequence(), snapshot.step());
    for (const uint32_t g : groups)
        copyGroup(snapshot.pooled(g) ? snapshot.group(g) : snapshot.unread(g), out);
}

} // namespace fx::base
