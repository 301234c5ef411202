/// @file frame_renderer.h
/// Renders moments of a scene without a window: first the opaque stage, then the effects over it.
///
/// Threads: only the thread that created the object, which is its GL thread.
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "fxsdk/cli/scene/lit_stage.h"
#include "fxsdk/cli/scene/picture.h"
#include "rendering/gl/gl_device.h"
#include "rendering/platform/gl_context.h"
#include "rendering/stage/stage_renderer.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fx::cli {

struct FrameRendererOptions
{
    int width = 0;  ///< [pixel]
    int height = 0; ///< [pixel]
    render::ViewSettings settings;
    EffectSceneOptions scene;     ///< options of the effects; the renderer itself sets the member `gl`
    bool everyFrameIsCut = false; ///< true: each frame looks like a still of its moment, whatever came before
    double frameSeconds = 0.0; ///< [s] interval over which the output "motion" of the first frame is computed
    /// Compiles the programs of all techniques before the first frame, so that no frame takes time for it.
    /// Otherwise a frame compiles the programs that it needs and that no frame before it needed.
    bool warmsUp = false;
};

/// The pictures of one frame. All but `color` require settings.layerOutputs.
struct FrameLayers
{
    Picture color;                ///< RGBA, display-referred with settings.toneMap, otherwise linear
    Picture background;           ///< RGBA, the stage without effects
    std::array<Picture, 3> media; ///< RGBA of fire, smoke, dust
    Picture depth;                ///< 1 channel [m]
    Picture opticalDepth;         ///< 1 channel
    /// Pictures that settings.outputs requests; a picture that is not requested has no pixels.
    struct Outputs
    {
        Picture instance;     ///< 1 channel: number of the instance in the scene file, from 1; 0: no instance
        Picture motion;       ///< 2 channels [pixel]
        Picture firstDepth;   ///< 1 channel [m]
        Picture meanDepth;    ///< 1 channel [m]
        Picture opticalDepth; ///< 1 channel [1]
    } outputs;
};

/// Counters of the last frame.
struct FrameCounters
{
    FxSceneStatistics scene;
    FxViewStatistics view;
    std::vector<std::string> passes;
    base::VolumeSequence::Counts volumes; ///< of all sequences together
    double millisecondsSimulate = 0;
    double millisecondsRender = 0; ///< [ms] time of drawing stage and effects, until the GPU has finished
};

class FrameRenderer
{
public:
    /// Creates a renderer for a scene file.
    /// @param file must outlive the renderer
    static base::Result<std::unique_ptr<FrameRenderer>> create(const scene_file::SceneFile& file,
                                                               const FrameRendererOptions& options);
    ~FrameRenderer();
    FrameRenderer(const FrameRenderer&) = delete;
    FrameRenderer& operator=(const FrameRenderer&) = delete;

    /// Simulates up to `tick` and draws that moment. `tick` must not decrease from call to call.
    base::Status render(base::Ticks tick);
    /// Copies the frame's pictures from the GPU.
    base::Result<FrameLayers> read();

    const FrameCounters& counters() const { return counters_; }
    EffectScene& effects() { return *effects_; }
    FxView* view() const { return view_; }
    const std::string& rendererName() const { return device_->limits().renderer; }

private:
    explicit FrameRenderer(const scene_file::SceneFile& file) : file_(file) {}
    base::Status start(const FrameRendererOptions& options);
    base::Status keepOnGpu(base::Ticks tick);
    base::Status lookThrough(const render::CameraView& camera);
    base::Status drawStage(const render::CameraView& camera);
    std::span<const render::SceneLight> shownLights() const;
    FxFrameDef frameOf(const render::CameraView& camera, double passed) const;
    /// Draws the effects over the stage.
    /// @param passed [s] time since the previous picture, for the adaptation of glare
    base::Status drawEffects(const render::CameraView& camera, double passed);
    base::Status count();
    Picture readPicture(uint32_t texture, int channels, float whenAbsent = 0.0f);
    Picture readInstances(uint32_t texture);
    base::Status readOutputs(FrameLayers::Outputs& out);

    const scene_file::SceneFile& file_;
    FrameRendererOptions options_;
    std::unique_ptr<render::GlContext> glContext_;
    std::unique_ptr<render::GlDevice> device_;
    std::unique_ptr<render::StageRenderer> stage_;
    LitStage lit_;
    std::unique_ptr<EffectScene> effects_;
    FxView* view_ = nullptr;
    bool staysOnGpu_ = false;   ///< whether particles are computed on the GPU; then no snapshots are read
    base::Ticks lastTick_ = -1; ///< tick of the previous frame; -1 before the first one
    Picture background_;
    FrameCounters counters_;
};

} // namespace fx::cli
