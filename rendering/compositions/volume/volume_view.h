/// @file volume_view.h
/// What a view keeps to draw its balls of medium as voxel fields.
#pragma once

#include "rendering/compositions/media_composition.h"
#include "rendering/compositions/volume/volume_glow.h"
#include "rendering/draw_order/depth_sort.h"
#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_light_pass.h"
#include "rendering/field/field_plan.h"
#include "rendering/field/field_slices_pass.h"
#include "rendering/field/field_source.h"
#include "rendering/field/lump_tile_pass.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/passes/blob_source.h"

#include <array>

namespace fx::render {

/// Puts the fields in place of the balls into the streams of the media pass. Cards are drawn there between
/// shells of the fields, by their distance.
class VolumeView final : public CompositionView
{
public:
    explicit VolumeView(const TechniqueSetup& setup);

    base::Status gather(const GatherInputs& in, GatheredFrame& io) override;
    void keep() override { isKept_ = true; }
    bool hasMedia() const override { return false; } // all of it is in streams
    void addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame) override;
    [[nodiscard]] MediaPass::Outputs compose(FrameGraph&, const MediaPass::Inputs&,
                                             const MediaPass::Outputs& under) override
    {
        return under;
    }
    void forget() override;
    void endFrame(bool succeeded) override;
    void rest() override;
    uint64_t bytes() const override;

private:
    /// What FieldPlan lists, on the GPU.
    enum List : size_t
    {
        Fields,
        Bricks,
        Table,
        Balls,
        Tiles,
        TileFields,
        Details, ///< none where no field has detail, as the next
        Materials,
        Stacks, ///< of the lights
        Lists
    };

    std::array<std::span<const std::byte>, Lists> lists() const;
    void sortLoose(const GatherInputs& in, std::span<const BlobInstance> blobs);
    DrawStream looseStream() const;
    base::Status makeRoom(bool layers);
    bool isUsed(size_t texture, bool layers) const;
    base::Status makeTexture(size_t i);
    base::Status makeLumpTile();
    void release();
    void importAll(FrameGraph& graph, bool layers);
    void upload(FrameGraph& graph);
    void addFields(FrameGraph& graph, PassFrame& frame);
    void addLoose(FrameGraph& graph, const PassFrame& frame);

    GlDevice& device_;
    FieldPlan plan_;
    FieldSource source_;
    std::pmr::vector<FieldDetailBlock> details_;
    std::span<const std::byte> stacks_;       ///< SliceStackBlocks of the frame
    uint64_t corrected_ = 0;                  ///< filling of the light slices that has the detail
    std::span<const BlobMaterial> materials_; ///< of the frame
    VolumeGlow glow_;
    GlTexture lumpTile_;     ///< nothing before detail is seen
    bool hasLumps_ = false;  ///< it is filled
    BlobSource looseSource_; ///< of balls that are too small for voxels
    DepthSort looseSort_;
    std::pmr::vector<float> looseDistances_;
    std::pmr::vector<BlobInstance> looseBlobs_; ///< farthest first
    std::span<const uint32_t> looseOrder_;
    GlBuffer looseBuffer_, looseLights_;
    std::array<GlBuffer, Lists> buffers_; ///< last, so that what is in them is still there in the next frame
    std::array<ResourceId, Lists> ids_;   ///< of the frame
    std::array<GlTexture, std::size(kFieldFormats)> textures_; ///< likewise
    bool isKept_ = false; ///< lists and textures are those of the last frame
    uint32_t unused_ = 0; ///< frames, one after the other
};

} // namespace fx::render
