/// @file frame_builder.h
/// Builds the list of blobs that the passes draw, from snapshots and a camera.
#pragma once

#include "rendering/draw_order/depth_sort.h"
#include "rendering/draw_order/draw_batcher.h"
#include "rendering/frame/view_types.h"
#include "rendering/lights/medium_caster.h"
#include "rendering/media/blob_gather.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/output_marks.h"

#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace fx::render {

/// Builds the frames of one view. Memory grows to the size of the largest frame and is kept.
class FrameBuilder
{
public:
    explicit FrameBuilder(std::pmr::memory_resource* memory);

    /// Builds the list for one frame. Equal input gives bit-identical results. [GL thread] Makes no GL
    /// calls.
    /// @param lod level of detail, for which LevelOfDetail::begin() has been called in this frame
    /// @param content revision of the shown content; impostors are rendered again if the revision changes
    /// @param castsShadows see gatherBlobs()
    /// @param late see gatherBlobs()
    /// @param isSorted true: blobs() are sorted by distance; false: by group and id
    /// @param otherEye camera of the other eye, to which turnTo() will be called; null: none
    void build(const base::SnapshotPair& snapshots, const FrameRequest& request, const ViewSettings& settings,
               const CameraGeometry& camera, LevelOfDetail& lod, uint64_t content = 0,
               bool castsShadows = true, bool isSorted = true, std::span<const LateBalls> late = {},
               const CameraGeometry* otherEye = nullptr);

    /// Shows the blobs of the last build() to the camera that was its `otherEye`. This function moves and
    /// sorts them; it does not gather or shade them again. It does not support effects that are drawn as
    /// impostors.
    void turnTo(const CameraGeometry& camera);

    /// Blobs, sorted by decreasing distance. If build() had isSorted = false, blobs are sorted by group and
    /// id.
    std::span<const BlobInstance> blobs() const { return sorted_; }
    /// Effects to which blobs() belong; empty if blobs are sorted.
    std::span<const BlobEffect> effects() const { return effects_; }
    /// Noise coordinates of blobs(), in the order of blobs(), for the detail of fields. Empty if blobs are
    /// sorted.
    std::span<const BlobMaterial> materials() const { return materials_; }
    std::span<const GroupDetail> details() const { return fields_.details; }
    std::span<const GroupVolume> volumes() const { return fields_.volumes; }
    /// Marks of blobs(), in the order of blobs(). Empty without ViewSettings::outputs.
    std::span<const BlobMark> marks() const { return sortedMarks_; }
    bool anyHeat() const { return anyHeat_; }     ///< true if a blob causes heat shimmer
    bool anyDetail() const { return anyDetail_; } ///< true if a blob has procedural detail
    /// All shadow casters, visible or not.
    std::span<const MediumCaster> casters() const { return casters_; }
    const GatherCounts& counts() const { return counts_; }
    /// Stream that draws blobs(). DrawStream::count is 0 if there are no blobs.
    DrawStream stream() const;

    /// The drawn impostors, by decreasing distance.
    std::span<const ImpostorInstance> impostors() const { return sortedImpostors_; }
    /// Stream that draws impostors().
    DrawStream impostorStream() const;
    /// Blobs of the effects whose impostors are rendered in this frame, relative to takingCamera().
    std::span<const BlobInstance> takenBlobs() const { return sortedTaken_; }
    std::span<const uint32_t> takenTiles() const { return takenTiles_; } ///< tile of each rendered impostor
    /// True if another frame with equal camera and snapshots would equal the last frame.
    bool isSettled() const { return impostors_.isSettled(); }
    /// Must be called if the impostors of the last frame were not rendered.
    void forgetPictures() { mustForget_ = true; }

private:
    void shade(const ViewSettings& settings, const CameraGeometry& camera, bool isSorted);
    void shade(const GatheredBlob& blob, const InstanceBlobs& instance, float exposure,
               const CameraGeometry& camera);
    void addEffect(const BlobRun& run, size_t begin);
    void sort(const CameraGeometry& camera, bool isSorted);
    void beginImpostors(const FrameRequest& request, const ViewSettings& settings,
                        const CameraGeometry& camera, uint64_t content);
    void sortImpostors(const CameraGeometry& camera);
    void add(const BlobInstance& blob, const ImpostorPlan& plan, const CameraGeometry& camera);

    std::pmr::vector<GatheredBlob> gathered_;
    std::pmr::vector<MediumCaster> casters_;
    std::pmr::vector<InstanceBlobs> instances_;
    std::pmr::vector<BlobInstance> shaded_;
    FieldGather fields_;
    std::pmr::vector<BlobMaterial> materials_;
    std::pmr::vector<BlobMark> marks_, sortedMarks_; ///< marks of shaded_ and sorted_
    InstanceNames names_;
    bool isMarked_ = false; ///< true: the frame has marks
    std::pmr::vector<BlobEffect> effects_;
    std::pmr::vector<std::pair<float, float>> radii_; ///< scratch: radius and cross section
    std::pmr::vector<BlobInstance> sorted_;
    std::pmr::vector<float> distances_;
    DepthSort depthSort_;
    ImpostorField impostors_;
    DepthSort impostorSort_;
    DepthSort takenSort_;
    std::pmr::vector<ImpostorInstance> sortedImpostors_;
    std::pmr::vector<BlobInstance> taken_;
    std::pmr::vector<BlobInstance> sortedTaken_;
    std::pmr::vector<float> takenDistances_;
    std::pmr::vector<uint32_t> identity_; ///< the numbers 0, 1, 2, ..., as order of unsorted blobs
    std::pmr::vector<uint32_t> takenTiles_;
    std::span<const uint32_t> impostorOrder_;
    Lighting lighting_; ///< lighting of the last frame
    HostLights hostLights_;
    SliceSettings slices_;
    float exposureEv100_ = 0.0f;
    uint64_t lightingRevision_ = 0;
    bool mustForget_ = false;
    GatherCounts counts_;
    glm::dvec3 eye_{0.0}; ///< [m] world, to which the lists are relative
    bool isSorted_ = true;
    std::span<const uint32_t> order_;
    bool isParallel_ = false;
    bool anyHeat_ = false;
    bool anyDetail_ = false;
};

} // namespace fx::render
