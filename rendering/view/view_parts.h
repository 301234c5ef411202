/// @file view_parts.h
/// Implementation of ViewRenderer: states of its techniques, the lists of a frame, and counters.
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

/// A frame that prepareLights() has gathered and that is not drawn yet.
struct PreparedFrame
{
    FrameKey key;
    bool resetHistory;
    bool isSettled; ///< true: later frames with the same key may reuse the lists
    uint64_t glCalls;
    uint32_t programsCompiled;
};

/// State of a frame of two eyes, which are drawn one after the other.
struct StereoFrame
{
    /// Camera of the second eye while the first eye is drawn; otherwise null.
    const CameraGeometry* otherCamera = nullptr;
    bool isSecond = false;    ///< true: the second eye is drawn
    bool hasLists = false;    ///< true: the lists have been gathered for both eyes
    glm::dvec3 firstEye{0.0}; ///< [m] world, eye that the level of detail depends on
    int divisor = 1;          ///< divisor of the layers of the first eye
};

struct ViewRenderer::Impl
{
    Impl(GlDevice* d, const base::SnapshotSchema* schema, std::pmr::memory_resource* memory,
         DrawTechniques list);

    base::Status checkTargets(const FrameRequest& request);
    bool leavesPictureAlone(const base::SnapshotPair& snapshots, const FrameRequest& request,
                            const ViewSettings& settings) const;
    base::Status gather(const base::SnapshotPair& snapshots, const FrameRequest& request,
                        const ViewSettings& settings); ///< gathers all data to draw
    base::Status gatherAnew(const base::SnapshotPair& snapshots, const RevisionPair& revisions,
                            const FrameRequest& request, const ViewSettings& settings);
    base::Status begin(const base::SnapshotPair& snapshots, const FrameRequest& request,
                       const ViewSettings& settings); ///< begins a frame of all parts, then calls gather()
    /// Creates the states that the settings request, and deletes all other states.
    void compose(const ViewSettings& settings);
    base::Status fillLights(const ViewSettings& settings);
    void dropPrepared(); ///< discards lists that prepareLights() has gathered and that were not drawn
    /// If prepareLights() has built the lists of this frame, reuses them and returns true.
    bool takePrepared(const base::SnapshotPair& snapshots, const FrameRequest& request,
                      const ViewSettings& settings);
    void namePasses(bool wasPrepared);
    void noteFilling(const GroupTimes& times);
    SnapshotRowRevisions rowsOf(const base::FrameSnapshot* snapshot) const;
    base::Status findDepth(FrameRequest& io);
    base::Status draw(const FrameRequest& request, const ViewSettings& settings, int divisor);
    void forget(); ///< invalidates the data of this frame
    void askWhetherParticlesAreComputed();
    uint64_t bytes() const;
    FrameStatistics rest();
    bool holdsNothing() const; ///< true if rest() would release no memory
    FrameStatistics count(int divisor);

    GlDevice* device;
    const base::SnapshotSchema* schema;
    std::pmr::memory_resource* memory;
    FrameGraph graph;
    GlBackend backend;
    /// Graph of prepareLights(). It is separate, because `graph` belongs to the last frame.
    FrameGraph lightGraph;
    GlBackend lightBackend;
    DrawTechniques techniques;
    /// States of the techniques in the order of `techniques`, then `outputView`, then `composition`.
    std::pmr::vector<std::unique_ptr<TechniqueView>> parts;
    const MediaComposition* composing; ///< composition of the last frame
    CompositionView* composition =
        nullptr; ///< the composition in `parts`; null: there is no state of a composition
    OutputView* outputView = nullptr; ///< the outputs in `parts`; null: no outputs are requested
    FrameHistory history;             ///< used only with outputs
    LevelOfDetail lod;
    ViewLights lights;
    std::pmr::vector<MediumCaster> casters;
    std::array<EffectLight, kMaxEffectLights> glows; ///< lights of the effects, brightest first
    size_t glowCount = 0;
    DrawBatcher batcher;
    std::pmr::vector<DrawStream> streams;
    std::span<const DrawBatch> mediaBatches;
    std::pmr::vector<const MediaSource*> solids;
    SnapshotRevisions revisions;
    /// Key of the gathered lists and of the data on the GPU; without a value, the lists and data are invalid.
    std::optional<FrameKey> key;
    bool keptLists = false; ///< true: this frame has reused the lists
    StereoFrame stereo;
    std::optional<PreparedFrame> prepared;
    bool isOpen = false;    ///< true: further ranges of the last frame may follow, with its lists
    bool hasLights = false; ///< true: `lights` are valid for the last frame
    bool completes = true;  ///< see setCompletes()
    std::pmr::vector<std::string_view> passNames; ///< passes that the last frame executed
    const base::AssetTable* assets = nullptr;
    FragmentCounts fragments{}; ///< estimated number of fragments of this frame
    LayerScaleControl layerScale;
    HostTargetCheck targetCheck;
    HostTargetFacts targetFacts; ///< of the targets of this frame
    HostCopies copies;
    GlPassTimer timer;
    GlPassTimer lightTimer; ///< timer of prepareLights()
    /// [ms] Time to fill light slices in the last timed frame that filled them.
    double fillMilliseconds = 0.0;
    TimingClock clock = TimingClock::Off;
    uint64_t tag = 0;
    /// Result of TechniqueView::canComputeParticles() after the last drawing or compiling.
    bool computesParticles = true;
    uint32_t idleFrames = 0; ///< number of consecutive frames without visible data
    ViewGraphOutputs outputs;
};

} // namespace fx::render
