/// @file view_parts.h
/// What a ViewRenderer is made of: what its techniques keep, the lists of a frame, and what it counts.
#pragma once

#include "rendering/frame/fragment_counts.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_device.h"
#include "rendering/host_targets/host_target_check.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/slices/view_lights.h"
#include "rendering/lod/level_of_detail.h"
#include "rendering/view/frame_key.h"
#include "rendering/view/layer_scale_control.h"
#include "rendering/view/view_graph.h"
#include "rendering/view/view_renderer.h"

#include <array>
#include <optional>

namespace fx::render {

struct ViewRenderer::Impl
{
    Impl(GlDevice* d, const base::SnapshotSchema* schema, std::pmr::memory_resource* memory,
         DrawTechniques list);

    base::Status checkTargets(const FrameRequest& request);
    bool leavesPictureAlone(const base::SnapshotPair& snapshots, const FrameRequest& request,
                            const ViewSettings& settings) const;
    base::Status gather(const base::SnapshotPair& snapshots, const FrameRequest& request,
                        const ViewSettings& settings); ///< everything that is to be drawn
    base::Status gatherAnew(const base::SnapshotPair& snapshots, const RevisionPair& revisions,
                            const FrameRequest& request, const ViewSettings& settings);
    SnapshotRowRevisions rowsOf(const base::FrameSnapshot* snapshot) const;
    base::Status draw(const FrameRequest& request, const ViewSettings& settings, int divisor);
    void forget(); ///< what this frame was to write
    void askWhetherParticlesAreComputed();
    uint64_t bytes() const;
    FrameStatistics rest();
    bool holdsNothing() const; ///< that rest() gives back
    FrameStatistics count(int divisor);

    GlDevice* device;
    FrameGraph graph;
    GlBackend backend;
    DrawTechniques techniques;
    std::pmr::vector<std::unique_ptr<TechniqueView>> parts; ///< of techniques, in their order
    LevelOfDetail lod;
    ViewLights lights;
    std::pmr::vector<MediumCaster> casters;
    DrawBatcher batcher;
    std::pmr::vector<DrawStream> streams;
    std::span<const DrawBatch> mediaBatches;
    std::pmr::vector<const MediaSource*> solids;
    SnapshotRevisions revisions;
    std::optional<FrameKey> key; ///< of the lists above and of what is on the GPU; nothing: not to be used
    bool keptLists = false;      ///< they were not made for this frame
    const base::AssetTable* assets = nullptr;
    FragmentCounts fragments{}; ///< of this frame
    LayerScaleControl layerScale;
    HostTargetCheck targetCheck;
    GlPassTimer timer;
    TimingClock clock = TimingClock::Off;
    uint64_t tag = 0;
    bool computesParticles = true; ///< all parts could when last asked: after drawing and compiling
    uint32_t idleFrames = 0;       ///< one after the other in which there was nothing to draw
    ViewGraphOutputs outputs;
};

} // namespace fx::render
