/// @file render_run.h
/// Writes a picture, a sequence, a turntable or a video frame by frame, so that the editor stays alive
/// meanwhile.
///
/// Threads: the GL thread.
#pragma once

#include "fxsdk/cli/support/ffmpeg_pipe.h"
#include "fxsdk/cli/support/output_target.h"
#include "fxsdk/editor/preview/preview.h"
#include "fxsdk/editor/session/orbit_camera.h"
#include "fxsdk/editor/session/render_request.h"

#include <memory>
#include <optional>
#include <string>

namespace fx::editor {

/// What is rendered.
struct RenderSubject
{
    RenderRequest request;
    std::string text; ///< of the document as it is shown
    std::string name; ///< of its file
    DocumentKind kind = DocumentKind::Preset;
    OrbitCamera camera;
    std::optional<float> exposureEv100; ///< [EV100] empty: that of the document
    double time = 0.0;                  ///< [s] of picture and turntable
    double end = 5.0;                   ///< [s] of sequence and video
    MotionChoice motion;
    bool followsCamera = false; ///< sequences and videos look through the camera of the document
};

class RenderRun
{
public:
    /// Begins.
    /// @param loader functions of the current OpenGL context
    /// @return InvalidArgument (a file of another kind), NotFound (ffmpeg), the error of the document
    static base::Result<std::unique_ptr<RenderRun>> create(const render::GlLoader& loader,
                                                           RenderSubject subject);
    RenderRun(const RenderRun&) = delete;
    RenderRun& operator=(const RenderRun&) = delete;

    /// Writes the next frame. @return what has failed; the run is then done
    base::Status step();
    bool isDone() const { return next_ >= frames_; }
    int frames() const { return frames_; }
    double progress() const { return double(next_) / double(frames_); } ///< [0, 1]

private:
    RenderRun(std::unique_ptr<Preview> preview, RenderSubject subject, cli::OutputTarget target);
    base::Status writeFrame();
    PreviewFrame frameAt(int index, double time) const;

    std::unique_ptr<Preview> preview_;
    RenderSubject subject_;
    cli::OutputTarget target_;
    cli::FfmpegPipe video_;
    int frames_ = 1;
    int next_ = 0;
};

} // namespace fx::editor
