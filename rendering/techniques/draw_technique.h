/// @file draw_technique.h
/// The drawing half of a technique: what it draws of a snapshot, with which passes and programs, and what it
/// counts. A view only has a list of these descriptions.
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

/// What a frame is gathered from.
struct GatherInputs
{
    const base::SnapshotPair* snapshots; ///< without the older one where nothing moves between the two
    RevisionPair revisions;
    SnapshotRowRevisions newerRows, olderRows;
    const FrameRequest* request;
    const ViewSettings* settings;
    const CameraGeometry* camera;
    const base::AssetTable* assets;
    std::span<const EffectLight> lights; ///< the brightest of all effects, brightest first
    LevelOfDetail* lod;                  ///< begun for this frame
    uint64_t content;                    ///< differs where what is shown differs
    bool castsShadows = true;            ///< there are lights, and media cast shadows
    bool needsOrder = true;              ///< balls are drawn one over the other, farthest first
};

/// What techniques have gathered so far, in the order of their list.
struct GatheredFrame
{
    std::pmr::vector<DrawStream>* streams;             ///< what the media pass draws, each with its source
    std::pmr::vector<MediumCaster>* casters = nullptr; ///< all media that cast shadows, relative to the eye
    FragmentCounts fragments{};                        ///< estimated, of what the media pass draws
    std::span<const BlobInstance> blobs{};             ///< balls of medium
    std::span<const BlobEffect> effects{};             ///< of those, if they come in the order of instances
    std::span<const BlobMaterial> materials{};         ///< what those carry for detail, likewise
    std::span<const GroupDetail> details{};            ///< of effects, likewise
    bool anyHeat = false;                              ///< some of those bend light
};

/// Where in a frame a technique adds its passes. buildViewGraph() has the order of all passes.
enum class PassStage : uint8_t
{
    Pictures, ///< before everything: pictures that the frame shows later
    Upload,   ///< the distance to what the host has drawn is known; what is drawn gets to where it is read
    Measure,  ///< behind the media
    Refract,  ///< the picture has all media: it is bent
    Sensor,   ///< the picture is complete: what the eye or a camera makes of it
};

/// One frame while its graph is built: what its passes have made so far.
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
    bool hasMedia = false;         ///< something is drawn by the media pass or hides
    ResourceId distance = {};      ///< [m] to what the host, and from Measure on solid particles, show
    ResourceId layerDistance = {}; ///< at the layers' size
    ResourceId picture = {};       ///< from Refract on
    ResourceId blobs = {};         ///< buffer of GatheredFrame::blobs, from Upload on
    bool anyPass = false;          ///< set by a technique whose passes matter although there are no media
};

/// What one view keeps for a technique: its lists, its memory on the GPU. A frame calls begin(), then
/// gather() or keep(), then addPasses() for each stage, fence(), and endFrame(); or rest() alone.
class TechniqueView
{
public:
    virtual ~TechniqueView() = default;

    /// Makes what no frame should have to wait for.
    virtual base::Status prepare() { return {}; }

    /// Begins a frame; makes what it needs whatever is in view.
    virtual base::Status begin(const ViewSettings&) { return {}; }
    virtual base::Status gather(const GatherInputs&, GatheredFrame&) { return {}; }
    /// Instead of gather(): the frame draws what the last one has drawn.
    virtual void keep() {}
    /// An equal frame after this one would be the same.
    virtual bool isSettled() const { return true; }

    /// The source of what hides what is behind it; null: there is none.
    virtual const MediaSource* solids() const { return nullptr; }
    /// Whether it adds passes that change the picture behind the media.
    virtual bool altersPicture(const PassFrame&) const { return false; }
    virtual void addPasses(PassStage, FrameGraph&, PassFrame&) {}

    virtual void fence() {} ///< all draws of the frame have been issued
    /// What this frame was to write is not there: gathering or drawing has failed.
    virtual void forget() {}
    virtual void endFrame(bool /*succeeded*/) {}
    /// Instead of all of a frame: there is nothing to draw.
    virtual void rest() {}

    /// Adds what the last frame has drawn.
    virtual void count(FrameStatistics&) const {}
    /// Adds counters of the GPU; waits for it.
    virtual void readBack(const GlBackend&, FrameStatistics&) {}
    /// Adds the share of the picture that the last frame has covered.
    virtual void cover(const CameraGeometry&, ScreenShare&) const {}
    virtual uint64_t bytes() const { return 0; } ///< [byte] held on the GPU

    /// Whether groups of the kind "gpuParticle" are drawn. False once the context has refused one.
    virtual bool canComputeParticles() const { return true; }
    /// Compiles what computes the particles of an emitter, where that is possible.
    virtual void warmUp(const base::GpuParticleProgram&) {}
};

/// What a view is made from.
struct TechniqueSetup
{
    GlDevice* device;
    const base::SnapshotSchema* schema;
    std::pmr::memory_resource* memory;
    std::span<const DrawTechnique* const> techniques; ///< all of the view
};

/// What an effect publishes, as far as techniques depend on it.
struct EffectContent
{
    std::span<const base::KindDesc* const> kinds; ///< of its groups
    bool isDrawn = false;                         ///< a technique draws one of the kinds
    bool bendsLight = false;                      ///< some of it is hot enough
};

/// One technique. Has static storage.
struct DrawTechnique
{
    std::string_view name;
    const base::KindDesc* kind = nullptr; ///< of the snapshot data that it draws; null: none of its own
    /// How groups of the kind become rows of particles, for techniques that are drawn so.
    const RowTechnique* rows = nullptr;
    /// Makes what a view keeps; null: nothing. Techniques with the same function share what it makes.
    std::unique_ptr<TechniqueView> (*create)(const TechniqueSetup& setup) = nullptr;
    std::span<const ProgramDesc* const> (*programs)() = nullptr; ///< all that it can need; null: none
    /// Passes of a frame that exist because of it, each with the group that its time is added to. Techniques
    /// that are drawn by the media pass name that pass as well.
    std::span<const TimedPass> passes = {};
    /// Whether an effect with such content uses it; null: an effect that publishes `kind`.
    bool (*isUsedBy)(const EffectContent& content) = nullptr;
    const LightSource* lights =
        nullptr; ///< how groups of `kind` light everything around them; null: not at all
    /// Refuses settings that cannot be drawn; null: there are none.
    base::Status (*check)(const ViewSettings& settings) = nullptr;
    /// Whether it changes the picture when there is nothing to see; null: no.
    bool (*actsAlone)(const ViewSettings& settings) = nullptr;
    const ScalabilitySettings* levels = nullptr; ///< what quality may lower of it; null: nothing
};

} // namespace fx::render
