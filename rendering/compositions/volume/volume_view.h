/// @file volume_view.h
/// State of a view whose balls of medium are drawn as voxel fields.
#pragma once

#include "rendering/compositions/detail_resources.h"
#include "rendering/compositions/media_composition.h"
#include "rendering/compositions/slabs/slab_media.h"
#include "rendering/compositions/volume/volume_glow.h"
#include "rendering/compositions/volume/volume_network.h"
#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_light_pass.h"
#include "rendering/field/field_march_pass.h"
#include "rendering/field/field_near_pass.h"
#include "rendering/field/field_plan.h"
#include "rendering/field/field_slices_pass.h"
#include "rendering/field/field_texels.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/passes/blob_source.h"

#include <array>

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
    bool hasMedia() const override { return !plan_.isEmpty() || !loose_.isEmpty(); }
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
    /// Lists of FieldPlan that are uploaded to the GPU.
    enum List : size_t
    {
        Fields,
        Bricks,
        Balls,
        Texels,
        Tiles,
        Materials, ///< empty if no field has detail
        /// Balls, for fields that are filled before PassFrame::blobs is set; empty if no field has detail.
        Blobs,
        Stacks,     ///< SliceStackBlocks of the lights
        NearBricks, ///< empty if no ball is near the eye
        NearParts,
        Lists
    };

    std::array<std::span<const std::byte>, Lists> lists() const;
    void gatherLoose(const GatherInputs& in, GatheredFrame& io);
    base::Status makeRoom(bool layers);
    bool isUsed(size_t texture, bool layers) const;
    base::Status makeTexture(size_t i);
    base::Status makeTexels(GlTexture& io, size_t count, int columns, Format format, const char* name);
    void release();
    void importAll(FrameGraph& graph, bool layers);
    void upload(FrameGraph& graph);
    void fill(FrameGraph& graph, ResourceId blobs);
    void addFields(FrameGraph& graph, PassFrame& frame);
    /// Grids of emitted light; empty if illumination networks propagate it.
    std::span<const FieldGlowBlock> glows() const
    {
        return networkCells_ > 0 ? std::span<const FieldGlowBlock>() : plan_.glows();
    }
    void addFieldLight(FrameGraph& graph, const PassFrame& frame);
    void takeNearOut(FrameGraph& graph, ResourceId blobs);
    void addLooseBalls(FrameGraph& graph, const PassFrame& frame);

    GlDevice& device_;
    FieldPlan plan_;
    FieldTexels texels_;
    FieldMarchPass::Inputs march_{}; ///< inputs of the march in this frame
    std::pmr::vector<FieldDetailBlock> details_;
    std::span<const std::byte> stacks_; ///< SliceStackBlocks of the frame
    /// LightBindings::filled of the light slices to which detail was last added.
    uint64_t corrected_ = 0;
    std::span<const BlobMaterial> materials_; ///< materials of the balls in this frame
    VolumeGlow glow_;
    VolumeNetwork network_;               ///< used instead of glow_ if the settings request it
    int networkCells_ = 0;                ///< as FieldPlanInputs::networkCells in this frame; 0: no networks
    std::span<const BlobInstance> blobs_; ///< balls of this frame; empty if none has detail
    bool layers_ = false;                 ///< true: the frame has layer outputs
    glm::dvec3 eye_{0.0};                 ///< [m] world position of the eye of the frame
    /// Graph whose passes fill the textures with fields before the fields are lit.
    const FrameGraph* filledFor_ = nullptr;
    GlTexture texelTexture_, table_; ///< textures of FieldTexels and of the table of bricks
    LumpTileTexture lumpTile_;       ///< created when detail is drawn for the first time
    SlabMedia loose_;                ///< cards, and the balls of `looseSource_`
    BlobSource looseSource_;         ///< balls that are too small for voxels, and balls near the eye
    std::pmr::vector<BlobInstance> looseBlobs_;
    GlBuffer looseBuffer_, looseLights_;
    int slabs_ = 16; ///< least number of slabs for balls and cards outside of fields
    /// Buffers of the lists. They are imported as persistent resources, so that the next frame can reuse the
    /// content.
    std::array<GlBuffer, Lists> buffers_;
    std::array<ResourceId, Lists> ids_;                        ///< resource ids in this frame
    std::array<GlTexture, std::size(kFieldFormats)> textures_; ///< textures of fields; persistent resources
    bool isKept_ = false; ///< true: lists and textures have not changed since the last frame
    uint32_t unused_ = 0; ///< number of successive frames without balls
};

} // namespace fx::render
