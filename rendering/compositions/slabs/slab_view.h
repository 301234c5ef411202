/// @file slab_view.h
/// State of a view whose media are drawn in slabs.
#pragma once

#include "rendering/compositions/detail_resources.h"
#include "rendering/compositions/field_media.h"
#include "rendering/compositions/media_composition.h"
#include "rendering/compositions/slabs/slab_media.h"
#include "rendering/compositions/view_network.h"

namespace fx::render {

/// Sums media in slabs of each ray. If the settings ask for illumination networks, balls are also summed in
/// voxel fields, which fill the cells of the networks; the light of the networks is gathered for each ball
/// and eye.
class SlabView final : public CompositionView
{
public:
    explicit SlabView(const TechniqueSetup& setup)
        : device_(*setup.device), media_(setup), details_(setup.memory),
          fields_(setup, FieldMedia::Use::Networks), network_(*setup.device, setup.memory)
    {}

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override { isKept_ = true; }
    bool hasMedia() const override { return !media_.isEmpty(); }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    [[nodiscard]] MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                             const MediaPass::Outputs& under) override;
    void forget() override;
    void endFrame(bool succeeded) override;
    void rest() override;
    uint64_t bytes() const override
    {
        return lumpTile_.bytes() + fields_.bytes() + network_.bytes() + lights_.bytes();
    }
    void readBack(const GlBackend& backend, FrameStatistics& statistics) override
    {
        media_.readBack(backend, statistics);
    }

private:
    base::Status gatherNetwork(const GatherInputs& in, const GatheredFrame& from);
    void addNetwork(FrameGraph& graph, const PassFrame& frame);

    GlDevice& device_;
    SlabMedia media_;
    std::pmr::vector<FieldDetailBlock> details_; ///< detail of the fields of this frame
    /// Materials of the balls in this frame; empty if details_ is empty.
    std::span<const BlobMaterial> materials_;
    LumpTileTexture lumpTile_; ///< created when detail is drawn for the first time
    ResourceId lumps_;         ///< resource id of lumpTile_ in this frame's graph
    uint32_t unused_ = 0;      ///< number of successive frames without detail
    FieldMedia fields_;        ///< empty without illumination networks
    ViewNetwork network_;
    GlBuffer lights_;            ///< of balls in networks; other passes read those of BallList
    bool hasNetwork_ = false;    ///< true: the lights of balls are those of `network_` in this frame
    bool isKept_ = false;        ///< true: lists and textures have not changed since the last frame
    uint32_t networkUnused_ = 0; ///< number of successive frames without networks
    int slabs_ = 16;
};

} // namespace fx::render
