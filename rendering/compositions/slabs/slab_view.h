/// @file slab_view.h
/// What a view keeps to draw its media in slabs.
#pragma once

#include "rendering/compositions/media_composition.h"
#include "rendering/compositions/slabs/slab_passes.h"

namespace fx::render {

class SlabView final : public CompositionView
{
public:
    explicit SlabView(const TechniqueSetup& setup);

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    bool hasMedia() const override { return ballSource_ || !cards_.empty(); }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    [[nodiscard]] MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                             const MediaPass::Outputs& under) override;
    void forget() override { tiles_ = heads_ = {}; }
    void rest() override { forget(); }
    void readBack(const GlBackend& backend, FrameStatistics& statistics) override;

private:
    uint64_t cardCapacity(const MediaPass::Inputs& in) const;

    GlDevice& device_;
    const MediaSource* ballSource_ = nullptr; ///< of all balls; null: there are none
    std::pmr::vector<DrawBatch> cards_;       ///< what else is drawn
    std::pmr::vector<TileRect> rects_;
    uint64_t cardFragments_ = 0; ///< estimated, of the whole picture
    int width_ = 0;              ///< [pixel] of the picture
    int slabs_ = 16;
    bool counts_ = false;      ///< what is listed and spilled
    ResourceId tiles_, heads_; ///< of the last frame, to be read back; invalid: not
    uint64_t capacity_ = 0;    ///< of the last frame's cards
};

} // namespace fx::render
