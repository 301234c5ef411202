#include "fxsdk/cli/render/reference_render.h"

#include "fxsdk/cli/render/blob_list_reader.h"
#include "fxsdk/cli/render/reference_scene.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"
#include "rendering/exr/exr_encoder.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

base::Status writeExr(const std::filesystem::path& path, const render::ReferenceRenderer& renderer, int width,
                      int height, float whiteLuminance, uint32_t threads)
{
    namespace channel = render::reference_channel;
    using render::ExrPrecision;
    render::ExrImage image{width, height, {}, whiteLuminance};
    const std::pair<const char*, uint32_t> layers[] = {{"", channel::Color},
                                                       {"background", channel::Background},
                                                       {"fire", channel::Fire},
                                                       {"smoke", channel::Smoke},
                                                       {"dust", channel::Dust}};
    std::vector<std::vector<float>> pixels;
    for (const auto& [name, first] : layers) {
        pixels.push_back(renderer.interleaved(first));
        render::addRgba(image, name, pixels.back(), ExrPrecision::Float);
    }
    render::addPlane(image, "depth.Z", renderer.pixels(channel::Depth), ExrPrecision::Float);
    render::addPlane(image, "opticalDepth.Y", renderer.pixels(channel::OpticalDepth), ExrPrecision::Float);
    const auto bytes = render::encodeExr(image, threads);
    return bytes.ok() ? writeFileAtomically(path, *bytes) : bytes.status();
}

/// Everything between the checked arguments and the last file.
class ReferenceJob
{
public:
    ReferenceJob(const RenderArguments& arguments, const RenderPlan& plan, const ReferencePlan& reference)
        : arguments_(arguments), plan_(plan), camera_(reference.camera),
          tasks_(base::makeTbbRunner(arguments.reference.threads))
    {
        settings_.width = plan.width;
        settings_.height = plan.height;
        settings_.samples = arguments.reference.samples;
        settings_.isSingle = reference.isSingle;
        settings_.scattering = reference.scattering;
        settings_.integral = reference.integral;
    }

    base::Status runBlobList()
    {
        auto blobs = loadBlobList(arguments_.input);
        if (!blobs.ok())
            return blobs.status();
        if (arguments_.exposureEv100)
            setExposure(*arguments_.exposureEv100);
        ReferenceFrame frame;
        frame.scene.blobs = std::move(*blobs);
        frame.scene.opaque.isEmpty = true;
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
            if (base::Status status = renderFrame(moment, *frame); !status)
                return status;
        }
        return finish();
    }

    base::Status chooseCamera()
    {
        if (arguments_.reference.camera.empty())
            return {};
        auto file = scene_file::loadSceneFile(arguments_.reference.camera);
        if (!file.ok())
            return file.status();
        path_ = file->camera;
        return {};
    }

    const Machine& machine() const { return machine_; }

private:
    void setExposure(float ev100)
    {
        white_ = 1.2f * std::exp2(ev100);
        settings_.exposure = 1.0 / double(white_);
    }

    base::Status renderFrame(const RenderPlan::Frame& moment, ReferenceFrame& frame)
    {
        if (camera_)
            frame.scene.camera = *camera_;
        else if (path_)
            frame.scene.camera = cameraOf(*path_, base::toSeconds(moment.tick));
        const Clock::time_point start = Clock::now();
        render::ReferenceRenderer renderer;
        if (base::Status status = renderer.build(frame.scene, settings_, *tasks_); !status)
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
        report(moment, frame, renderer.work(),
               std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        return {};
    }

    base::Status renderTiles(render::ReferenceRenderer& renderer, render::TileJournal& journal)
    {
        Progress progress("tile", renderer.tileCount(), !arguments_.json);
        return renderer.render(&journal,
                               {[&](uint32_t done, uint32_t) { progress.update(done); }, interruptRequested});
    }

    void report(const RenderPlan::Frame& moment, const ReferenceFrame& frame,
                const render::ReferenceWork& work, double milliseconds)
    {
        if (work.nonFinite > 0)
            std::fprintf(stderr,
                         "warning: %llu values of the picture were not finite, and were written as opaque "
                         "medium without light\n",
                         static_cast<unsigned long long>(work.nonFinite));
        nlohmann::json line;
        line["time"] = base::toSeconds(moment.tick);
        line["renderer"] = "reference";
        line["integrator"] = render::schemeName(settings_.integral.scheme);
        line["scattering"] = arguments_.reference.scattering;
        line["precision"] = arguments_.reference.precision;
        line["blobs"] = frame.scene.blobs.size();
        line["nonfinite"] = frame.nonFinite + work.nonFinite;
        line["rays"] = work.rays;
        line["hits"] = work.hits;
        line["ms_render"] = milliseconds;
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
    std::optional<render::ReferenceCamera> camera_; ///< of --view
    std::optional<scene_file::CameraPath> path_;    ///< of --camera
    std::unique_ptr<base::TaskRunner> tasks_;
    render::ReferenceSettings settings_;
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

base::Status runScene(ReferenceJob& job, const base::Result<scene_file::SceneFile>& scene)
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

int runReference(const RenderArguments& arguments, const RenderPlan& plan,
                 const std::function<base::Result<scene_file::SceneFile>()>& loadScene)
{
    const auto reference = planReference(arguments.reference);
    if (!reference.ok())
        return failedUsage(reference.status());
    if (plan.output.kind != OutputKind::Exr)
        return failedUsage(
            {base::Code::InvalidArgument, "--renderer reference writes EXR files: -o NAME.exr"});
    for (const RenderPlan::Frame& moment : plan.frames)
        if (base::Status status = checkTarget(plan.output.frame(moment.number)); !status)
            return failed(status);
    if (isBlobList(arguments.input) && !reference->camera && arguments.reference.camera.empty())
        return failedUsage(
            {base::Code::InvalidArgument, arguments.input + ": a list of blobs needs --view or --camera"});
    ReferenceJob job(arguments, plan, *reference);
    if (base::Status status = checkPictureMemory(plan.width, plan.height, job.machine().memory); !status)
        return failed(status);
    if (base::Status status = job.chooseCamera(); !status)
        return failed(status);
    const base::Status done = isBlobList(arguments.input) ? job.runBlobList() : runScene(job, loadScene());
    if (done.code() == base::Code::Interrupted)
        std::fprintf(stderr, "fx render: interrupted; the same command with --resume goes on\n");
    if (!done.ok())
        return done.code() == base::Code::Interrupted ? int(kInterrupted) : failed(done);
    if (!arguments.json)
        std::printf("%s: %zu %s of %dx%d on %s\n", arguments.output.c_str(), plan.frames.size(),
                    plan.frames.size() == 1 ? "frame" : "frames", plan.width, plan.height,
                    toText(job.machine()).c_str());
    return kSuccess;
}

} // namespace fx::cli
