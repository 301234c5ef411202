/// @file view_renderer.h
/// Draws snapshots into a host's image. Each view has one ViewRenderer, which owns the view's targets and the
/// data from earlier frames.
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

class GlDevice; ///< see rendering/gl/gl_device.h

/// GL names of textures that stay valid until the next render() of the view; 0 if a texture was not
/// requested.
struct LayerTextures
{
    /// RGBA32F premultiplied radiance of the fire layer that reaches the eye; A: visible opacity of the layer
    uint32_t fire = 0;
    uint32_t smoke = 0;        ///< the same as `fire`, for the layer smoke
    uint32_t dust = 0;         ///< the same as `fire`, for the layer dust
    uint32_t depth = 0;        ///< R32F [m] transmittance-weighted distance of the media; +inf without media
    uint32_t opticalDepth = 0; ///< R32F [1] optical depth of the media
    uint32_t media = 0;        ///< RGBA32F sum of the layers
};

class ViewRenderer
{
public:
    /// @param techniques list of techniques, which must outlive the view
    ViewRenderer(GlDevice* device, const base::SnapshotSchema* schema, std::pmr::memory_resource* memory,
                 DrawTechniques techniques = drawTechniques());
    ~ViewRenderer();
    ViewRenderer(ViewRenderer&&) noexcept;
    ViewRenderer& operator=(ViewRenderer&&) noexcept;

    DrawTechniques techniques() const;

    ViewSettings& settings() { return settings_; }
    const ViewSettings& settings() const { return settings_; }

    /// Compiles all programs that render() may use. After this call, no frame compiles programs.
    base::Status warmUp();

    /// Draws `snapshots` over the host's picture. On failure the picture and the GL state do not change.
    base::Status render(const base::SnapshotPair& snapshots, const FrameRequest& request);

    /// Draws two eyes, as render() draws each of them. Data that do not depend on the camera are gathered,
    /// uploaded and computed once: level of detail, lights and glare follow the first eye. If it fails, the
    /// picture of the first eye may have changed.
    /// @param second times, moment and history are those of `first`
    base::Status renderStereo(const base::SnapshotPair& snapshots, const FrameRequest& first,
                              const FrameRequest& second);

    /// Gathers a frame and fills its light slices. The host can then draw surfaces with media shadows before
    /// it calls render(). render() reuses the result if its request differs only in targets and times.
    /// `snapshots` must stay valid until the next call of render() or prepareLights(). The request needs no
    /// targets. On failure the GL state does not change.
    base::Status prepareLights(const base::SnapshotPair& snapshots, const FrameRequest& request);

    /// Media shadow in a light of the last prepared or drawn frame. If media cast no shadow in this light,
    /// the transmittance is 1.
    /// @param origin [m] world position to which sampled positions are relative
    MediaShadowBlock mediaShadow(LightKind kind, uint32_t index, const glm::dvec3& origin) const;
    /// GL name of the light slices for mediaShadow(), with linear filter; 0 without light slices. Valid until
    /// the next frame.
    uint32_t mediaShadowTexture() const;
    /// Lights of the effects of the last prepared or drawn frame, brightest first.
    std::span<const EffectLight> effectLights() const;
    /// All lights of the last prepared or drawn frame; empty without media.
    const LightList& lights() const;

    /// Sets the clock by which the next frames are timed. The default Off has no cost. With Gpu, frames are
    /// not timed if GL has no timer queries.
    /// @param tag number that takeTimes() returns with the times of a frame
    void setTiming(TimingClock clock, uint64_t tag);
    bool hasGpuClock();
    void setHostClock(HostClock clock);   ///< clock for TimingClock::Host
    bool takeTimes(GroupTimes& out);      ///< see GlPassTimer::take
    const PassGroups& passGroups() const; ///< groups to which takeTimes() refers
    /// [ms] Time to fill light slices in the last timed frame that filled them; 0 if there is no such frame.
    double fillMilliseconds() const;
    /// Fractions of the last frame's picture that the techniques cover; valid only if frames are timed.
    const ScreenShare& covered() const { return covered_; }
    /// Sets the images and meshes of particles. `assets` must stay valid until the next call or the end of
    /// the view. Null: particles have neither textures nor meshes.
    void setAssets(const base::AssetTable* assets);

    /// True if groups of the kind "gpuParticle" can be drawn. False if computing particles has failed in this
    /// context.
    bool canComputeParticles() const;
    /// Compiles the compute program of an emitter, if supported.
    void warmUp(const base::GpuParticleProgram& emitter);

    /// With false, shimmer, glare and tone mapping are left to another renderer, which draws over the picture
    /// of this one. The default is true.
    void setCompletes(bool completes);

    /// True if the last frame did not change the picture and there is no memory to release. Then render()
    /// does nothing until there is visible data again.
    bool isAsleep() const { return asleep_; }
    /// Checks a request with the same checks as render(). While the view is asleep, render() only calls this
    /// function.
    static base::Status check(const FrameRequest& request);

    const FrameStatistics& statistics() const { return statistics_; }
    LayerTextures layers() const;
    /// GL name of the texture for bit number `number` of view_output; 0 if it was not requested or nothing is
    /// visible. The name is valid as long as the textures of layers().
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
