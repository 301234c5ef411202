/// @file slab_view.h
/// State of a view whose media are drawn in slabs.
#pragma once

#include "rendering/compositions/media_composition.h"
#include "rendering/compositions/slabs/slab_media.h"

namespace fx::render {

class SlabView final : public CompositionView
{
public:
    explicit SlabView(const TechniqueSetup& setup) : media_(setup) {}

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    bool hasMedia() const override { return !media_.isEmpty(); }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    [[nodiscard]] MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                             const MediaPass::Outputs& under) override;
    void forget() override { media_.forget(); }
    void rest() override { media_.forget(); }
    void readBack(const GlBackend& backend, FrameStatistics& statistics) override
    {
        media_.readBack(backend, statistics);
    }

private:
    SlabMedia media_;
    int slabs_ = 16;
};

} // namespace fx::render
