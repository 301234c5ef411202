/// @file field_media.h
/// The voxel fields of a frame: their plan, their lists and their textures on the GPU.
#pragma once

#include "rendering/compositions/detail_resources.h"
#include "rendering/compositions/volume_voxels.h"
#include "rendering/field/field_glow_pass.h"
#include "rendering/field/field_plan.h"
#include "rendering/field/field_texels.h"
#include "rendering/field/field_textures.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/techniques/draw_technique.h"

#include <array>
#include <span>

namespace fx::render {

/// Sums the balls of a frame in voxel fields. Buffers and textures are imported as persistent resources, so
/// that the next frame can reuse their content. Threads: [GL thread].
class FieldMedia
{
public:
    /// Lists that are uploaded to the GPU.
    enum List : size_t
    {
        Fields,
        Bricks,
        Balls,
        Texels,
        Tiles,
        Materials, ///< empty if no field has detail
        /// Balls, for fields that are filled before PassFrame::blobs is set; empty if no field has detail
        /// or is that of a volume.
        Blobs,
        Stacks,     ///< SliceStackBlocks of the lights
        NearBricks, ///< empty if no ball is near the eye
        NearParts,
        Lists
    };

    /// What the fields of a view are for.
    enum class Use
    {
        Pictures, ///< rays march through them; they may be filled before PassFrame::blobs is set
        Networks  ///< the cells of illumination networks; there are no layers
    };
    FieldMedia(const TechniqueSetup& setup, Use use);

    /// True if the settings ask for illumination networks.
    static bool asksForNetworks(const ViewSettings& settings);
    /// Plans the fields of a frame. The data of `from` must stay valid until the graph of the frame has
    /// executed.
    void build(const GatherInputs& in, const GatheredFrame& from);
    /// Forgets the fields of the last frame.
    void clear() { plan_.clear(); }
    /// Creates the buffers and textures of the frame. @return OutOfMemory
    base::Status makeRoom();
    /// Sets the list Stacks and creates its buffer. On failure the list is empty.
    bool setStacks(std::span<const std::byte> stacks);

    void importAll(FrameGraph& graph);
    void upload(FrameGraph& graph);
    /// Adds the passes that fill the textures. @param blobs buffer of all balls
    void fill(FrameGraph& graph, ResourceId blobs);

    const FieldPlan& plan() const { return plan_; }
    bool isEmpty() const { return plan_.isEmpty(); }
    bool hasDetail() const { return !details_.empty(); }
    /// True if samples differ from the smooth balls that light slices contain.
    bool differsFromBalls() const { return hasDetail() || !plan_.volumes().empty(); }
    /// As FieldPlanInputs::networkCells in this frame; 0: no networks.
    int networkCells() const { return networkCells_; }
    /// Grids of illumination networks; empty if there are none.
    std::span<const FieldGlowBlock> networks() const
    {
        return networkCells_ > 0 ? plan_.glows() : std::span<const FieldGlowBlock>();
    }
    /// Grids of emitted light; empty if illumination networks propagate it.
    std::span<const FieldGlowBlock> glows() const
    {
        return networkCells_ > 0 ? std::span<const FieldGlowBlock>() : plan_.glows();
    }

    ResourceId list(List list) const { return ids_[list]; } ///< buffer in this frame; invalid if empty
    ResourceId texels() const { return fieldTexels_; }      ///< texture of FieldTexelPass in this frame
    ResourceId lumpTile() const { return lumpTileId_; }     ///< invalid if no field has detail
    const FieldTextures& textures() const { return texturesIds_; }
    void setTextures(const FieldTextures& textures) { texturesIds_ = textures; }
    /// Inputs for passes that average fields in the cells of grids, without grids.
    FieldGlowPass::Inputs sources() const;

    /// Must be called if the passes of a frame have not run.
    void forget() { lumpTile_.forget(); }
    void release();
    uint64_t bytes() const;

private:
    void gatherVolumes(const GatherInputs& in, const GatheredFrame& from);
    void leaveFineVolumes();
    void wantLevels(const base::AssetTable* assets);
    void fillVolumes(FrameGraph& graph, ResourceId blobs);
    std::array<std::span<const std::byte>, Lists> contents() const;
    bool isUsed(size_t texture) const;
    base::Status makeTexture(size_t i);
    base::Status makeTexels(GlTexture& io, size_t count, int columns, Format format, const char* name);

    GlDevice& device_;
    FieldPlan plan_;
    FieldTexels texelList_;
    std::pmr::vector<FieldDetailBlock> details_;
    std::span<const BlobMaterial> materials_; ///< materials of the balls in this frame
    std::span<const BlobInstance> blobs_; ///< balls of this frame; empty if none has detail or is a volume's
    VolumeVoxels voxels_;
    std::pmr::vector<BlobEffect> effects_;       ///< effects of this frame
    std::pmr::vector<GroupVolume> groupVolumes_; ///< volumes of this frame, by BlobEffect::volume
    std::pmr::vector<ShownVoxels> shownVoxels_;  ///< the same with their voxels
    std::pmr::vector<FieldVolume> fieldVolumes_; ///< the same for FieldPlan
    float exposure_ = 1.0f;                      ///< [m2/cd] exposed value per luminance
    std::span<const std::byte> stacks_;
    int networkCells_ = 0;
    bool layers_ = false; ///< true: the frame has layer outputs
    Use use_;
    std::array<GlBuffer, Lists> buffers_;
    std::array<ResourceId, Lists> ids_; ///< resource ids in this frame
    std::array<GlTexture, std::size(kFieldFormats)> textures_;
    FieldTextures texturesIds_;
    GlTexture texelTexture_, table_; ///< textures of FieldTexels and of the table of bricks
    ResourceId fieldTexels_, lumpTileId_;
    LumpTileTexture lumpTile_; ///< created when detail is drawn for the first time
};

} // namespace fx::render
