/// @file spawn_batch.h
/// Births and publications of many small emitters in one batch. Results are the same bits as for separate
/// emitters; a batch fills the lanes of random-number vectors and shares the fixed cost of a pass over
/// particles.
#pragma once

#include "simulation/emitters/pools/pooled_emitter.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/birth_kernel.h"

#include <array>
#include <memory_resource>
#include <vector>

namespace fx::sim {

/// Threads: one at a time (the scene thread); large publications run in parallel on the task runner.
class SpawnBatch
{
public:
    explicit SpawnBatch(std::pmr::memory_resource* memory);

    // ---- a step ----
    static constexpr size_t kMaxDeferredBirths =
        256; ///< largest number of deferred births of one emitter; more fill vectors without a batch
    /// `births` of `emitter`, up to kMaxDeferredBirths and up to its rows, are made by close() at the latest,
    /// and its step is ended then.
    void wait(PooledEmitter& emitter, const StepContext& context, std::span<const Birth> births);
    /// Whether its step is still to be ended.
    bool waitsFor(const PooledEmitter& emitter) const { return !open_.empty() && open_.back() == &emitter; }
    /// After an exception: discards pending births.
    void forget();
    /// Makes the deferred births.
    void makeBirths();
    /// Makes all pending births and ends the steps of their emitters. Must precede any read of them.
    void close();

    // ---- a publication ----
    void beginPublication(base::FrameSnapshot& snapshot, base::TaskRunner* tasks);
    /// Adds the last group of the snapshot, whose columns and bounds are to be filled. @return its job, to be
    /// filled in
    AppearanceJob& add(base::SnapshotGroup& group)
    {
        if (partCount_ == kMaxParts)
            writeParts();
        AppearancePart& part = parts_[partCount_++];
        part.storage = group.editStorage();
        part.group = snapshot_->groupCount() - 1;
        return part.job;
    }
    /// @return [unit] of base::WorkBudget that it counts
    uint64_t endPublication();

private:
    /// Whose a birth is.
    struct Owner
    {
        PooledEmitter* emitter;
        const ParticleProgram* program; ///< null: made
        uint32_t solver;
    };
    void makeRoom();
    void makeBirthsLike(const Owner& first);
    void writeParts();

    std::pmr::vector<ScatteredBirth> births_;
    std::pmr::vector<Owner> owners_; ///< of the births
    std::pmr::vector<ScatteredBirth> alike_;
    std::pmr::vector<PooledEmitter*> alikeOwners_;
    std::pmr::vector<PooledEmitter*> open_; ///< steps to be ended
    StepCounters* counters_ = nullptr;

    static constexpr size_t kMaxParts = 64; ///< so that they and their inputs fit into the L1 and L2 caches
    std::array<AppearancePart, kMaxParts> parts_;
    size_t partCount_ = 0;
    uint64_t rows_ = 0; ///< of the publication
    base::FrameSnapshot* snapshot_ = nullptr;
    base::TaskRunner* tasks_ = nullptr;
};

} // namespace fx::sim
