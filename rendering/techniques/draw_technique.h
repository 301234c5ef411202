/// @file draw_technique.h
/// The drawing half of a technique: its snapshot data, passes, programs and statistics. A view iterates over
/// a list of descriptions of techniques.
///
/// Threads: [GL thread].
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/result/status.h"
#include "foundation/snapshot/gpu_particles.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/draw_order/draw_batcher.h"
#include "rendering/field_detail/blob_detail.h"
#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/snapshot_revisions.h"
#include "rendering/frame/view_block.h"
#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/pass_groups.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/medium_caster.h"
#include "rendering/lod/level_of_detail.h"
#include "rendering/media/late_balls.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/light_bindings.h"
#include "rendering/passes/media_source.h"
#include "rendering/passes/output_marks.h"
#include "rendering/techniques/quality_knob.h"
#include "rendering/volumes/volume_place.h"

#include <memory>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace fx::render {

class GlBackend;
struct RowTechnique;
struct DrawTechnique;

/// Number of frames without use after which buffers and textures are deleted.
constexpr uint32_t kIdleFrames = 300;

/// Inputs of TechniqueView::gather().
struct GatherInputs
{
    /// Snapshots of the frame; `older` is null if both have equal content.
    const base::SnapshotPair* snapshots;
    RevisionPair revisions;
    SnapshotRowRevisions newerRows, olderRows;
    const FrameRequest* request;
    const ViewSettings* settings;
    const CameraGeometry* camera;
    const base::AssetTable* assets;
    std::span<const EffectLight> lights; ///< the brightest lights of all effects, brightest first
    LevelOfDetail* lod;                  ///< level of detail, whose begin() has been called for this frame
    uint64_t content;                    ///< revision of the content of the snapshots
    bool castsShadows = true;            ///< true: there are lights, and media cast shadows
    /// True: balls must be sorted, farthest first, because they are blended over each other.
    bool needsOrder = true;
    bool drawsTiles = false; ///< true: balls may have tiles, see BallList::tiles
    /// Camera of the second eye, for which gatherOtherEye() will be called; null: a frame of one eye.
    const CameraGeometry* otherEye = nullptr;
};

/// Data that techniques have gathered for a frame. The view calls gather() of its techniques in the order of
/// the list of techniques.
struct GatheredFrame
{
    std::pmr::vector<DrawStream>* streams;             ///< streams of the media pass, each with its source
    std::pmr::vector<MediumCaster>* casters = nullptr; ///< all media that cast shadows, relative to the eye
    FragmentCounts fragments{};                        ///< estimated number of fragments of the media pass
    std::span<const BlobInstance> blobs{};             ///< balls of medium
    /// Ranges of blobs by instance; empty if blobs are not in the order of instances.
    std::span<const BlobEffect> effects{};
    /// Velocities and instances of blobs for view outputs; empty if blobs are not in the order of instances,
    /// or without ViewSettings::outputs.
    std::span<const BlobMark> marks{};
    /// Noise coordinates of blobs; empty if blobs are not in the order of instances.
    std::span<const BlobMaterial> materials{};
    /// Detail of effects; empty if blobs are not in the order of instances.
    std::span<const GroupDetail> details{};
    /// Volumes of effects; empty if blobs are not in the order of instances.
    std::span<const GroupVolume> volumes{};
    bool anyHeat = false;              ///< true: a blob causes heat shimmer
    std::span<const LateBalls> late{}; ///< balls of late groups, for the technique that draws balls
};

/// Stages of a frame in which techniques add passes. buildViewGraph() defines the order of all passes.
enum class PassStage : uint8_t
{
    Pictures, ///< stage before all other passes, in which impostors are rendered
    /// Stage in which data are uploaded or computed; the distance to the host's surfaces is available.
    Upload,
    Measure, ///< stage after the media have been drawn, in which measurements are made
    Refract, ///< stage of refraction; the picture has all media
    Sensor,  ///< stage of effects of the eye or the sensor; the picture is complete
};

/// State of a frame while its graph is built, with the results of its passes so far.
struct PassFrame
{
    const FrameRequest* request;
    const ViewSettings* settings;
    int width, height;   ///< [pixel]
    ViewBlock view;      ///< view block for passes with the size of the picture; of all depths
    ViewBlock layerView; ///< view block for passes with the size of layers; of the range of the request
    int layerWidth, layerHeight; ///< [texel]
    LightBindings lights = {};   ///< lights of the view
    bool hasSmallLayers = false; ///< true: layers are smaller than the picture
    bool hasMedia = false;       ///< true: there are media, transparent particles or opaque particles
    /// [m] distance to the host's surfaces; in the stage Measure and later stages, also to opaque particles
    ResourceId distance = {};
    ResourceId layerDistance = {}; ///< [m] `distance` in the size of layers
    ResourceId picture = {};       ///< the picture; valid in the stage Refract and later stages
    BlockTileBindings tiles{};     ///< tiles of balls; valid in the stage Upload and later stages
    ResourceId blobs = {}; ///< buffer of GatheredFrame::blobs; valid in the stage Upload and later stages
    bool anyPass = false;  ///< true: the technique's passes are needed even if there are no media

