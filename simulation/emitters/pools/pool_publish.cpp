// What a pool of emitters publishes.
#include "foundation/snapshot/particle_kind.h"
#include "foundation/tasks/parallel_rows.h"
#include "simulation/emitters/pools/emitter_pool.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/row_publication.h"
#include "simulation/particles/rows_of_a_task.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint32_t kChunk = 1024;               // rows that are handed to a thread together
constexpr base::Ticks kEver = int64_t(1) << 60; // members have been moving for longer than any lifetime

uint32_t wholeLines(uint32_t rows)
{
    return (rows + kTilePadding - 1) / kTilePadding * kTilePadding;
}

/// The rows from `begin` to `end`, and those that share a vector with them.
void writeRange(const AppearanceJob& job, const AppearanceColumns& out, base::PooledRows::Range range,
                base::TaskRunner& tasks)
{
    const uint32_t begin = range.begin / kTilePadding * kTilePadding;
    const uint32_t end = std::min(wholeLines(range.end), job.rows.count);
    if (begin >= end)
        return;
    const uint32_t chunks = (end - begin + kChunk - 1) / kChunk;
    const uint32_t few = rowsOfATask(*job.program, kChunk) / kChunk;
    if (chunks <= few) {
        static_cast<void>(writeAppearance(job, out, begin, end));
        return;
    }
    parallelRows(tasks, chunks, few, [&](uint32_t first, uint32_t last) {
        static_cast<void>(
            writeAppearance(job, out, begin + first * kChunk, std::min(begin + last * kChunk, end)));
    });
}

} // namespace

void EmitterPool::publish(base::KindId kind, base::TaskRunner& tasks, base::FrameSnapshot& snapshot) const
{
    base::PooledRows& out = snapshot.addPool(kind, store_.capacity(), program_->published, each_);
    if (!out.rows.keepsConstants(program_->number))
        writeConstants(program_->def, program_->def.appearance, 1.0f, out.rows.editConstants());
    out.radiusColumn = base::particle_column::Radius;
    out.number = program_->number;
    out.corner = program_->corner;
    out.ageColumn = base::particle_column::Age;
    const bool isMoving = (program_->published & base::particle_column::kVelocity) != 0;
    out.velocityColumn = isMoving ? size_t(base::particle_column::VelocityX) : 0;
    out.along = program_->along;
    out.across = program_->across;
    out.secondsBack = kRoundedUp * snapshot.secondsBack();
    out.counts.assign(counts_.begin(), counts_.end());
    nameOwners(out);
    AppearanceJob job{program_.get(), &store_, store_.window(), now_, now_ - kEver, pull_};
    const RowWindow& rows = job.rows;
    if (rows.gapBegin < rows.gapEnd)
        out.used = {base::PooledRows::Range{0, rows.gapBegin}, {rows.gapEnd, rows.count}};
    else
        out.used = {base::PooledRows::Range{0, rows.count}, {0, 0}};
    const AppearanceColumns columns = columnsOf(out.rows);
    for (const base::PooledRows::Range& range : out.used)
        writeRange(job, columns, range, tasks);
}

/// Only of particles born since the snapshot was written last.
void EmitterPool::nameOwners(base::PooledRows& out) const
{
    const uint64_t known = out.writer == number_ ? out.writtenUpTo : 0;
    const uint64_t first = std::max(known, store_.front());
    uint64_t left = store_.next() - first;
    for (size_t row = store_.rowOf(first); left > 0; row = 0) {
        const size_t count = std::min<uint64_t>(left, store_.capacity() - row);
        std::copy_n(owner_.data() + row, count, out.owner.data() + row);
        left -= count;
    }
    out.writer = number_;
    out.writtenUpTo = store_.next();
}

} // namespace fx::sim
