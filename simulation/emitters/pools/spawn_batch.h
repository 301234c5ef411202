/// @file spawn_batch.h
/// Computes births and publications of many small emitters in one batch. Results have the same bits as
/// without a batch. A batch fills the lanes of random-number vectors and shares the fixed cost of a pass over
/// particles.
#pragma once

#include "simulation/emitters/pools/pooled_emitter.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/birth_kernel.h"

#include <array>
#include <memory_resource>
#include <vector>

namespace fx::sim {

/// A batch of births and publications of small emitters. Threads: one at a time (the scene thread). Large
/// publications use the threads of the task runner.
class SpawnBatch
{
public:
    explicit SpawnBatch(std::pmr::memory_resource* memory);

    // ---- a step ----
    /// Largest number of births of one emitter that are deferred. Larger numbers of births fill vectors
    /// without a batch.
    static constexpr size_t kMaxDeferredBirths = 256;
    /// Defers `births` and the end of the step of `emitter`. The number of births must not exceed
    /// kMaxDeferredBirths or the number of rows of the emitter. close() executes the deferred work at the
    /// latest.
    void wait(PooledEmitter& emitter, const StepContext& context, std::span<const Birth> births);
    /// True if the end of the emitter's step is deferred.
    bool waitsFor(const PooledEmitter& emitter) const { return !open_.empty() && open_.back() == &emitter; }
    /// Allocates all memory that steps will need.
    void reserve()
    {
        if (births_.capacity() == 0)
            makeRoom();
    }
    /// Discards pending births. For use after an exception.
    void forget();
    /// Computes the deferred births.
    void makeBirths();
    /// Computes all pending births and ends the steps of their emitters. Must be called before any access to
    /// these emitters.
    void close();

    // ---- a publication ----
    void beginPublication(base::FrameSnapshot& snapshot, base::TaskRunner* tasks);
    /// Adds the last group of the snapshot; its columns and bounds are computed later. @return job of the
    /// group, which the caller fills in
    AppearanceJob& add(base::SnapshotGroup& group)
    {
        if (partCount_ == kMaxParts)
            writeParts();
        AppearancePart& part = parts_[partCount_++];
        part.storage = group.editStorage();
        part.group = snapshot_->groupCount() - 1;
        return part.job;
    }
    /// Completes the groups of the publication. @return [unit of base::WorkBudget] work of the call
    uint64_t endPublication();

private:
    struct Owner
    {
        PooledEmitter* emitter;
        const ParticleProgram* program; ///< null: the birth is already computed
        uint32_t solver;
    };
    void makeRoom();
    void makeBirthsLike(const Owner& first);
    void writeParts();

    std::pmr::vector<ScatteredBirth> births_;
    std::pmr::vector<Owner> owners_; ///< owners of the births
    std::pmr::vector<ScatteredBirth> alike_;
    std::pmr::vector<PooledEmitter*> alikeOwners_;
    std::pmr::vector<PooledEmitter*> open_; ///< steps to be ended
    StepCounters* counters_ = nullptr;

    /// Maximum number of parts that are computed together. The parts and their inputs fit into the L1 and L2
    /// caches.
    static constexpr size_t kMaxParts = 64;
    std::array<AppearancePart, kMaxParts> parts_;
    size_t partCount_ = 0;
    uint64_t rows_ = 0; ///< number of rows of the publication
    base::FrameSnapshot* snapshot_ = nullptr;
    base::TaskRunner* tasks_ = nullptr;
};

} // namespace fx::sim