    /// True: light on media must be computed even if the lists are kept, because the host's shadow map may
    /// have changed.
    bool mayShadowChange() const { return lights.hostShadow.valid() && !request->range.isContinued; }
};

/// State of a technique in one view: lists and GPU memory. A frame with visible data calls begin(), then
/// gather() or keep(), then addPasses() for each stage, then fence() and endFrame(). A frame of several depth
/// ranges calls keep(), addPasses() and fence() again for each further range, and endFrame() after the last
/// one. A frame without visible data calls only rest().
class TechniqueView
{
public:
    virtual ~TechniqueView() = default;

    /// Creates resources in advance, so that no frame waits for them.
    virtual base::Status prepare() { return {}; }

    /// Begins a frame, and creates resources that are independent of the visible data.
    virtual base::Status begin(const ViewSettings&) { return {}; }
    /// Gathers the visible data of a frame, and adds its streams and shadow casters to the GatheredFrame.
    virtual base::Status gather(const GatherInputs&, GatheredFrame&) { return {}; }
    /// Gathers the data of the second eye of a stereo frame. Inputs differ from those of gather() only in
    /// camera and targets, so that a technique can reuse what does not depend on the camera.
    virtual base::Status gatherOtherEye(const GatherInputs& in, GatheredFrame& io) { return gather(in, io); }
    /// The view calls this function instead of gather() if the frame reuses the data of the last frame.
    virtual void keep() {}
    /// True if a frame with the same inputs would give the same picture as the last frame.
    virtual bool isSettled() const { return true; }

    /// Source of the technique's opaque elements; null if there are no opaque elements.
    virtual const MediaSource* solids() const { return nullptr; }
    /// True if the technique adds passes that change the picture after the media have been drawn.
    virtual bool altersPicture(const PassFrame&) const { return false; }
    virtual void addPasses(PassStage, FrameGraph&, PassFrame&) {}

    virtual void fence() {} ///< The view calls this function after all draws of the frame have been issued.
    /// Invalidates the data of this frame. The view calls this function if gathering or drawing has failed.
    virtual void forget() {}
    virtual void endFrame(bool /*succeeded*/) {}
    /// The view calls only this function if a frame has no visible data.
    virtual void rest() {}

    /// Adds the counts of the last frame to the statistics.
    virtual void count(FrameStatistics&) const {}
    /// Adds counters that are read back from the GPU to the statistics. The function waits for the GPU.
    virtual void readBack(const GlBackend&, FrameStatistics&) {}
    /// Adds the fraction of the picture that the technique has covered in the last frame.
    virtual void cover(const CameraGeometry&, ScreenShare&) const {}
    virtual uint64_t bytes() const { return 0; } ///< [byte] size of the technique's GPU memory

    /// True if groups of the kind "gpuParticle" can be drawn. False if computing particles has failed in this
    /// context.
    virtual bool canComputeParticles() const { return true; }
    /// Compiles the compute program of an emitter, if the technique computes particles on the GPU.
    virtual void warmUp(const base::GpuParticleProgram&) {}
};

/// Inputs to create the state of a technique in a view.
struct TechniqueSetup
{
    GlDevice* device;
    const base::SnapshotSchema* schema;
    std::pmr::memory_resource* memory;
    std::span<const DrawTechnique* const> techniques; ///< all techniques of the view
};

/// The kinds of data that an effect publishes. A technique decides from these kinds whether the effect uses
/// the technique.
struct EffectContent
{
    std::span<const base::KindDesc* const> kinds; ///< kinds of the effect's groups
    bool isDrawn = false;                         ///< true: a technique draws one of the kinds
    bool bendsLight = false;                      ///< true: media of the effect cause heat shimmer
};

/// Description of one technique. Objects of this type have static storage.
struct DrawTechnique
{
    std::string_view name;
    /// Kind of the technique's snapshot data; null: the technique has no kind of snapshot data.
    const base::KindDesc* kind = nullptr;
    /// Conversion of groups of the kind to rows of particles; null for techniques that draw no rows.
    const RowTechnique* rows = nullptr;
    /// Creates the technique's state in a view; null: the technique has no state. Techniques with the same
    /// function share one state.
    std::unique_ptr<TechniqueView> (*create)(const TechniqueSetup& setup) = nullptr;
    /// Returns all programs that the technique may use; null: the technique has no programs.
    std::span<const ProgramDesc* const> (*programs)() = nullptr;
    /// The passes that the technique adds to a frame, with their timer groups. The list includes the media
    /// pass if this pass draws the technique's elements.
    std::span<const TimedPass> passes = {};
    /// Returns true if an effect with this content uses the technique; null: an effect uses the technique if
    /// the effect publishes `kind`.
    bool (*isUsedBy)(const EffectContent& content) = nullptr;
    /// Describes how groups of `kind` emit light; null: the groups emit no light.
    const LightSource* lights = nullptr;
    /// Returns an error if settings cannot be drawn; null: all settings are accepted.
    base::Status (*check)(const ViewSettings& settings) = nullptr;
    /// Returns true if the technique changes the picture when no effect is visible; null: the technique does
    /// not.
    bool (*actsAlone)(const ViewSettings& settings) = nullptr;
    const ScalabilitySettings* levels = nullptr; ///< scalability levels of the technique; null: none
};

} // namespace fx::render
