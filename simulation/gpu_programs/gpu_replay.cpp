#include "simulation/gpu_programs/gpu_replay.h"

#include "foundation/simd/floating_point_scope.h"
#include "foundation/snapshot/gpu_particles.h"
#include "simulation/particles/row_publication.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace fx::sim {

namespace {

constexpr size_t kBatch = 1024;

/// The words of a group as what they stand for.
struct Published
{
    base::GpuParticleMoment moment{};
    std::vector<base::GpuBirthRun> runs;
    std::vector<MotionCondition> conditions;
};

template <class T>
T take(const std::byte*& io)
{
    T value;
    std::memcpy(&value, io, sizeof value);
    io += sizeof value;
    return value;
}

Published readWords(const base::SnapshotGroup& group)
{
    const auto words = group.column64(0);
    const auto* at = reinterpret_cast<const std::byte*>(words.data());
    Published out;
    out.moment = take<base::GpuParticleMoment>(at);
    for (uint32_t i = 0; i < out.moment.runs; ++i)
        out.runs.push_back(take<base::GpuBirthRun>(at));
    for (uint32_t i = 0; i < out.moment.conditions; ++i) {
        const auto condition = take<base::GpuCondition>(at);
        out.conditions.push_back(
            {out.moment.now - condition.age, {condition.pull[0], condition.pull[1], condition.pull[2]}});
    }
    return out;
}

/// Births of a group by the distance of their index from the next.
void ticksOf(const Published& group, uint64_t first, std::span<base::Ticks> out)
{
    size_t run = 0;
    for (size_t i = 0; i < out.size(); ++i) {
        const auto distance = uint32_t(group.moment.next - (first + i));
        while (run + 1 < group.runs.size() && distance <= group.runs[run + 1].reach)
            ++run;
        out[i] = group.moment.now - base::gpuBirthAge(group.runs[run], group.runs[run].reach - distance);
    }
}

} // namespace

void restartMotion(const AppearanceJob& job, ParticleStore& store)
{
    MotionTile motion;
    for (uint32_t row = 0; row < job.rows.count; row += kTileRows) {
        const uint32_t count = std::min(job.rows.count - row, kTileRows);
        readMotion(job, row, count, motion);
        for (size_t a = 0; a < 3; ++a) {
            std::copy_n(motion.position[a], count, store.values[stored::X + a].data() + row);
            std::copy_n(motion.velocity[a], count, store.values[stored::VelocityX + a].data() + row);
        }
    }
    store.placed = true;
}

AppearanceJob replayBirths(const ParticleProgram& program, const ReplayInput& in, ParticleStore& store)
{
    store.clear(in.first);
    store.placed = in.placed;
    AppearanceJob job{&program, &store, {}, in.now, in.conditions[0].begin, in.conditions[0].pull};
    std::array<base::Ticks, kBatch> ticks;
    std::array<Birth, kBatch> births;
    size_t condition = 0;
    const auto goOnWith = [&](const MotionCondition& next) {
        job.rows = store.window();
        job.now = next.begin;
        restartMotion(job, store);
        job.motionBegin = next.begin;
        job.pull = next.pull;
    };
    for (uint64_t at = in.first; at < in.next;) {
        const auto size = size_t(std::min<uint64_t>(in.next - at, kBatch));
        in.ticksOf(at, std::span(ticks).first(size));
        while (condition + 1 < in.conditions.size() && in.conditions[condition + 1].begin <= ticks[0])
            goOnWith(in.conditions[++condition]);
        const bool isLast = condition + 1 == in.conditions.size();
        size_t count = 0; // those before the conditions change
        for (; count < size && (isLast || ticks[count] < in.conditions[condition + 1].begin); ++count)
            births[count] = {at + count, ticks[count]};
        storeBirths(program, in.key, std::span(births).first(count), store);
        store.advance(count);
        at += count;
    }
    while (condition + 1 < in.conditions.size())
        goOnWith(in.conditions[++condition]);
    job.now = in.now;
    store.retire(in.now);
    job.rows = store.window();
    return job;
}

void replayGroup(const ParticleProgram& program, const base::SnapshotGroup& group, base::FrameSnapshot& out)
{
    const base::FloatingPointScope floatingPoint;
    const Published published = readWords(group);
    const base::GpuParticleMoment& moment = published.moment;
    ParticleStore store(program, out.memory());
    const std::vector<ReplayStep> steps = stepsOf(group, moment.now - longestKept(program));
    const ReplayInput input{
        {moment.seed, moment.solver},
        moment.next - moment.window,
        moment.next,
        [&](uint64_t first, std::span<base::Ticks> ticks) { ticksOf(published, first, ticks); },
        published.conditions,
        moment.now,
        program.stores[stored::X],
        steps};
    const AppearanceJob job =
        program.ballistic ? replayBirths(program, input, store) : replaySteps(program, input, store);
    PublicationPlace whole;
    base::WorkBudget unlimited;
    publishRows(job, {out.schema().find(base::kParticleKind.name), group.info()}, nullptr, out, whole,
                unlimited);
}

} // namespace fx::sim
