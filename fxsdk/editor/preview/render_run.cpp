#include "fxsdk/editor/preview/render_run.h"

#include "fxsdk/cli/scene/picture.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/editor/preview/instance_motion.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/image/image.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace fx::editor {

namespace {

constexpr double kStepsPerSecond = 60.0; // of effects that are played

/// One file for a picture; otherwise a file for each frame, or a video.
base::Result<cli::OutputTarget> targetOf(const RenderRequest& request)
{
    auto target = cli::parseOutputTarget(request.file);
    if (!target)
        return target.status();
    const bool isPicture = request.kind == RenderKind::Picture;
    if (target->kind == cli::OutputKind::Exr)
        return base::Status(base::Code::InvalidArgument,
                            request.file + ": the editor writes PNG and MP4; fx render writes EXR");
    if (isPicture != target->isStill())
        return base::Status(base::Code::InvalidArgument,
                            request.file + (isPicture ? ": a picture is NAME.png"
                                                      : ": several frames are NAME.%04d.png or NAME.mp4"));
    return target;
}

int framesOf(const RenderSubject& subject)
{
    switch (subject.request.kind) {
    case RenderKind::Picture:
        return 1;
    case RenderKind::Turntable:
        return std::max(subject.request.turnFrames, 1);
    default:
        return int(std::floor(subject.end * subject.request.framesPerSecond + 1e-6)) + 1;
    }
}

} // namespace

base::Result<std::unique_ptr<RenderRun>> RenderRun::create(const render::GlLoader& loader,
                                                           RenderSubject subject)
{
    auto target = targetOf(subject.request);
    if (!target)
        return target.status();
    if (base::Status status = cli::checkTarget(target->frame(0)); !status)
        return status;
    auto preview = Preview::create(loader);
    if (!preview)
        return preview.status();
    std::unique_ptr<RenderRun> run(
        new RenderRun(std::move(*preview), std::move(subject), std::move(*target)));
    const RenderSubject& of = run->subject_;
    run->preview_->setMotion(of.motion);
    base::Status status = run->preview_->show(of.text, of.name, of.kind);
    if (status.ok() && run->target_.kind == cli::OutputKind::Mp4)
        status = run->video_.start(run->target_.path, of.request.width, of.request.height,
                                   of.request.framesPerSecond);
    if (!status.ok())
        return status;
    return run;
}

RenderRun::RenderRun(std::unique_ptr<Preview> preview, RenderSubject subject, cli::OutputTarget target)
    : preview_(std::move(preview)), subject_(std::move(subject)), target_(std::move(target)),
      frames_(framesOf(subject_))
{}

base::Status RenderRun::step()
{
    if (isDone())
        return {};
    base::Status status = writeFrame();
    next_ = status.ok() ? next_ + 1 : frames_;
    if (status.ok() && isDone() && target_.kind == cli::OutputKind::Mp4)
        status = video_.finish();
    return status;
}

PreviewFrame RenderRun::frameAt(int index, double time) const
{
    OrbitCamera camera = subject_.camera;
    if (subject_.request.kind == RenderKind::Turntable)
        camera.orbit(2.0 * std::numbers::pi * index / frames_, 0.0);
    const RenderKind kind = subject_.request.kind;
    if (subject_.followsCamera && (kind == RenderKind::Sequence || kind == RenderKind::Video)) {
        const scene_file::CameraPose pose = preview_->scene().camera.at(time);
        camera.look(pose.position, pose.target);
        camera.fovYDegrees = preview_->scene().camera.fovYDegrees;
    }
    PreviewFrame frame;
    frame.pose.position = camera.position();
    frame.pose.target = camera.target();
    frame.fovYDegrees = camera.fovYDegrees;
    frame.width = subject_.request.width;
    frame.height = subject_.request.height;
    frame.exposureEv100 = subject_.exposureEv100;
    return frame;
}

base::Status RenderRun::writeFrame()
{
    const bool isTimeline =
        subject_.request.kind == RenderKind::Sequence || subject_.request.kind == RenderKind::Video;
    double time = isTimeline ? double(next_) / subject_.request.framesPerSecond : subject_.time;
    if (isPlayed(preview_->scene())) // in steps
        time = std::round(time * kStepsPerSecond) / kStepsPerSecond;
    base::Status status = preview_->seek(time);
    const PreviewFrame frame = frameAt(next_, time);
    if (status.ok())
        status = preview_->render(frame);
    if (!status.ok())
        return status;
    const cli::Picture picture = cli::fromBottomUp(
        frame.width, frame.height, 3,
        render::readTexture(preview_->device(), preview_->texture(), frame.width, frame.height, 3));
    if (target_.kind == cli::OutputKind::Mp4) {
        std::vector<uint8_t> bytes(picture.pixels.size());
        std::transform(picture.pixels.begin(), picture.pixels.end(), bytes.begin(), [](float value) {
            return uint8_t(std::lround(255.0f * (value > 0.0f ? std::min(value, 1.0f) : 0.0f)));
        });
        return video_.write(bytes);
    }
    const auto png = image::writePng({picture.width, picture.height, picture.channels, picture.pixels});
    if (!png)
        return png.status();
    return cli::writeFileAtomically(target_.frame(next_),
                                    {reinterpret_cast<const char*>(png->data()), png->size()});
}

} // namespace fx::editor
