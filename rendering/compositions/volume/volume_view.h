/// @file volume_view.h
/// What a view keeps to draw its balls of medium as voxel fields.
#pragma once

#include "rendering/compositions/media_composition.h"
#include "rendering/draw_order/depth_sort.h"
#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_light_pass.h"
#include "rendering/field/field_plan.h"
#include "rendering/field/field_source.h"
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
        Lists
    };

    std::array<std::span<const std::byte>, Lists> lists() const;
    void sortLoose(const GatherInputs& in, std::span<const BlobInstance> blobs);
    DrawStream looseStream() const;
    base::Status makeRoom(bool layers);
    base::Status makeTextures(size_t count);
    void release();
    void importAll(FrameGraph& graph);
    void upload(FrameGraph& graph);
    void addFields(FrameGraph& graph, const PassFrame& frame);
    void addLoose(FrameGraph& graph, const PassFrame& frame);

    GlDevice& device_;
    FieldPlan plan_;
    FieldSource source_;
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
