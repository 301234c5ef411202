/// @file draw_technique.h
/// The drawing half of a technique: its snapshot data, passes, programs and statistics. A view iterates over
/// a list of these descriptions.
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
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/light_bindings.h"
#include "rendering/passes/media_source.h"
#include "rendering/passes/output_marks.h"
#include "rendering/techniques/quality_knob.h"

#include <memory>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace fx::render {

class GlBackend;
struct RowTechnique;
struct DrawTechnique;

constexpr uint32_t kIdleFrames = 300; ///< without use, until buffers and textures are given back

/// Inputs of gathering a frame.
struct GatherInputs
{
    const base::SnapshotPair* snapshots; ///< without the older one if the two are equal
    RevisionPair revisions;
    SnapshotRowRevisions newerRows, olderRows;
    const FrameRequest* request;
    const ViewSettings* settings;
    const CameraGeometry* camera;
    const base::AssetTable* assets;
    std::span<const EffectLight> lights; ///< the brightest of all effects, brightest first
    LevelOfDetail* lod;                  ///< begun for this frame
    uint64_t content;                    ///< revision of the shown content
    bool castsShadows = true;            ///< lights exist and media cast shadows
    bool needsOrder = true;              ///< balls are drawn one over the other, farthest first
};

/// Data gathered by techniques so far, in the order of their list.
struct GatheredFrame
{
    std::pmr::vector<DrawStream>* streams;             ///< streams of the media pass, each with its source
    std::pmr::vector<MediumCaster>* casters = nullptr; ///< all media that cast shadows, relative to the eye
    FragmentCounts fragments{};                        ///< estimated fragments of the media pass
    std::span<const BlobInstance> blobs{};             ///< balls of medium
    /// Ranges of blobs by instance, if blobs are in the order of instances.
    std::span<const BlobEffect> effects{};
    /// Outputs of blobs, if they are in the order of instances; with ViewSettings::outputs.
    std::span<const BlobMark> marks{};
    /// Noise coordinates of blobs, if they are in the order of instances.
    std::span<const BlobMaterial> materials{};
    /// Detail of effects, if blobs are in the order of instances.
    std::span<const GroupDetail> details{};
    bool anyHeat = false; ///< some blobs refract light
};

/// Where in a frame a technique adds its passes. buildViewGraph() has the order of all passes.
enum class PassStage : uint8_t
{
    Pictures, ///< before all other passes: impostors that the frame draws later
    Upload,   ///< the distance to the host's surfaces is known: data are uploaded or computed
    Measure,  ///< after the media
    Refract,  ///< the picture has all media: refraction
    Sensor,   ///< the picture is complete: effects of the eye or the sensor
};

/// One frame while its graph is built: results of its passes so far.
struct PassFrame
{
    const FrameRequest* request;
    const ViewSettings* settings;
    int width, height;             ///< [pixel]
    ViewBlock view;                ///< of the picture
    ViewBlock layerView;           ///< of the media's layers
    int layerWidth, layerHeight;   ///< [texel]
    LightBindings lights = {};     ///< of the view
    bool hasSmallLayers = false;   ///< their texels are larger than pixels
    bool hasMedia = false;         ///< the media pass draws particles, or particles occlude
    ResourceId distance = {};      ///< [m] to the host's surfaces; from Measure on, also to opaque particles
    ResourceId layerDistance = {}; ///< at the layers' size
    ResourceId picture = {};       ///< from Refract on
    ResourceId blobs = {};         ///< buffer of GatheredFrame::blobs, from Upload on
    bool anyPass = false;          ///< set by a technique whose passes are needed even without media
};

/// State of a technique in one view: lists and GPU memory. A frame calls begin(), then gather() or keep(),
/// then addPasses() for each stage, fence(), and endFrame(); or rest() alone.
class TechniqueView
{
public:
    virtual ~TechniqueView() = default;

    /// Creates resources in advance, so that no frame waits for them.
    virtual base::Status prepare() { return {}; }

    /// Begins a frame; creates resources that are independent of the visible data.
    virtual base::Status begin(const ViewSettings&) { return {}; }
    virtual base::Status gather(const GatherInputs&, GatheredFrame&) { return {}; }
    /// Instead of gather(): the frame reuses the data of the last one.
    virtual void keep() {}
    /// True when an equal frame after this one would give the same picture.
    virtual bool isSettled() const { return true; }

    /// Source of opaque elements; null: none.
    virtual const MediaSource* solids() const { return nullptr; }
    /// Whether it adds passes that change the picture after the media.
    virtual bool altersPicture(const PassFrame&) const { return false; }
    virtual void addPasses(PassStage, FrameGraph&, PassFrame&) {}

    virtual void fence() {} ///< called when all draws of the frame have been issued
    /// Invalidates data of this frame, because gathering or drawing has failed.
    virtual void forget() {}
    virtual void endFrame(bool /*succeeded*/) {}
    /// Called instead of a frame without visible data.
    virtual void rest() {}

    /// Adds counts of the last frame.
    virtual void count(FrameStatistics&) const {}
    /// Adds counters of the GPU; waits for the GPU.
    virtual void readBack(const GlBackend&, FrameStatistics&) {}
    /// Adds the share of the picture that the last frame has covered.
    virtual void cover(const CameraGeometry&, ScreenShare&) const {}
    virtual uint64_t bytes() const { return 0; } ///< [byte] held on the GPU

    /// Whether groups of the kind "gpuParticle" are drawn. False once the context has refused one.
    virtual bool canComputeParticles() const { return true; }
    /// Compiles the compute program of an emitter, if supported.
    virtual void warmUp(const base::GpuParticleProgram&) {}
};

/// Inputs of creating the state of a view.
struct TechniqueSetup
{
    GlDevice* device;
    const base::SnapshotSchema* schema;
    std::pmr::memory_resource* memory;
    std::span<const DrawTechnique* const> techniques; ///< all of the view
};

/// The published data of an effect on which techniques depend.
struct EffectContent
{
    std::span<const base::KindDesc* const> kinds; ///< of its groups
    bool isDrawn = false;                         ///< a technique draws one of the kinds
    bool bendsLight = false;                      ///< some of its media refract light
};

/// One technique. Has static storage.
struct DrawTechnique
{
    std::string_view name;
    const base::KindDesc* kind = nullptr; ///< kind of its snapshot data; null: none of its own
    /// How groups of the kind become rows of particles, for techniques that are drawn so.
    const RowTechnique* rows = nullptr;
    /// Creates the state of a view; null: none. Techniques with the same function share one state.
    std::unique_ptr<TechniqueView> (*create)(const TechniqueSetup& setup) = nullptr;
    std::span<const ProgramDesc* const> (*programs)() = nullptr; ///< all programs it may use; null: none
    /// Passes that a frame has because of it, with their timer groups. Techniques that are drawn by the media
    /// pass include that pass.
    std::span<const TimedPass> passes = {};
    /// Whether an effect with such content uses it; null: an effect that publishes `kind`.
    bool (*isUsedBy)(const EffectContent& content) = nullptr;
    /// how groups of `kind` light everything around them; null: not at all
    const LightSource* lights = nullptr;
    /// Refuses settings that cannot be drawn; null: accepts all.
    base::Status (*check)(const ViewSettings& settings) = nullptr;
    /// Whether it changes the picture without visible effects; null: no.
    bool (*actsAlone)(const ViewSettings& settings) = nullptr;
    const ScalabilitySettings* levels = nullptr; ///< its scalability levels; null: none
};

} // namespace fx::render
