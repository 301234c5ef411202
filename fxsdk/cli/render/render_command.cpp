/// @file render_command.cpp
/// fx render: scenes and presets to pictures.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/render/blob_list_render.h"
#include "fxsdk/cli/render/camera_choice.h"
#include "fxsdk/cli/render/depth_contacts.h"
#include "fxsdk/cli/render/frame_output.h"
#include "fxsdk/cli/render/render_options.h"
#include "fxsdk/cli/render/render_statistics.h"
#include "fxsdk/cli/render/tiled_render.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"
#include "rendering/stage/scale_figure.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace fx::cli {
namespace {

bool endsWith(const std::string& text, const std::string& end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// @param io where no option names a time, the still of a preset gets the time of the preset's preview
base::Result<scene_file::SceneFile> loadInput(const RenderArguments& arguments, RenderPlan& io)
{
    if (endsWith(arguments.input, ".scene.json")) {
        if (!arguments.stage.empty())
            return base::Status(base::Code::InvalidArgument,
                                "--stage needs a preset; the stage of a scene is that of its file");
        return scene_file::loadSceneFile(arguments.input);
    }
    if (!endsWith(arguments.input, ".fx.json") && arguments.input.rfind("library:", 0) != 0)
        return base::Status(base::Code::InvalidArgument,
                            arguments.input + ": expected *.scene.json, *.fx.json or library:NAME");
    scene_file::Preview preview;
    auto scene = sceneOfPreset(arguments.input, &preview, arguments.stage);
    if (!scene.ok())
        return scene;
    followPresets(*scene);
    if (io.hasDefaultTime && preview.time)
        io.frames[0].tick = base::toTicks(*preview.time);
    if (preview.hasCamera)
        return scene;
    EffectSceneOptions options;
    options.seed = arguments.seed;
    options.stepsPerSecond = io.stepsPerSecond;
    options.quality = io.simulationQuality;
    if (base::Status status =
            frameEffect(*scene, io.frames.back().tick, options, double(io.width) / double(io.height));
        !status)
        return status;
    return scene;
}

void placeFigure(const RenderPlan& plan, render::StageMesh& io)
{
    if (plan.noFigure || plan.figure)
        render::removeScaleFigures(io);
    if (plan.figure)
        render::addScaleFigure(io, {*plan.figure, 0.0f});
}

/// @param lights whose lights, sky and exposure take the place of the scene's; null: none
base::Result<scene_file::SceneFile> loadLitInput(const RenderArguments& arguments, RenderPlan& io,
                                                 const scene_file::SceneFile* lights)
{
    auto scene = loadInput(arguments, io);
    if (scene.ok())
        placeFigure(io, scene->mesh);
    if (!scene.ok() || !lights)
        return scene;
    scene->view.lighting = lights->view.lighting;
    scene->lights = lights->lights;
    scene->view.exposureEv100 = lights->view.exposureEv100;
    scene->background = lights->background;
    return scene;
}

/// Everything between the loaded scene and the last file.
class RenderJob
{
public:
    RenderJob(const RenderArguments& arguments, const RenderPlan& plan, const scene_file::SceneFile& scene)
        : arguments_(arguments), plan_(plan), scene_(scene)
    {}

    base::Status run()
    {
        FrameRendererOptions options{plan_.width, plan_.height, scene_.view, {}};
        applyArguments(arguments_, plan_.output.kind, options.settings);
        options.frameSeconds = 1.0 / plan_.framesPerSecond;
        options.scene.stepsPerSecond = plan_.stepsPerSecond;
        options.scene.quality = plan_.simulationQuality;
        options.scene.seed = arguments_.seed;
        options.scene.compute = arguments_.compute;
        options.warmsUp = arguments_.reportsTimes();

        auto output = FrameOutput::create(plan_, options.settings.exposureEv100);
        if (!output.ok())
            return output.status();
        auto renderer = FrameRenderer::create(scene_, options);
        if (!renderer.ok())
            return renderer.status();
        machine_.glRenderer = (*renderer)->rendererName();
        if (base::Status status = renderFrames(**renderer, **output); !status)
            return status;
        if (base::Status status = (*output)->finish(); !status)
            return status;
        return arguments_.statistics.empty() ? base::Status()
                                             : writeFileAtomically(arguments_.statistics, statistics_);
    }

    const Machine& machine() const { return machine_; }

private:
    base::Status renderFrames(FrameRenderer& renderer, FrameOutput& output)
    {
        Progress progress("frame", plan_.frames.size(), !arguments_.json);
        uint64_t done = 0;
        for (const RenderPlan::Frame& frame : plan_.frames) {
            progress.update(done);
            if (base::Status status = renderer.render(frame.tick); !status)
                return status;
            const auto layers = renderer.read();
            if (!layers.ok())
                return layers.status();
            if (interruptRequested())
                return interruptedStatus();
            if (base::Status status = output.write(frame.number, *layers); !status)
                return status;
            report(frame, renderer.counters());
            progress.update(++done);
        }
        return {};
    }

    void report(const RenderPlan::Frame& frame, const FrameCounters& counters)
    {
        const nlohmann::json line =
            frameStatistics(counters, base::toSeconds(frame.tick), arguments_.overdraw);
        statistics_ += line.dump() + "\n";
        if (!arguments_.json)
            return;
        nlohmann::json full = withMachine(line, machine_);
        full["file"] = plan_.output.frame(frame.number).string();
        full["threads"] = machine_.cores;
        full["seed"] = arguments_.seed ? nlohmann::json(*arguments_.seed) : nlohmann::json(nullptr);
        printJsonLine(full);
    }

    const RenderArguments& arguments_;
    const RenderPlan& plan_;
    const scene_file::SceneFile& scene_;
    Machine machine_ = readMachine();
    std::string statistics_; ///< the text of the file
};

/// The first given option that OpenGL would ignore; empty for none.
std::string optionWithoutGl(const CLI::App& command)
{
    for (const char* name : {"--integrator", "--precision", "--source", "--detail", "--sky-rings",
                             "--samples", "--threads", "--resume", "--sun-angle"})
        if (command.get_option(name)->count() > 0)
            return name;
    return {};
}

int failed(const base::Status& status)
{
    std::fprintf(stderr, "fx render: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

void warnOfLights(const scene_file::SceneFile& scene)
{
    if (scene.lights.size() > FX_MOST_LIGHTS)
        std::fprintf(
            stderr,
            "warning: --renderer gl takes the first %d of the %zu \"lights\" of the scene; --renderer "
            "reference and path take all\n",
            FX_MOST_LIGHTS, scene.lights.size());
}

int runRender(const RenderArguments& arguments)
{
    auto plan = planRender(arguments);
    if (!plan.ok()) {
        failed(plan.status());
        return kUsage;
    }
    std::optional<scene_file::SceneFile> lights;
    if (!arguments.lights.empty()) {
        auto file = scene_file::loadSceneFile(arguments.lights);
        if (!file.ok())
            return failed(file.status());
        lights = std::move(*file);
    }
    const auto load = [&] { return loadLitInput(arguments, *plan, lights ? &*lights : nullptr); };
    if (arguments.renderer != "gl")
        return runTiled(arguments, *plan, lights ? &*lights : nullptr, load);
    if (isBlobList(arguments.input)) {
        if (lights)
            warnOfLights(*lights);
        return runBlobList(arguments, *plan, lights ? &*lights : nullptr);
    }
    if (const auto reference = planReference(arguments.reference); !reference.ok()) {
        failed(reference.status());
        return kUsage;
    }
    auto scene = load();
    if (!scene.ok())
        return failed(scene.status());
    if (base::Status status = replaceCamera(arguments.reference, scene->camera); !status)
        return failed(status);
    for (const preset::Diagnostic& warning : scene->warnings)
        std::fprintf(stderr, "warning: %s\n", preset::toString(warning).c_str());

    warnOfLights(*scene);
    const std::string why = gpuObstacleOf(*scene);
    if (arguments.compute == "gpu" && !why.empty() && !showsDepthContacts(*scene))
        std::fprintf(stderr,
                     "warning: --compute gpu: the CPU computes all particles here, as the stage takes light "
                     "from them: %s\n",
                     why.c_str());
    RenderJob job(arguments, *plan, *scene);
    if (base::Status status = job.run(); !status)
        return failed(status);
    printRendered(arguments, *plan, toText(job.machine()));
    return kSuccess;
}

} // namespace

void addRenderCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command =
        app.add_subcommand("render", "Render a scene or a preset to PNG, EXR, a sequence or a video");
    addRenderOptions(*command, *arguments);
    command->callback([arguments, command, &outExitCode] {
        const std::string unused = arguments->renderer == "gl" ? optionWithoutGl(*command) : std::string();
        if (!unused.empty())
            std::fprintf(stderr, "fx render: %s needs --renderer reference or path\n", unused.c_str());
        outExitCode = unused.empty() ? runRender(*arguments) : kUsage;
    });
}

} // namespace fx::cli
