/// @file frame_builder.h
/// Snapshots and a camera to the sorted list of blobs that the passes draw.
#pragma once

#include "rendering/lights/effect_lights.h"
#include "rendering/lights/extinction_grid.h"
#include "rendering/lights/light.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/view/blob_gather.h"
#include "rendering/view/depth_sort.h"
#include "rendering/view/draw_runs.h"
#include "rendering/view/view_types.h"

#include <array>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// Owns the buffers of one view's frames; they grow to the largest frame and stay.
class FrameBuilder
{
public:
    explicit FrameBuilder(std::pmr::memory_resource* memory);

    /// Builds the list for one frame. Equal input gives equal bits. [GL thread, but no GL]
    void build(const base::SnapshotPair& snapshots, const FrameRequest& request, const ViewSettings& settings,
               const CameraGeometry& camera);

    std::span<const BlobInstance> blobs() const { return sorted_; } ///< farthest first
    bool anyHeat() const { return anyHeat_; }                       ///< some blob bends light
    bool anyDetail() const { return anyDetail_; }                   ///< some blob has procedural detail
    const GatherCounts& counts() const { return counts_; }
    /// The brightest fires of all effects, brightest first.
    std::span<const EffectLight> lights() const { return {lights_.data(), lightCount_}; }
    /// The blobs as a stream whose elements are the drawn ones; count 0 without any.
    DrawStream stream() const;

private:
    void shade(const base::SnapshotPair& snapshots, const ViewSettings& settings,
               const CameraGeometry& camera);
    void sort(const CameraGeometry& camera);

    std::pmr::vector<GatheredBlob> gathered_;
    std::pmr::vector<GridBlob> gridBlobs_;
    std::pmr::vector<InstanceBlobs> instances_;
    std::pmr::vector<BlobInstance> shaded_;
    std::pmr::vector<BlobInstance> sorted_;
    std::pmr::vector<float> distances_;
    std::pmr::vector<BallLight> fires_;
    ExtinctionGrid grid_;
    DepthSort depthSort_;
    GatherCounts counts_;
    std::array<EffectLight, 4> lights_;
    size_t lightCount_ = 0;
    std::span<const uint32_t> order_;
    bool isParallel_ = false;
    bool anyHeat_ = false;
    bool anyDetail_ = false;
};

} // namespace fx::render
