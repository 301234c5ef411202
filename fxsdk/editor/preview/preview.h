/// @file preview.h
/// Shows a preset or scene at a moment, as a game does: through the C API, over an opaque stage.
///
/// Threads: only the thread that created the object, which is its GL thread.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/scene/instance_director.h"
#include "fxsdk/cli/scene/lit_stage.h"
#include "fxsdk/editor/document/schema_tree.h"
#include "fxsdk/editor/session/budget_report.h"
#include "fxsdk/editor/session/motion_choice.h"
#include "fxsdk/editor/session/overlays.h"
#include "fxsdk/fxsdk.hpp"
#include "fxsdk/scene_file/scene_file.h"
#include "rendering/gl/gl_device.h"
#include "rendering/stage/stage_camera.h"
#include "rendering/stage/stage_renderer.h"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fx::editor {

/// How effects are drawn, as by fx render --quality.
enum class PreviewQuality : uint8_t
{
    Low,    ///< homogeneous balls, no detail, no shimmer
    Medium, ///< homogeneous balls, no detail
    High    ///< as the document states
};

/// Camera and size of a picture.
struct PreviewFrame
{
    render::CameraPose pose;
    float fovYDegrees = 50.0f;          ///< [degree]
    int width = 640;                    ///< [pixel]
    int height = 360;                   ///< [pixel]
    std::optional<float> exposureEv100; ///< [EV100] empty: that of the scene
    /// True: scene-linear and exposed, with light that is scattered once, and without glare and shimmer: as
    /// the reference renderer computes it.
    bool isLinear = false;
    PreviewQuality quality = PreviewQuality::High;
};

class Preview
{
public:
    /// @param loader functions of the current OpenGL context
    static base::Result<std::unique_ptr<Preview>> create(const render::GlLoader& loader);
    ~Preview();
    Preview(const Preview&) = delete;
    Preview& operator=(const Preview&) = delete;

    /// Shows another text at the present time. On failure the picture stays as it was.
    /// @param name file of the text, for messages and to find the files that it names
    base::Status show(const std::string& text, const std::string& name, DocumentKind kind);
    /// Goes to a time [s]. Before its start an instance is not shown. Where
    /// instances move, are triggered or changed, this takes the steps from the last moment on, or from the
    /// beginning if the time is earlier.
    base::Status seek(double seconds);
    /// Whether a text has been shown; before, there is nothing to seek and to draw.
    bool hasScene() const { return !isFirst_; }
    /// Draws stage and effects. @return an error of GL
    base::Status render(const PreviewFrame& frame);

    /// Draws some frames of the present moment and steps beyond it, and takes the time. The next picture
    /// needs a seek().
    /// @param outRange receives the half of the range [ms] of the sum of simulation, lights and effects; may
    /// be null
    base::Status measure(const PreviewFrame& frame, StageTimes& outTimes, double* outRange = nullptr);
    /// Time [ms] of a step of 1/60 s. The next picture needs a seek().
    /// @param outRange receives the half of the range of the steps [ms]; may be null
    base::Status measureStep(double& outMilliseconds, double* outRange = nullptr);
    /// Motion of the instances from the next show() on. What is played is exact too: it is played from the
    /// beginning wherever the time goes back.
    void setMotion(const MotionChoice& motion) { motion_ = motion; }
    /// Quality of the simulation from the next show() on. @param quality FxQuality
    void setSimulationQuality(uint32_t quality) { simulationQuality_ = quality; }

    /// What overlays show of the last picture.
    OverlayData overlays(const OverlayChoice& choice, const PreviewFrame& frame);
    /// From the coordinates of a preset to the world; that of the first instance at the time of seek().
    EffectPlacement placement() const;

    /// GL name of the picture, display-referred RGBA32F, lower row first; 0 before the first picture.
    uint32_t texture() const { return stage_ ? stage_->colorTexture() : 0; }
    /// The scene of the picture, whose instances have the motion that is shown.
    const scene_file::SceneFile& scene() const { return file_; }
    /// Whether the preset states its camera; otherwise scene().camera shows the effect at several moments.
    bool hasCamera() const { return hasCamera_; }
    /// What the C API says of each instance and a camera: its cause to be seen or not, and the remedy.
    std::vector<std::string> causes(const PreviewFrame& frame);
    /// Particles alive of all instances.
    uint32_t particles();
    /// Elements that are shown, by the pointers of a preset such as "/emitters/0"; empty for a scene.
    std::map<std::string, uint32_t> elementCounts() const;
    FxViewStatistics statistics() { return view_->statistics(); }
    render::GlDevice& device() { return *device_; }
    /// The same, for what outlives the preview.
    std::shared_ptr<render::GlDevice> sharedDevice() const { return device_; }

private:
    /// An instance of the file, and the one of the scene that shows it.
    struct Shown
    {
        std::optional<FxInstanceId> id;
        double at = -1.0; ///< [s] since its start; unused where instances are played
    };

    Preview() = default;
    base::Status start(const render::GlLoader& loader);
    base::Result<scene_file::SceneFile> readScene(const std::string& text, const std::string& name,
                                                  DocumentKind kind, bool& outHasCamera) const;
    base::Status setStage(const scene_file::SceneFile& file);
    base::Result<std::vector<FxPresetId>> loadPresets(const std::vector<scene_file::ScenePreset>& presets);
    void unload(const std::vector<FxPresetId>& presets);
    void place(size_t index, double seconds);
    void create(size_t index);
    std::unique_ptr<fxsdk::Scene> newScene() const;
    base::Status seekPlayed(double seconds);
    void restart();
    base::Status step();
    static render::CameraView cameraOf(const PreviewFrame& frame);
    static FxFrameDef frameOf(const render::CameraView& camera, const PreviewFrame& frame);
    base::Status renderStages(const PreviewFrame& frame, StageTimes* outTimes);
    base::Status lightStage(const FxFrameDef& frame);
    static std::span<const render::SceneLight> shownLights(const scene_file::SceneFile& file);
    FxViewSettings settingsOf(const PreviewFrame& frame) const;
    static const void* openAsset(void* user, const char* name, size_t* outSize);
    static void closeAsset(void* user, const void* data, size_t size);

    std::shared_ptr<render::GlDevice> device_;
    std::unique_ptr<render::StageRenderer> stage_;
    cli::LitStage lit_;
    std::unique_ptr<fxsdk::Context> context_;
    std::unique_ptr<fxsdk::Scene> fxScene_;
    std::unique_ptr<fxsdk::View> view_;
    scene_file::SceneFile file_;
    std::string stageKey_;              ///< the part of the text by which stage and camera were made
    std::string assetText_;             ///< the preset that the context is about to read
    std::string assetFolder_;           ///< folder of its files
    std::vector<std::string> elements_; ///< pointers of a preset's elements in the order of its solvers
    uint32_t simulationQuality_ = FX_QUALITY_DEFAULT;
    std::vector<FxPresetId> presets_;
    std::vector<Shown> shown_;
    std::vector<double> prewarms_; ///< [s] of the presets
    MotionChoice motion_;
    /// While instances are played in order; otherwise each one is sought on its own.
    std::unique_ptr<cli::InstanceDirector> director_;
    int64_t step_ = 0; ///< steps that the director has played
    double time_ = 0.0;
    bool hasCamera_ = false;
    bool isFirst_ = true;
};

} // namespace fx::editor
