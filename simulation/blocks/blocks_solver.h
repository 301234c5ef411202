/// @file blocks_solver.h
/// Solver of the blocks of one instance.
#pragma once

#include "simulation/blocks/blocks_def.h"
#include "simulation/solver/seekable_solver.h"

#include <array>

namespace fx::sim {

/// Steps the emitter of blocks, if there is one. The list of blocks and the content of types need no steps.
class BlocksSolver final : public Solver, public SeekableSolver
{
public:
    /// @param def definition; must outlive the solver
    BlocksSolver(const BlocksDef& def, const base::SnapshotSchema& schema, const Quality& quality,
                 std::pmr::memory_resource* memory);

    void step(const StepContext& context) override;
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override;
    bool finished(base::Ticks tick) const override { return emitter_ && emitter_->finished(tick); }
    uint32_t elementCount() const override;
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;
    SeekableSolver* seekable() override { return !emitter_ || emitter_->seekable() ? this : nullptr; }

    bool canSeek(const StepContext& context, base::Ticks tick) const override;
    void seek(const StepContext& context, base::Ticks tick) override;
    base::Ticks restsUntil(base::Ticks tick) const override;
    void standAt(const base::Placement& placement) override;

private:
    struct Kinds
    {
        base::KindId block, ball, blob, blockMaterial, material;
    };

    SeekableSolver* soughtEmitter() const { return emitter_ ? emitter_->seekable() : nullptr; }
    void addContent(const base::GroupInfo& base, uint32_t type, uint32_t phase,
                    base::FrameSnapshot& snapshot) const;
    void addContents(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    base::SnapshotGroup& addBlocks(const base::GroupInfo& base, float owner,
                                   std::span<const BlockPlacement> blocks, uint32_t capacity,
                                   base::FrameSnapshot& snapshot) const;
    base::SnapshotGroup& addRoot(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    bool hasMaterial() const { return def_.detail.given && kinds_.blockMaterial != base::kNoKind; }
    void openMaterial(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    void writeMaterial(const base::SnapshotGroup& root, base::SnapshotGroup& io) const;
    void writeEmitted(uint32_t i, const base::SnapshotGroup& particles, base::SnapshotGroup& io) const;
    void findUsed(const base::SnapshotGroup& root) const;
    void addBalls(const base::GroupInfo& base, size_t root, base::FrameSnapshot& snapshot) const;
    void addLateMaterial(size_t root, base::FrameSnapshot& snapshot) const;

    const BlocksDef& def_;
    Kinds kinds_;
    uint64_t hash_;                 ///< of the definition
    DetailGenerations generations_; ///< of blocks that do not move
    uint64_t stride_ = 1;           ///< ids that each block of the effect has for its balls
    std::unique_ptr<Solver> emitter_;
    base::Ticks now_ = 0;
    uint64_t seed_ = 0;                     ///< of the instance
    mutable base::FrameSnapshot particles_; ///< particles of the emitter, while they are published
    mutable std::array<bool, base::kMaxBlockVariants> isUsed_{}; ///< variants in the present publication
};

} // namespace fx::sim
