/// @file frame_builder.h
/// Snapshots and a camera to the sorted list of blobs that the passes draw.
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

/// Owns the buffers of one view's frames; they grow to the largest frame and stay.
class FrameBuilder
{
public:
    explicit FrameBuilder(std::pmr::memory_resource* memory);

    /// Builds the list for one frame. Equal input gives equal bits. [GL thread, but no GL]
    /// @param lod begun for this frame
    /// @param content revision of the shown content, for impostors
    /// @param castsShadows as of gatherBlobs()
    /// @param isSorted false: blobs() come in the order of groups and ids
    void build(const base::SnapshotPair& snapshots, const FrameRequest& request, const ViewSettings& settings,
               const CameraGeometry& camera, LevelOfDetail& lod, uint64_t content = 0,
               bool castsShadows = true, bool isSorted = true);

    std::span<const BlobInstance> blobs() const { return sorted_; } ///< farthest first, unless not sorted
    /// Effects of blobs(); empty when blobs are sorted.
    std::span<const BlobEffect> effects() const { return effects_; }
    /// Materials of blobs() for the detail of their fields; empty if they are sorted.
    std::span<const BlobMaterial> materials() const { return materials_; }
    std::span<const GroupDetail> details() const { return fields_.details; }
    /// Marks of blobs(); empty without ViewSettings::outputs.
    std::span<const BlobMark> marks() const { return sortedMarks_; }
    bool anyHeat() const { return anyHeat_; }     ///< some blob bends light
    bool anyDetail() const { return anyDetail_; } ///< some blob has procedural detail
    /// All shadow casters, visible or not.
    std::span<const MediumCaster> casters() const { return casters_; }
    const GatherCounts& counts() const { return counts_; }
    /// The blobs as a stream whose elements are the drawn ones; count 0 without any.
    DrawStream stream() const;

    /// Effects that are drawn as pictures of themselves, farthest first, and their stream.
    std::span<const ImpostorInstance> impostors() const { return sortedImpostors_; }
    DrawStream impostorStream() const;
    /// Blobs of the effects whose impostors are rendered in this frame, relative to takingCamera().
    std::span<const BlobInstance> takenBlobs() const { return sortedTaken_; }
    std::span<const uint32_t> takenTiles() const { return takenTiles_; } ///< where each picture is kept
    /// An equal frame after this one would be the same, but for its camera and snapshots.
    bool isSettled() const { return impostors_.isSettled(); }
    void forgetPictures() { mustForget_ = true; } ///< those of the last frame were not taken

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
    std::pmr::vector<BlobMark> marks_, sortedMarks_; ///< of shaded_ and sorted_
    InstanceNames names_;
    bool isMarked_ = false; ///< the frame has marks
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
    std::pmr::vector<uint32_t> identity_; ///< order_ where nothing is sorted
    std::pmr::vector<uint32_t> takenTiles_;
    std::span<const uint32_t> impostorOrder_;
    Lighting lighting_; ///< of the last frame, as the next two
    HostLights hostLights_;
    SliceSettings slices_;
    float exposureEv100_ = 0.0f;
    uint64_t lightingRevision_ = 0;
    bool mustForget_ = false;
    GatherCounts counts_;
    std::span<const uint32_t> order_;
    bool isParallel_ = false;
    bool anyHeat_ = false;
    bool anyDetail_ = false;
};

} // namespace fx::render
