/// @file quality_stage.h
/// Frames for measurements of quality: effects on a stage, drawn off screen repeatedly with any settings.
///
/// Threads: only the thread that created the object, which is its GL thread.
#pragma once

#include "benchmarks/scenes/picture_window.h"
#include "foundation/result/status.h"
#include "fxsdk/api/view_object.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "rendering/stage/stage_renderer.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {

/// Clock of frame times.
enum class StageClock
{
    Gpu,      ///< timestamps of the GPU
    Wall,     ///< wall time from the call until the GPU has finished
    Processor ///< processor time of all threads of this program: for software renderers on busy machines
};
const char* clockName(StageClock clock);

class QualityStage
{
public:
    /// Creates a stage with the effects of a scene file.
    /// @param file must outlive the stage
    static base::Result<std::unique_ptr<QualityStage>> create(const scene_file::SceneFile& file, int width,
                                                              int height);
    ~QualityStage();
    QualityStage(const QualityStage&) = delete;
    QualityStage& operator=(const QualityStage&) = delete;

    /// The best clock: GPU timestamps for hardware, processor time for software renderers.
    StageClock bestClock() const;
    /// Sets the budget from the next frame on. @param budget [ms] 0: none
    base::Status setBudget(double budget, StageClock clock);

    /// Simulates up to `tick`. `tick` must not decrease from call to call.
    base::Status simulate(base::Ticks tick) { return effects_->showMoment(tick); }
    /// Draws the stage as the camera sees it. Frames are drawn over this picture until the next call.
    /// @param window the part that the stage shows, of its size; empty: all of the camera's picture
    base::Status look(const scene_file::CameraPath& camera, const std::optional<PictureWindow>& window = {});
    /// Draws one frame and waits for the GPU.
    base::Status draw();

    /// Times of the frame of the last draw().
    render::GroupTimes times() const { return times_; }
    /// [ms] Time from the call of draw() until the GPU had finished, with or without a clock.
    double wallMilliseconds() const { return wallMilliseconds_; }
    double processorMilliseconds() const { return processorMilliseconds_; }
    std::vector<float> picture();    ///< RGBA of the frame
    std::vector<float> background(); ///< RGBA of the stage without effects
    FxView& view() { return *view_; }
    const std::string& rendererName() const { return device_->limits().renderer; }

private:
    QualityStage(const scene_file::SceneFile& file, int width, int height)
        : file_(file), width_(width), height_(height)
    {}
    base::Status start();
    base::Status makeView();

    const scene_file::SceneFile& file_;
    int width_, height_; ///< [pixel]
    std::unique_ptr<render::GlContext> glContext_;
    std::unique_ptr<render::GlDevice> device_;
    std::unique_ptr<render::StageRenderer> stage_;
    render::GlTexture color_;
    std::unique_ptr<EffectScene> effects_;
    FxView* view_ = nullptr;
    render::CameraView camera_;
    render::GroupTimes times_;
    double wallMilliseconds_ = 0.0, processorMilliseconds_ = 0.0;
};

/// Difference of two pictures of media over the same background.
struct PictureDifference
{
    double difference = 0; ///< sum of the absolute differences between the values of a and b, without alpha
    /// sum of the absolute differences between the values of b and the background, without alpha
    double light = 0;
};
PictureDifference compare(const std::vector<float>& a, const std::vector<float>& b,
                          const std::vector<float>& background);

/// Parses "320x180", each 16 to 16384. @return InvalidArgument
base::Status readSize(const std::string& text, int& outWidth, int& outHeight);

/// Parses "gpu", "wall", "processor", or "auto" (gives nothing). @return InvalidArgument
base::Status readClock(const std::string& text, std::optional<StageClock>& outClock);

} // namespace fx::cli
