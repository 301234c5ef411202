#include "fxsdk/cli/render/tiled_render.h"

#include "fxsdk/cli/render/blob_list_reader.h"
#include "fxsdk/cli/render/camera_choice.h"
#include "fxsdk/cli/render/picture_renderer.h"
#include "fxsdk/cli/render/reference_scene.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"
#include "fxsdk/presets/order_members.h"
#include "rendering/exr/exr_encoder.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

base::Status writeExr(const std::filesystem::path& path, const PictureRenderer& renderer, int width,
                      int height, float whiteLuminance, uint32_t threads)
{
    render::ExrImage image{width, height, {}, whiteLuminance};
    std::vector<std::vector<float>> pixels;
    renderer.addChannels(image, pixels);
    const auto bytes = render::encodeExr(image, threads);
    return bytes.ok() ? writeFileAtomically(path, *bytes) : bytes.status();
}

/// Everything between the checked arguments and the last file.
class TiledJob
{
public:
    TiledJob(const RenderArguments& arguments, const RenderPlan& plan, const ReferencePlan& reference,
             const scene_file::SceneFile* lights, const CameraChoice& camera)
        : arguments_(arguments), plan_(plan), reference_(reference), lights_(lights), camera_(camera),
          tasks_(base::makeTbbRunner(arguments.reference.threads))
    {}

    base::Status runBlobList()
    {
        auto blobs = loadBlobList(arguments_.input);
        if (!blobs.ok())
            return blobs.status();
        if (lights_)
            setExposure(arguments_.exposureEv100.value_or(lights_->view.exposureEv100));
        else if (arguments_.exposureEv100)
            setExposure(*arguments_.exposureEv100);
        ReferenceFrame frame;
        frame.scene.blobs = std::move(*blobs);
        frame.scene.opaque.isEmpty = true;
        if (lights_) {
            frame.scene.opaque.lighting = lights_->view.lighting;
            frame.scene.opaque.lamps = lights_->lights;
        }
        for (const RenderPlan::Frame& moment : plan_.frames)
            if (base::Status status = renderFrame(moment, frame); !status)
                return status;
        return finish();
    }

    base::Status runScene(const scene_file::SceneFile& scene)
    {
        setExposure(arguments_.exposureEv100.value_or(scene.view.exposureEv100));
        EffectSceneOptions options;
        options.stepsPerSecond = plan_.stepsPerSecond;
        options.quality = plan_.simulationQuality;
        options.seed = arguments_.seed;
        auto source = ReferenceSceneSource::create(scene, options);
        if (!source.ok())
            return source.status();
        for (const RenderPlan::Frame& moment : plan_.frames) {
            auto frame = (*source)->frameAt(moment.tick);
            if (!frame.ok())
                return frame.status();
            if (!drawsDetail(scene))
                render::removeNoise(frame->scene.details);
            if (base::Status status = renderFrame(moment, *frame); !status)
                return status;
        }
        return finish();
    }

    const Machine& machine() const { return machine_; }

private:
    bool drawsDetail(const scene_file::SceneFile& scene) const
    {
        const std::string& detail = arguments_.reference.detail;
        if (detail != "auto")
            return detail == "on";
        render::ViewSettings settings = scene.view;
        applyArguments(arguments_, OutputKind::Exr, settings);
        if (settings.composition == render::Composition::Automatic)
            return preset::sumsUp(scene_file::preferredHints(scene).composition);
        return settings.composition != render::Composition::Sorted;
    }
    void setExposure(float ev100) { white_ = 1.2f * std::exp2(ev100); }

    base::Status renderFrame(const RenderPlan::Frame& moment, ReferenceFrame& frame)
    {
        frame.scene.camera = camera_.at(base::toSeconds(moment.tick), frame.scene.camera);
        const Clock::time_point start = Clock::now();
        const double time = base::toSeconds(moment.tick);
        past_ = {shown_ ? shown_->camera : frame.scene.camera,
                 shown_ ? time - shown_->time : 1.0 / plan_.framesPerSecond};
        shown_ = {frame.scene.camera, time};
        const std::unique_ptr<PictureRenderer> made = makeRenderer();
        PictureRenderer& renderer = *made;
        if (base::Status status = renderer.build(frame.scene, 1.0 / double(white_), *tasks_); !status)
            return status;
        const std::filesystem::path file = plan_.output.frame(moment.number);
        render::TileJournal journal(file.string() + ".journal", renderer.key());
        const auto restore = [&](uint32_t tile, std::span<const float> values) {
            renderer.restore(tile, values);
        };
        if (base::Status status = arguments_.reference.resume ? journal.resume(restore) : journal.start();
            !status)
            return status;
        if (base::Status status = renderTiles(renderer, journal); !status)
            return status;
        if (base::Status status =
                writeExr(file, renderer, plan_.width, plan_.height, white_, arguments_.reference.threads);
            !status)
            return status;
        journal.remove();
        report(moment, frame, renderer, std::chrono::duration<double>(Clock::now() - start).count());
        return {};
    }

