#include "foundation/snapshot/gpu_particles.h"

#include <algorithm>

namespace fx::base {

namespace {

void copyGroup(const SnapshotGroup& from, const KindDesc& kind, FrameSnapshot& out)
{
    ColumnSet present = 0;
    for (size_t c = 0; c < kind.columns.size(); ++c)
        present |= from.has(c) ? ColumnSet(1) << c : 0;
    SnapshotGroup& to = out.addGroup(from.info().kind, from.count(), present);
    to.editInfo() = from.info();
    std::ranges::copy(from.constants(), to.editConstants().begin());
    std::ranges::copy(from.ids(), to.editIds().begin());
    for (size_t c = 0; c < kind.columns.size(); ++c) {
        if (!from.has(c))
            continue;
        if (kind.columns[c].type == ColumnType::F32)
            std::ranges::copy(from.column(c), to.editColumn(c).begin());
        else
            std::ranges::copy(from.column64(c), to.editColumn64(c).begin());
    }
}

} // namespace

bool hasGpuParticles(const FrameSnapshot& snapshot)
{
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        if (snapshot.group(g).program())
            return true;
    return false;
}

std::unique_ptr<FrameSnapshot> replayOnCpu(const FrameSnapshot& snapshot, std::pmr::memory_resource* memory)
{
    auto out = std::make_unique<FrameSnapshot>(&snapshot.schema(), memory);
    out->begin(snapshot.tick(), snapshot.sequence());
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const SnapshotGroup& group = snapshot.group(g);
        if (group.program())
            group.program()->replay(group, *out);
        else
            copyGroup(group, snapshot.schema().kind(group.info().kind), *out);
    }
    return out;
}

} // namespace fx::base
