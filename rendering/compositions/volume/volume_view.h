/// @file volume_view.h
/// State of a view whose balls of medium are drawn as voxel fields.
#pragma once

#include "rendering/compositions/field_media.h"
#include "rendering/compositions/media_composition.h"
#include "rendering/compositions/slabs/slab_media.h"
#include "rendering/compositions/view_network.h"
#include "rendering/compositions/volume/volume_glow.h"
#include "rendering/field/field_light_pass.h"
#include "rendering/field/field_march_pass.h"
#include "rendering/field/field_near_pass.h"
#include "rendering/field/field_slices_pass.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/passes/blob_source.h"

namespace fx::render {

/// Sums balls in voxel fields, and marches rays through the fields. Cards (flat particles), and balls that
/// are too small for voxels, are summed in slabs along these rays. Without fields, the result is equal to
/// the result of the composition `slabs`.
class VolumeView final : public CompositionView
{
public:
    explicit VolumeView(const TechniqueSetup& setup);

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override { isKept_ = true; }
    bool hasMedia() const override { return !fields_.isEmpty() || !loose_.isEmpty(); }
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    [[nodiscard]] LightBindings addLightPasses(FrameGraph& graph, const LightBindings& lights) override;
    [[nodiscard]] MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                             const MediaPass::Outputs& under) override;
    void forget() override;
    void endFrame(bool succeeded) override;
    void rest() override;
    uint64_t bytes() const override;
    void readBack(const GlBackend& backend, FrameStatistics& statistics) override
    {
        loose_.readBack(backend, statistics);
    }

private:
    void gatherLoose(const GatherInputs& in, GatheredFrame& io);
    base::Status makeRoom();
    void release();
    void importAll(FrameGraph& graph);
    void addFields(FrameGraph& graph, PassFrame& frame);
    void addFieldLight(FrameGraph& graph, const PassFrame& frame);
    void takeNearOut(FrameGraph& graph, ResourceId blobs, bool detail);
    void addLooseBalls(FrameGraph& graph, const PassFrame& frame);

    GlDevice& device_;
    FieldMedia fields_;
    /// LightBindings::filled of the light slices to which detail was last added.
    uint64_t corrected_ = 0;
    VolumeGlow glow_;
    ViewNetwork network_; ///< used instead of glow_ if the settings request it
    glm::dvec3 eye_{0.0}; ///< [m] world position of the eye of the frame
    /// Graph whose passes fill the textures with fields before the fields are lit.
    const FrameGraph* filledFor_ = nullptr;
    SlabMedia loose_;        ///< cards, and the balls of `looseSource_`
    BlobSource looseSource_; ///< balls that are too small for voxels, and balls near the eye
    std::pmr::vector<BlobInstance> looseBlobs_;
    GlBuffer looseBuffer_, looseLights_;
    int slabs_ = 16;      ///< least number of slabs for balls and cards outside of fields
    bool isKept_ = false; ///< true: lists and textures have not changed since the last frame
    uint32_t unused_ = 0; ///< number of successive frames without balls
};

} // namespace fx::render
