#include "simulation/particles/row_publication.h"

#include "foundation/tasks/parallel_rows.h"
#include "simulation/particles/particle_program.h"
#include "simulation/particles/rows_of_a_task.h"

#include <algorithm>
#include <mutex>

namespace fx::sim {

namespace {

namespace column = base::particle_column;

constexpr uint32_t kChunk = 1024;        // rows that are handed to a thread together
constexpr size_t kBeyondCache = 8 << 20; // [byte] of a group that is not kept in the cache of a core

} // namespace

AppearanceColumns columnsOf(base::SnapshotGroup& group)
{
    const auto floats = [&group](size_t c) { return group.has(c) ? group.editColumn(c).data() : nullptr; };
    AppearanceColumns out{};
    out.x = floats(column::PositionX);
    out.y = floats(column::PositionY);
    out.z = floats(column::PositionZ);
    out.age = floats(column::Age);
    out.radius = floats(column::Radius);
    out.color = group.editColumn64(column::Color).data();
    for (size_t a = 0; a < 3; ++a)
        out.velocity[a] = floats(column::VelocityX + a);
    out.angle = floats(column::Angle);
    out.frame = floats(column::Frame);
    for (size_t a = 0; a < 4; ++a)
        out.orientation[a] = floats(column::OrientationX + a);
    out.stream = group.bytes() > kBeyondCache;
    return out;
}

namespace {

/// Rows [begin, end) of the window, spread over threads where there are many.
AppearanceBounds writeAll(const AppearanceJob& job, const AppearanceColumns& out, uint32_t begin,
                          uint32_t end, base::TaskRunner* tasks)
{
    const uint32_t chunks = (end - begin + kChunk - 1) / kChunk;
    const uint32_t few = rowsOfATask(*job.program, kChunk) / kChunk;
    if (!tasks || chunks <= few) // no lock, which would wait for everything that has been written
        return writeAppearance(job, out, begin, end);
    AppearanceBounds bounds;
    std::mutex mutex; // guards bounds, which do not depend on the order of what is added
    parallelRows(*tasks, chunks, few, [&](uint32_t first, uint32_t last) {
        const AppearanceBounds found =
            writeAppearance(job, out, begin + first * kChunk, std::min(begin + last * kChunk, end));
        const std::lock_guard lock(mutex);
        bounds.add(found);
    });
    return bounds;
}

} // namespace

void writeConstants(const EmitterSettings& def, const EmitterAppearance& appearance, float arcPerTile,
                    std::span<float> constants)
{
    namespace constant = base::particle_constant;
    const auto shape =
        appearance.kind == AppearanceKind::Mesh ? base::ParticleShape::Mesh : base::ParticleShape::Sprite;
    constants[constant::Shape] = float(uint32_t(shape));
    constants[constant::Layer] = float(uint32_t(def.layer));
    constants[constant::Blend] = float(uint32_t(appearance.blend));
    constants[constant::Order] = float(uint32_t(appearance.order));
    constants[constant::OrderBias] = appearance.orderBias;
    constants[constant::Alignment] = float(uint32_t(appearance.alignment));
    constants[constant::AxisX] = appearance.axis.x;
    constants[constant::AxisY] = appearance.axis.y;
    constants[constant::AxisZ] = appearance.axis.z;
    constants[constant::Aspect] = appearance.aspect;
    constants[constant::Stretch] = appearance.stretch;
    constants[constant::Luminance] = appearance.luminance;
    constants[constant::Lit] = appearance.lit;
    constants[constant::Softness] = appearance.softness;
    constants[constant::Texture] = float(appearance.texture);
    constants[constant::TileColumns] = float(appearance.tileColumns);
    constants[constant::TileRows] = float(appearance.tileRows);
    constants[constant::FrameBlend] = appearance.frameBlend ? 1.0f : 0.0f;
    constants[constant::Motion] = float(appearance.motion);
    constants[constant::MotionScale] = appearance.motionScale;
    constants[constant::Mesh] = float(appearance.mesh);
    constants[constant::ArcPerTile] = arcPerTile;
    constants[constant::TailAge] = 0.0f;
}

base::SnapshotGroup& addRows(const ParticleProgram& program, uint32_t capacity, uint32_t rows,
                             const GroupPlace& place, base::FrameSnapshot& snapshot)
{
    base::SnapshotGroup& group = snapshot.addGroupAgain(place.kind, capacity, program.published);
    base::GroupInfo& info = group.editInfo();
    info.instance = place.base.instance;
    info.solver = place.base.solver;
    info.count = rows;
    info.placement = place.base.placement;
    info.staysInWorld = place.base.staysInWorld;
    info.isCosmetic = place.base.isCosmetic || program.def.compute != ComputeOn::Cpu;
    if (!group.keepsConstants(program.number))
        writeConstants(program.def, program.def.appearance, 1.0f, group.editConstants());
    return group;
}

bool publishRows(const AppearanceJob& job, const GroupPlace& group, base::TaskRunner* tasks,
                 base::FrameSnapshot& snapshot, PublicationPlace& place, base::WorkBudget& work)
{
    if (place.part == 0)
        addRows(*job.program, job.store->capacity(), job.rows.count, group, snapshot);
    place.part = 1;
    base::SnapshotGroup& to = snapshot.editGroup(snapshot.addedCount() - 1);
    AppearanceJob timed = job;
    timed.secondsBack = snapshot.secondsBack();
    const uint32_t chunks = (job.rows.count - place.row + kChunk - 1) / kChunk;
    const uint32_t end =
        std::min(place.row + kChunk * work.affords(emitter_work::kDrawn * kChunk, chunks), job.rows.count);
    AppearanceBounds bounds{place.bounds.min, place.bounds.max, place.radius};
    bounds.add(writeAll(timed, columnsOf(to), place.row, end, tasks));
    work.spend(uint64_t(emitter_work::kDrawn * double(end - place.row)));
    place.row = end;
    place.bounds = {bounds.low, bounds.high};
    place.radius = bounds.radius;
    if (end < job.rows.count)
        return false;
    bounds.radius *= job.program->corner;
    to.editInfo().bounds = bounds.box();
    return true;
}

} // namespace fx::sim
