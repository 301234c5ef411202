/// @file view_renderer.h
/// Draws snapshots into a host's image. One object a view: it owns the targets and the history of that view.
///
/// Threads: [GL thread], the thread on which the GL context is current.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/result/status.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "rendering/frame/fragment_counts.h"
#include "rendering/frame/view_types.h"
#include "rendering/gl/gl_pass_timer.h"
#include "rendering/lights/effect_lights.h"
#include "rendering/lights/slices/media_shadow.h"
#include "rendering/techniques/draw_techniques.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace fx::render {

class GlDevice; ///< rendering/gl: function table, programs, counters of one GL context

/// Textures that stay valid until the next render() of the view; 0 when not requested.
struct LayerTextures
{
    /// RGBA32F radiance that reaches the eye from the fire layer, premultiplied; A its visible share
    uint32_t fire = 0;
    uint32_t smoke = 0;        ///< same for smoke
    uint32_t dust = 0;         ///< same for dust
    uint32_t depth = 0;        ///< R32F [m] transmittance-weighted distance of the media; +inf without media
    uint32_t opticalDepth = 0; ///< R32F [1]
    uint32_t media = 0;        ///< RGBA32F sum of the layers
};

class ViewRenderer
{
public:
    /// @param techniques list of techniques; must outlive the view
    ViewRenderer(GlDevice* device, const base::SnapshotSchema* schema, std::pmr::memory_resource* memory,
                 DrawTechniques techniques = drawTechniques());
    ~ViewRenderer();
    ViewRenderer(const ViewRenderer&) = delete;
    ViewRenderer& operator=(const ViewRenderer&) = delete;

    DrawTechniques techniques() const;

    ViewSettings& settings() { return settings_; }
    const ViewSettings& settings() const { return settings_; }

    /// Compiles every program that render() can need. After this no frame compiles.
    base::Status warmUp();

    /// Draws `snapshots` over the host's picture. On failure the picture and the GL state do not change.
    base::Status render(const base::SnapshotPair& snapshots, const FrameRequest& request);

    /// Gathers a frame and fills the planes of its lights, so that the host can draw surfaces with shadows of
    /// media before render(). render() reuses the result if its frame differs only in targets and times.
    /// `snapshots` must be valid until then, or until another call. Targets may be absent. On failure the GL
    /// state does not change.
    base::Status prepareLights(const base::SnapshotPair& snapshots, const FrameRequest& request);

    /// Shadow of media in a light of the frame that was prepared or drawn last; without a shadow all light
    /// passes. @param origin [m] world position that places of lookups are relative to
    MediaShadowBlock mediaShadow(LightKind kind, uint32_t index, const glm::dvec3& origin) const;
    /// Texture of the planes of these shadows, filtered linearly; 0 without planes. Valid until the next
    /// frame.
    uint32_t mediaShadowTexture() const;
    /// Lights of the effects of that frame, brightest first.
    std::span<const EffectLight> effectLights() const;
    /// Lights of the frame that was prepared or rendered last; empty without media.
    const LightList& lights() const;

    /// Sets the clock by which the next frames are timed; Off, the default, has no cost. With Gpu, frames are
    /// not timed when GL has no clock.
    /// @param tag returned with the times of a frame
    void setTiming(TimingClock clock, uint64_t tag);
    bool hasGpuClock();
    void setHostClock(HostClock clock);   ///< of TimingClock::Host
    bool takeTimes(GroupTimes& out);      ///< see GlPassTimer::take
    const PassGroups& passGroups() const; ///< groups of these times
    /// [ms] time in which the last timed frame with filled planes of lights filled them; 0: there is no such
    /// frame.
    double fillMilliseconds() const;
    /// Share of the last frame's pixels that techniques cover; valid only while frames are timed.
    const ScreenShare& covered() const { return covered_; }
    /// Images and meshes that particles name; must outlive the view or the next call. Null: plain particles.
    void setAssets(const base::AssetTable* assets);

    /// Whether groups of the kind "gpuParticle" are drawn. False once the context has refused one.
    bool canComputeParticles() const;
    /// Compiles the compute program of an emitter, if supported.
    void warmUp(const base::GpuParticleProgram& emitter);

    /// True when the last frame did not change the picture and no memory is left to free: without visible
    /// data, further calls of render() do nothing.
    bool isAsleep() const { return asleep_; }
    /// Checks a request as render() does; the only work for a frame while the view is asleep.
    static base::Status check(const FrameRequest& request);

    const FrameStatistics& statistics() const { return statistics_; }
    LayerTextures layers() const;
    /// Texture of the bit `number` of view_output, valid as layers(); 0 when it was not asked for or nothing
    /// is to be seen.
    uint32_t output(size_t number) const;
    /// Names of the passes that the last frame executed, in order.
    std::span<const std::string_view> executedPasses() const;

private:
    struct Impl;
    base::Status checkAll(const FrameRequest& request) const;
    void tellComposition();

    ViewSettings settings_;
    FrameStatistics statistics_;
    ScreenShare covered_;
    bool asleep_ = false;
    std::unique_ptr<Impl> impl_;
};

} // namespace fx::render
