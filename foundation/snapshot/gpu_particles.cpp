#include "foundation/snapshot/gpu_particles.h"

#include <algorithm>
#include <cstring>

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

GpuParticleMoment gpuMomentOf(const SnapshotGroup& group)
{
    GpuParticleMoment moment;
    std::memcpy(&moment, group.column64(0).data(), sizeof moment);
    return moment;
}

GpuStepRun gpuStepRunOf(const SnapshotGroup& group, const GpuParticleMoment& moment, uint32_t run)
{
    GpuStepRun out;
    const auto* bytes = reinterpret_cast<const std::byte*>(group.column64(0).data());
    std::memcpy(&out,
                bytes + sizeof moment + moment.runs * sizeof(GpuBirthRun) +
                    moment.conditions * sizeof(GpuCondition) + run * sizeof out,
                sizeof out);
    return out;
}

uint32_t gpuStepsBefore(const GpuStepRun& run, int64_t now, int64_t tick)
{
    const int64_t gone = tick - (now - run.age);
    return gone < 0 ? 0 : uint32_t(std::min<int64_t>(gone / run.length, run.count));
}

bool continuesFrom(const SnapshotGroup& group, const GpuStepMark& mark)
{
    const GpuParticleMoment moment = gpuMomentOf(group);
    if (mark.history == 0 || mark.now > moment.now)
        return false;
    for (uint32_t i = moment.stepRuns; i-- > 0;) {
        const GpuStepRun run = gpuStepRunOf(group, moment, i);
        if (run.history != mark.history)
            continue;
        const int64_t gone = mark.now - (moment.now - run.age);
        return gone > 0 && gone % run.length == 0 && gone / run.length <= int64_t(run.count);
    }
    return false;
}

GpuStepMark gpuMarkOf(const SnapshotGroup& group)
{
    const GpuParticleMoment moment = gpuMomentOf(group);
    if (moment.stepRuns == 0)
        return {};
    const GpuStepRun last = gpuStepRunOf(group, moment, moment.stepRuns - 1);
    return {last.history, moment.now - last.endAge()};
}

bool hasGpuParticles(const FrameSnapshot& snapshot)
{
    for (size_t place = 0; place < snapshot.addedCount(); ++place) // no pooled group has a program
        if (snapshot.added(place).program())
            return true;
    return false;
}

std::unique_ptr<FrameSnapshot> replayOnCpu(const FrameSnapshot& snapshot, std::pmr::memory_resource* memory)
{
    auto out = std::make_unique<FrameSnapshot>(&snapshot.schema(), memory);
    out->begin(snapshot.tick(), snapshot.sequence(), snapshot.step());
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
