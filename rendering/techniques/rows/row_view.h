/// @file row_view.h
/// All rows of particles of one view. Techniques with a RowTechnique share this state, so that their groups
/// share batches, sort orders and buffers.
#pragma once

#include "rendering/particle_rows/group_merger.h"
#include "rendering/particle_rows/particle_buffers.h"
#include "rendering/particle_rows/particle_frame.h"
#include "rendering/techniques/draw_technique.h"

namespace fx::render {

std::unique_ptr<TechniqueView> makeRowView(const TechniqueSetup& setup);

class RowView final : public TechniqueView
{
public:
    explicit RowView(const TechniqueSetup& setup);

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override;
    const MediaSource* solids() const override { return source_.hasSolids() ? &source_ : nullptr; }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    void fence() override;
    void forget() override;
    void rest() override;
    void count(FrameStatistics& statistics) const override;
    uint64_t bytes() const override;
    bool canComputeParticles() const override { return !single_.buffers.refusesGpu(); }
    void warmUp(const base::GpuParticleProgram& emitter) override { single_.buffers.warmUp(emitter); }

private:
    struct Rows
    {
        ParticleFrame frame;
        ParticleBuffers buffers;
    };
    base::Status add(Rows& rows, const ParticleFrameInputs& inputs, const UploadRevisions& of,
                     const base::AssetTable* assets, GatheredFrame& io);
    void addCasters(const GatherInputs& in, std::pmr::vector<MediumCaster>& io) const;
    /// By group of the newer snapshot: 1 if the group is drawn as part of a merged group.
    std::span<const uint8_t> taken() const
    {
        return isMerged_ ? merger_.taken() : std::span<const uint8_t>();
    }

    std::pmr::vector<const RowTechnique*> techniques_;
    GroupMerger merger_;
    Rows single_; ///< groups that are not merged
    Rows joined_; ///< merged groups
    std::pmr::vector<ParticleBatch> batches_;
    BatchSource source_;
    bool isKept_ = false;
    bool isMerged_ = true; ///< true: small groups are merged
};

} // namespace fx::render
