#include "simulation/emitters/emitter_solver.h"

#include "simulation/emitters/emitter_crowd.h"
#include "simulation/emitters/gpu_replay.h"
#include "simulation/emitters/look_constants.h"
#include "simulation/parallel.h"
#include "simulation/particles/rows_of_a_task.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace fx::sim {

namespace {

namespace column = base::particle_column;

constexpr uint32_t kChunk = 1024;        // rows that are handed to a thread together
constexpr size_t kBeyondCache = 8 << 20; // [byte] of a group that is not kept in the cache of a core

} // namespace

LookColumns columnsOf(base::SnapshotGroup& group)
{
    const auto floats = [&group](size_t c) { return group.has(c) ? group.editColumn(c).data() : nullptr; };
    LookColumns out{};
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

/// All rows of the window, spread over threads where there are many.
LookBounds writeAll(const LookJob& job, const LookColumns& out, base::TaskRunner* tasks)
{
    const uint32_t chunks = (job.rows.count + kChunk - 1) / kChunk;
    const uint32_t few = rowsOfATask(*job.program, kChunk) / kChunk;
    if (!tasks || chunks <= few) // no lock, which would wait for everything that has been written
        return writeLooks(job, out, 0, job.rows.count);
    LookBounds bounds;
    std::mutex mutex; // guards bounds, which do not depend on the order of what is added
    parallelRows(*tasks, chunks, few, [&](uint32_t begin, uint32_t end) {
        const LookBounds found = writeLooks(job, out, begin * kChunk, std::min(end * kChunk, job.rows.count));
        const std::lock_guard lock(mutex);
        bounds.add(found);
    });
    return bounds;
}

} // namespace

void writeConstants(const EmitterDef& def, const EmitterLook& look, float arcPerTile,
                    std::span<float> constants)
{
    namespace constant = base::particle_constant;
    const auto shape =
        look.kind == Appearance::Mesh ? base::ParticleShape::Mesh : base::ParticleShape::Sprite;
    constants[constant::Shape] = float(uint32_t(shape));
    constants[constant::Layer] = float(uint32_t(def.layer));
    constants[constant::Blend] = float(uint32_t(look.blend));
    constants[constant::Order] = float(uint32_t(look.order));
    constants[constant::OrderBias] = look.orderBias;
    constants[constant::Alignment] = float(uint32_t(look.alignment));
    constants[constant::AxisX] = look.axis.x;
    constants[constant::AxisY] = look.axis.y;
    constants[constant::AxisZ] = look.axis.z;
    constants[constant::Aspect] = look.aspect;
    constants[constant::Stretch] = look.stretch;
    constants[constant::Luminance] = look.luminance;
    constants[constant::Lit] = look.lit;
    constants[constant::Softness] = look.softness;
    constants[constant::Texture] = float(look.texture);
    constants[constant::TileColumns] = float(look.tileColumns);
    constants[constant::TileRows] = float(look.tileRows);
    constants[constant::FrameBlend] = look.frameBlend ? 1.0f : 0.0f;
    constants[constant::Motion] = float(look.motion);
    constants[constant::MotionScale] = look.motionScale;
    constants[constant::Mesh] = float(look.mesh);
    constants[constant::ArcPerTile] = arcPerTile;
    constants[constant::TailAge] = 0.0f;
}

namespace {

struct GroupPlace
{
    base::KindId kind;
    const base::GroupInfo& base;
};

/// A group of particles, without what is in its columns.
base::SnapshotGroup& addRows(const ParticleProgram& program, uint32_t capacity, uint32_t rows,
                             const GroupPlace& place, base::FrameSnapshot& snapshot)
{
    base::SnapshotGroup& group = snapshot.addGroupAgain(place.kind, capacity, program.published);
    base::GroupInfo& info = group.editInfo();
    info.instance = place.base.instance;
    info.solver = place.base.solver;
    info.count = rows;
    info.placement = place.base.placement;
    info.isCosmetic = place.base.isCosmetic || program.def.compute != ComputeOn::Cpu;
    if (!group.keepsConstants(program.number))
        writeConstants(program.def, program.def.look, 1.0f, group.editConstants());
    return group;
}

} // namespace

LookJob EmitterSolver::lookJob() const
{
    LookJob job;
    fill(job);
    return job;
}

void EmitterSolver::publish(const base::GroupInfo& instance, base::FrameSnapshot& snapshot) const
{
    catchUpWithPool();
    base::GroupInfo base = instance;
    if (space_ && started_)
        base.placement = space_->home();
    if (def_.look.kind == Appearance::Medium)
        publishMedium(base, snapshot);
    else if (def_.look.kind != Appearance::None)
        publishParticles(base, snapshot);
    if (trails_)
        publishTrails(base, snapshot);
    if (def_.light.given)
        publishLights(base, snapshot);
}

void publishRows(const LookJob& job, base::KindId kind, const base::GroupInfo& base, base::TaskRunner* tasks,
                 base::FrameSnapshot& snapshot)
{
    base::SnapshotGroup& group =
        addRows(*job.program, job.store->capacity(), job.rows.count, {kind, base}, snapshot);
    LookJob timed = job;
    timed.secondsBack = snapshot.secondsBack();
    LookBounds bounds = writeAll(timed, columnsOf(group), tasks);
    bounds.radius *= job.program->corner;
    group.editInfo().bounds = bounds.box();
}

void EmitterSolver::publishParticles(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const
{
    if (kinds_.particle == base::kNoKind)
        return;
    if (gpu_ && gpu_->isOn()) {
        base::GroupInfo info = base;
        info.isCosmetic = true;
        return gpu_->publish(info, kinds_.gpuParticle, key_, now_, snapshot);
    }
    publishRows(lookJob(), kinds_.particle, base, tasks_, snapshot);
}

bool EmitterSolver::joinPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                    EmitterCrowd& crowd) const
{
    if (!publishesWithMany_)
        return false;
    catchUpWithPool();
    const uint32_t rows = store_.window().count;
    base::SnapshotGroup& group =
        addRows(program_, store_.capacity(), rows, {kinds_.particle, base}, snapshot);
    if (rows == 0)
        return true;
    store_.fetch();
    LookJob& job = crowd.add(group);
    fill(job);
    job.secondsBack = snapshot.secondsBack();
    return true;
}

} // namespace fx::sim
