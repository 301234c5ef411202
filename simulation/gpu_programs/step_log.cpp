#include "simulation/gpu_programs/step_log.h"

#include "foundation/math/hash.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>

namespace fx::sim {

namespace {

uint64_t hashFloats(uint64_t hash, std::initializer_list<float> values)
{
    for (const float value : values)
        hash = base::hashWord(hash, std::bit_cast<uint32_t>(value));
    return hash;
}

uint64_t hashOf(uint64_t hash, const StepConditions& c)
{
    hash = hashFloats(
        hash, {c.gravity.x, c.gravity.y, c.gravity.z, c.wind.x, c.wind.y, c.wind.z, c.ground, c.intensity});
    return base::hashWord(hash, c.emitting ? 1 : 0);
}

} // namespace

void StepLog::clear(uint64_t seed, uint32_t solver)
{
    static std::atomic<uint64_t> clears = 0; // of all logs: a restored emitter is another one
    runs_.clear();
    // Histories that begin in different places must not be taken for each other.
    history_ = base::hashWord(base::hashWord(seed, solver), ++clears);
}

void StepLog::add(base::Ticks begin, base::Ticks length, uint64_t next, const StepConditions& conditions)
{
    if (!runs_.empty()) {
        Run& last = runs_.back();
        if (last.end() == begin && last.length == length && last.conditions == conditions &&
            last.count < std::numeric_limits<uint32_t>::max())
        {
            ++last.count;
            return;
        }
        history_ = base::hashWord(history_, last.count);
    }
    history_ = base::hashWord(base::hashWord(history_, uint64_t(begin)), uint64_t(length));
    history_ = hashOf(base::hashWord(history_, next), conditions);
    history_ += history_ == 0 ? 1 : 0; // 0 stands for nothing
    runs_.push_back({begin, length, 1, history_, conditions});
}

/// The first run is kept whole: its history is that of its first step.
void StepLog::forget(base::Ticks tick)
{
    size_t gone = 0;
    while (gone + 1 < runs_.size() && runs_[gone].end() < tick) // what follows goes on from the last one
        ++gone;
    runs_.erase(runs_.begin(), runs_.begin() + std::ptrdiff_t(gone));
}

uint64_t StepLog::stepsSince(base::Ticks tick) const
{
    uint64_t sum = 0;
    for (const Run& run : runs_)
        sum += run.count - run.firstSince(tick);
    return sum;
}

void StepLog::publish(base::Ticks now, std::span<base::GpuStepRun> out) const
{
    for (size_t i = 0; i < runs_.size(); ++i) {
        const Run& run = runs_[i];
        const StepConditions& c = run.conditions;
        out[i] = {now - run.begin,
                  run.length,
                  run.history,
                  run.count,
                  c.ground,
                  {c.gravity.x, c.gravity.y, c.gravity.z},
                  {c.wind.x, c.wind.y, c.wind.z}};
    }
}

} // namespace fx::sim
