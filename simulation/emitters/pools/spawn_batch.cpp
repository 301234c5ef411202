#include "simulation/emitters/pools/spawn_batch.h"

#include "foundation/tasks/parallel_rows.h"
#include "simulation/particles/rows_of_a_task.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr size_t kMaxBirths = 1024; // that wait at a time

} // namespace

SpawnBatch::SpawnBatch(std::pmr::memory_resource* memory)
    : births_(memory), owners_(memory), alike_(memory), alikeOwners_(memory), open_(memory)
{}

void SpawnBatch::wait(PooledEmitter& emitter, const StepContext& context, std::span<const Birth> births)
{
    if (births_.capacity() == 0)
        makeRoom();
    if (waitsFor(emitter)) { // more than it has rows: in the order of birth
        makeBirths();
    } else {
        if (births_.size() + births.size() > kMaxBirths || open_.size() == kMaxBirths)
            close();
        open_.push_back(&emitter);
    }
    counters_ = context.counters;
    ParticleStore& store = emitter.store();
    for (const Birth& birth : births) {
        births_.push_back({&store, context.seed, birth, store.rowOf(birth.index), false});
        owners_.push_back({&emitter, &emitter.program(), context.solverIndex});
    }
}

/// All that it will ever take, so that later steps allocate nothing.
void SpawnBatch::makeRoom()
{
    owners_.reserve(kMaxBirths);
    alike_.reserve(kMaxBirths);
    alikeOwners_.reserve(kMaxBirths);
    open_.reserve(kMaxBirths);
    births_.reserve(kMaxBirths);
}

void SpawnBatch::close()
{
    makeBirths();
    for (PooledEmitter* const emitter : open_)
        emitter->endStep(*counters_);
    open_.clear();
}

/// Emitters of one definition together, whatever stands between them.
void SpawnBatch::makeBirths()
{
    for (size_t i = 0; i < owners_.size(); ++i)
        if (owners_[i].program)
            makeBirthsLike(owners_[i]);
    births_.clear();
    owners_.clear();
}

void SpawnBatch::makeBirthsLike(const Owner& first)
{
    const Owner kind = first;
    alike_.clear();
    alikeOwners_.clear();
    for (size_t i = size_t(&first - owners_.data()); i < owners_.size(); ++i) {
        Owner& owner = owners_[i];
        if (owner.program != kind.program || owner.solver != kind.solver)
            continue;
        alike_.push_back(births_[i]);
        alikeOwners_.push_back(owner.emitter);
        owner.program = nullptr;
    }
    storeScattered(*kind.program, kind.solver, alike_);
    for (size_t i = 0; i < alike_.size(); ++i)
        if (!alike_[i].isStored)
            alikeOwners_[i]->refuse(1, *counters_);
}

void SpawnBatch::forget()
{
    births_.clear();
    owners_.clear();
    open_.clear();
}

void SpawnBatch::beginPublication(base::FrameSnapshot& snapshot, base::TaskRunner* tasks)
{
    partCount_ = 0;
    rows_ = 0;
    snapshot_ = &snapshot;
    tasks_ = tasks;
}

uint64_t SpawnBatch::endPublication()
{
    writeParts();
    snapshot_ = nullptr;
    tasks_ = nullptr;
    return uint64_t(emitter_work::kDrawn * double(rows_));
}

void SpawnBatch::writeParts()
{
    const auto parts = std::span<AppearancePart>(parts_).first(partCount_);
    size_t bytes = 0;
    for (const AppearancePart& part : parts) {
        bytes += part.job.rows.count * bytesMoved(*part.job.program);
        rows_ += part.job.rows.count;
    }
    if (bytes <= kBytesOfATask)
        writeManyAppearances(parts);
    else
        parallelRows(
            *tasks_, uint32_t(parts.size()), uint32_t(kBytesOfATask * parts.size() / bytes) + 1,
            [&](uint32_t begin, uint32_t end) { writeManyAppearances(parts.subspan(begin, end - begin)); });
    for (AppearancePart& part : parts) {
        part.bounds.radius *= part.job.program->corner;
        snapshot_->editGroup(part.group).editInfo().bounds = part.bounds.box();
    }
    partCount_ = 0;
}

} // namespace fx::sim
