/// @file bench_stage.h
/// A world that is stepped and published as in a scene, with the times of its frames.
#pragma once

#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/world/world.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace fx::cli {

/// Takes steps of 1/60 s and publishes them into a ring of snapshots.
class BenchStage
{
public:
    explicit BenchStage(uint32_t threads);

    void add(std::shared_ptr<const sim::EffectDef> effect, uint64_t seed);
    /// Publishes emitters that prefer the GPU as input of the GPU. The function must be called before the
    /// first step.
    void computeOnGpu() { world_.setGpuParticles(true); }
    /// The newest snapshot; the caller releases it.
    base::SnapshotPair last() { return ring_.acquire(); }
    void release(const base::SnapshotPair& pair) { ring_.release(pair); }
    /// Steps and publishes without timing.
    void play(uint32_t steps);
    /// Steps and publishes one timed frame. Adds its time to times() and its published data to hash().
    void playTimed();

    const std::vector<double>& times() const { return times_; } ///< [s] times of the timed frames
    /// [s] times of hashing, excluded from times()
    const std::vector<double>& hashTimes() const { return hashTimes_; }
    uint64_t hash() const { return hash_; }
    uint64_t particles() const; ///< number of living particles
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

/// [GB/s] Bandwidth, read and written, of repeated copies of one half of `bytes` to the other, with the
/// threads of `tasks`. Small sizes stay in a cache; sizes above 256 MiB are measured with 256 MiB.
double copyGigabytes(base::TaskRunner& tasks, double bytes);

/// Quantile: the value below which the fraction `part` of `times` lies.
double quantile(std::vector<double> times, double part);

} // namespace fx::cli
