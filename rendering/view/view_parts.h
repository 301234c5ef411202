/// @file view_parts.h
/// What a ViewRenderer is made of: its lists, its memory on the GPU, and what it counts.
#pragma once

#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/host_targets/host_target_check.h"
#include "rendering/media/fragment_estimate.h"
#include "rendering/media/frame_builder.h"
#include "rendering/media/hot_areas.h"
#include "rendering/particle_rows/group_merger.h"
#include "rendering/particle_rows/particle_buffers.h"
#include "rendering/particle_rows/particle_frame.h"
#include "rendering/view/frame_key.h"
#include "rendering/view/layer_scale_control.h"
#include "rendering/view/view_graph.h"
#include "rendering/view/view_renderer.h"

#include <optional>

namespace fx::render {

struct ViewRenderer::Impl
{
    Impl(GlDevice* d, const base::SnapshotSchema* schema, std::pmr::memory_resource* memory)
        : device(d), graph(memory), backend(*d, memory), builder(memory), hotAreas(memory),
          merger(schema, memory), single{ParticleFrame(memory), ParticleBuffers(*d, memory)},
          joined{ParticleFrame(memory), ParticleBuffers(*d, memory)}, batches(memory), runs(memory),
          streams(memory), stamps(memory), targetCheck(*d), timer(*d)
    {}

    struct Particles
    {
        ParticleFrame frame;
        ParticleBuffers buffers;
    };

    base::Status checkTargets(const FrameRequest& request);
    base::Status ensureHistory();
    base::Status gather(const base::SnapshotPair& snapshots, const FrameRequest& request,
                        const ViewSettings& settings); ///< everything that is to be drawn
    base::Status gatherAnew(const base::SnapshotPair& snapshots, const StampPair& stamps,
                            const FrameRequest& request, const ViewSettings& settings);
    SnapshotRowStamps rowsOf(const base::FrameSnapshot* snapshot) const;
    base::Status makeRoom(GlBuffer& buffer, size_t bytes, const char* label);
    base::Status makeRoomForImpostors();
    base::Status add(Particles& particles, const ParticleFrameInputs& inputs, const UploadStamps& of);
    void releaseBlobs();
    void releaseImpostors();
    void releaseUnused();
    FrameStatistics rest();
    bool holdsNothing() const; ///< that rest() gives back
    FrameStatistics count(int divisor);
    void readBack(FrameStatistics& statistics); ///< waits for the GPU

    GlDevice* device;
    FrameGraph graph;
    GlBackend backend;
    FrameBuilder builder;
    HotAreas hotAreas;
    GroupMerger merger;
    Particles single; ///< groups as they are
    Particles joined; ///< small groups that are drawn alike
    std::pmr::vector<ParticleBatch> batches;
    DrawRuns runs;
    std::pmr::vector<DrawStream> streams;
    std::span<const MediaRun> mediaRuns;
    SnapshotStamps stamps;
    std::optional<FrameKey> key; ///< of the lists above and of what is on the GPU; nothing: not to be used
    bool keptLists = false;      ///< they were not made for this frame
    GlBuffer blobBuffer;
    uint32_t blobsUnused = 0; ///< frames, one after the other
    uint32_t impostorsUnused = 0;
    GlBuffer impostorBuffer;
    GlTexture impostorAtlas; ///< pictures of effects; nothing before the first
    const base::AssetTable* assets = nullptr;
    FragmentCounts fragments{}; ///< of this frame
    LayerScaleControl layerScale;
    HostTargetCheck targetCheck;
    GlPassTimer timer;
    TimingClock clock = TimingClock::Off;
    uint64_t tag = 0;
    GlBuffer dazzleHistory;
    uint32_t idleFrames = 0;   ///< one after the other in which there was nothing to draw
    bool historyFresh = false; ///< nothing has been adapted to yet
    ViewGraphOutputs outputs;
};

} // namespace fx::render