    std::unique_ptr<PictureRenderer> makeRenderer() const
    {
        if (arguments_.renderer == "path")
            return makePathPicture(arguments_.reference, plan_.width, plan_.height, arguments_.seed);
        return makeReferencePicture(arguments_.reference, reference_, plan_.width, plan_.height,
                                    arguments_.outputs.empty() ? nullptr : &past_);
    }

    base::Status renderTiles(PictureRenderer& renderer, render::TileJournal& journal)
    {
        Progress progress("tile", renderer.tileCount(), !arguments_.json);
        return renderer.render(&journal,
                               {[&](uint32_t done, uint32_t) { progress.update(done); }, interruptRequested});
    }

    void report(const RenderPlan::Frame& moment, const ReferenceFrame& frame, const PictureRenderer& renderer,
                double seconds)
    {
        if (renderer.nonFinite() > 0)
            std::fprintf(stderr, "warning: %llu values of the picture were not finite, and were %s\n",
                         static_cast<unsigned long long>(renderer.nonFinite()),
                         arguments_.renderer == "path" ? "counted as black"
                                                       : "written as opaque medium without light");
        nlohmann::json line;
        line["time"] = base::toSeconds(moment.tick);
        renderer.addStatistics(line, seconds);
        line["blobs"] = frame.scene.blobs.size();
        line["nonfinite"] = frame.nonFinite + renderer.nonFinite();
        line["ms_render"] = 1e3 * seconds;
        statistics_ += line.dump() + "\n";
        if (!arguments_.json)
            return;
        nlohmann::json full = withMachine(line, machine_);
        full["file"] = plan_.output.frame(moment.number).string();
        full["threads"] =
            arguments_.reference.threads > 0 ? int(arguments_.reference.threads) : machine_.cores;
        full["seed"] = arguments_.seed ? nlohmann::json(*arguments_.seed) : nlohmann::json(nullptr);
        printJsonLine(full);
    }

    base::Status finish() const
    {
        return arguments_.statistics.empty() ? base::Status()
                                             : writeFileAtomically(arguments_.statistics, statistics_);
    }

    const RenderArguments& arguments_;
    const RenderPlan& plan_;
    const ReferencePlan& reference_;
    const scene_file::SceneFile* lights_; ///< of --lights; null: none
    const CameraChoice& camera_;
    struct Shown
    {
        render::ReferenceCamera camera;
        double time; ///< [s]
    };
    std::optional<Shown> shown_; ///< the picture before
    render::ReferencePast past_; ///< of this picture
    std::unique_ptr<base::TaskRunner> tasks_;
    float white_ = 1.0f; ///< [cd/m2] that is written as 1
    Machine machine_ = readMachine();
    std::string statistics_; ///< the text of the file
};

int failed(const base::Status& status)
{
    std::fprintf(stderr, "fx render: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

int failedUsage(const base::Status& status)
{
    failed(status);
    return kUsage;
}

base::Status runScene(TiledJob& job, const base::Result<scene_file::SceneFile>& scene)
{
    if (!scene.ok())
        return scene.status();
    for (const preset::Diagnostic& warning : scene->warnings)
        std::fprintf(stderr, "warning: %s\n", preset::toString(warning).c_str());
    return job.runScene(*scene);
}

} // namespace

bool isBlobList(const std::string& input)
{
    return input.ends_with(".blobs.csv");
}

int runTiled(const RenderArguments& arguments, const RenderPlan& plan, const scene_file::SceneFile* lights,
             const std::function<base::Result<scene_file::SceneFile>()>& loadScene)
{
    const auto reference = planReference(arguments.reference);
    if (!reference.ok())
        return failedUsage(reference.status());
    if (plan.output.kind != OutputKind::Exr)
        return failedUsage({base::Code::InvalidArgument,
                            "--renderer " + arguments.renderer + " writes EXR files: -o NAME.exr"});
    for (const RenderPlan::Frame& moment : plan.frames)
        if (base::Status status = checkTarget(plan.output.frame(moment.number)); !status)
            return failed(status);
    const auto camera = CameraChoice::create(arguments.reference, *reference);
    if (!camera.ok())
        return failed(camera.status());
    if (isBlobList(arguments.input) && camera->isNone())
        return failedUsage(
            {base::Code::InvalidArgument, arguments.input + ": a list of blobs needs --view or --camera"});
    TiledJob job(arguments, plan, *reference, lights, *camera);
    if (base::Status status = checkPictureMemory(plan.width, plan.height, job.machine().memory); !status)
        return failed(status);
    const base::Status done = isBlobList(arguments.input) ? job.runBlobList() : runScene(job, loadScene());
    if (done.code() == base::Code::Interrupted)
        std::fprintf(stderr, "fx render: interrupted; the same command with --resume goes on\n");
    if (!done.ok())
        return done.code() == base::Code::Interrupted ? int(kInterrupted) : failed(done);
    printRendered(arguments, plan, toText(job.machine()));
    return kSuccess;
}

} // namespace fx::cli
