/// @file bench_stage.h
/// A world that is stepped and published as a scene does it, with the time each frame took.
#pragma once

#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/world/world.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace fx::cli {

/// Steps of 1/60 s into a ring of snapshots.
class BenchStage
{
public:
    explicit BenchStage(uint32_t threads);

    void add(std::shared_ptr<const sim::EffectDef> effect, uint64_t seed);
    /// Publishes emitters that prefer the GPU as its input. Called before the first step.
    void computeOnGpu() { world_.setGpuParticles(true); }
    /// The newest snapshot, to be released.
    base::SnapshotPair last() { return ring_.acquire(); }
    void release(const base::SnapshotPair& pair) { ring_.release(pair); }
    /// Steps and publishes without a look at the clock.
    void play(uint32_t steps);
    /// The same for one timed frame: its time is added to times(), its published data to hash().
    void playTimed();

    const std::vector<double>& times() const { return times_; }         ///< [s] of the timed frames
    const std::vector<double>& hashTimes() const { return hashTimes_; } ///< [s] of hashing, not in times()
    uint64_t hash() const { return hash_; }
    uint64_t particles() const; ///< alive now
    uint64_t allocations() const { return memory_.allocationCount(); }
    base::TaskRunner& tasks() { return *tasks_; }
    const sim::StepCounters& counters() const { return counters_; }

private:
    const base::FrameSnapshot& frame();

    base::SnapshotSchema schema_;
    base::HostMemory memory_;
    std::unique_ptr<base::TaskRunner> tasks_;
    sim::World world_;
    base::SnapshotRing ring_;
    std::vector<sim::Slot> slots_;
    sim::StepCounters counters_;
    base::Ticks now_ = 0;
    std::vector<double> times_;
    std::vector<double> hashTimes_;
    uint64_t hash_ = 0;
};

/// [GB/s] read and written by copies of one half of so many bytes to the other, with the threads of `tasks`,
/// repeatedly, so that small sets stay in a cache. Larger sets are represented by 256 MiB.
double copyGigabytes(base::TaskRunner& tasks, double bytes);

/// The value below which the share `part` of `times` lies.
double quantile(std::vector<double> times, double part);

} // namespace fx::cli
