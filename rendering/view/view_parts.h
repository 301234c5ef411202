/// @file view_parts.h
/// Parts of a ViewRenderer: states of its techniques, the lists of a frame, and counters.
#pragma once

#include "rendering/compositions/media_compositions.h"
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

/// A frame that has been gathered for its lights and is still to be drawn.
struct PreparedFrame
{
    FrameKey key;
    bool resetHistory;
    bool isSettled; ///< the key may become that of the lists
    uint64_t glCalls;
    uint32_t programsCompiled;
};

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
    base::Status begin(const base::SnapshotPair& snapshots, const FrameRequest& request,
                       const ViewSettings& settings); ///< the parts, then gather()
    void compose(const ViewSettings& settings); ///< makes parts that settings ask for, in place of others
    base::Status fillLights(const ViewSettings& settings);
    void dropPrepared(); ///< lists that were gathered and not drawn
    /// Whether prepareLights() has built the lists of this frame; they are then reused.
    bool takePrepared(const base::SnapshotPair& snapshots, const FrameRequest& request,
                      const ViewSettings& settings);
    void namePasses(bool wasPrepared);
    void noteFilling(const GroupTimes& times);
    SnapshotRowRevisions rowsOf(const base::FrameSnapshot* snapshot) const;
    base::Status draw(const FrameRequest& request, const ViewSettings& settings, int divisor);
    void forget(); ///< invalidates data of this frame
    void askWhetherParticlesAreComputed();
    uint64_t bytes() const;
    FrameStatistics rest();
    bool holdsNothing() const; ///< that rest() gives back
    FrameStatistics count(int divisor);

    GlDevice* device;
    const base::SnapshotSchema* schema;
    std::pmr::memory_resource* memory;
    FrameGraph graph;
    GlBackend backend;
    FrameGraph lightGraph; ///< of prepareLights(); separate from that of the last frame
    GlBackend lightBackend;
    DrawTechniques techniques;
    std::pmr::vector<std::unique_ptr<TechniqueView>>
        parts;                         ///< of techniques, in their order; then `outputs`, then `composition`
    const MediaComposition* composing; ///< of the last frame
    CompositionView* composition = nullptr; ///< among the parts; null: it keeps nothing
    OutputView* outputView = nullptr;       ///< among the parts; null: there are no outputs
    FrameHistory history;                   ///< while there are outputs
    LevelOfDetail lod;
    ViewLights lights;
    std::pmr::vector<MediumCaster> casters;
    std::array<EffectLight, kMaxEffectLights> glows; ///< of the effects, brightest first
    size_t glowCount = 0;
    DrawBatcher batcher;
    std::pmr::vector<DrawStream> streams;
    std::span<const DrawBatch> mediaBatches;
    std::pmr::vector<const MediaSource*> solids;
    SnapshotRevisions revisions;
    std::optional<FrameKey> key; ///< of the lists above and the data on the GPU; empty: invalid
    bool keptLists = false;      ///< they were not made for this frame
    std::optional<PreparedFrame> prepared;
    bool hasLights = false;                       ///< `lights` are those of the last frame
    std::pmr::vector<std::string_view> passNames; ///< that the last frame executed
    const base::AssetTable* assets = nullptr;
    FragmentCounts fragments{}; ///< of this frame
    LayerScaleControl layerScale;
    HostTargetCheck targetCheck;
    GlPassTimer timer;
    GlPassTimer lightTimer;        ///< of prepared lights
    double fillMilliseconds = 0.0; ///< of the last timed frame that filled planes of lights
    TimingClock clock = TimingClock::Off;
    uint64_t tag = 0;
    bool computesParticles = true; ///< result of the last check, after drawing and compiling
    uint32_t idleFrames = 0;       ///< consecutive frames without visible data
    ViewGraphOutputs outputs;
};

} // namespace fx::render
