#include "fxsdk/cli/render/blob_list_render.h"

#include "fxsdk/cli/render/blob_list_reader.h"
#include "fxsdk/cli/render/blob_list_renderer.h"
#include "fxsdk/cli/render/camera_choice.h"
#include "fxsdk/cli/render/frame_output.h"
#include "fxsdk/cli/scene/view_settings.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fx::cli {
namespace {

/// Of a list, of which luminances are written as they are, unless options say otherwise.
render::ViewSettings settingsOf(const RenderArguments& arguments, OutputKind kind,
                                const scene_file::SceneFile* lights)
{
    render::ViewSettings settings;
    settings.exposureEv100 = -std::log2(1.2f);
    if (lights) {
        settings.lighting = lights->view.lighting;
        settings.exposureEv100 = lights->view.exposureEv100;
        render::HostLights& host = settings.hostLights;
        for (; host.count < std::min(lights->lights.size(), render::kMaxHostLights); ++host.count)
            host.lights[host.count] = toHostLight(lights->lights[host.count]);
    }
    applyArguments(arguments, kind, settings);
    settings.composition = render::resolved(settings.composition, render::Composition::Sorted);
    return settings;
}

class BlobListJob
{
public:
    BlobListJob(const RenderArguments& arguments, const RenderPlan& plan, const scene_file::SceneFile* lights)
        : arguments_(arguments), plan_(plan), lights_(lights)
    {}

    base::Status run(const CameraChoice& camera)
    {
        const auto blobs = loadBlobList(arguments_.input);
        if (!blobs.ok())
            return blobs.status();
        const render::ViewSettings settings = settingsOf(arguments_, plan_.output.kind, lights_);
        auto output = FrameOutput::create(plan_, settings.exposureEv100);
        if (!output.ok())
            return output.status();
        auto renderer = BlobListRenderer::create(*blobs, settings, plan_.width, plan_.height);
        if (!renderer.ok())
            return renderer.status();
        if (arguments_.reportsTimes())
            if (base::Status status = (*renderer)->pictures().warmUp(); !status)
                return status;
        machine_.glRenderer = (*renderer)->pictures().rendererName();
        Progress progress("frame", plan_.frames.size(), !arguments_.json);
        uint64_t done = 0;
        for (const RenderPlan::Frame& frame : plan_.frames) {
            const double time = base::toSeconds(frame.tick);
            if (base::Status status = (*renderer)->render(camera.at(time), time); !status)
                return status;
            if (interruptRequested())
                return interruptedStatus();
            if (base::Status status = (*output)->write(frame.number, (*renderer)->pictures().read()); !status)
                return status;
            report(frame, (*renderer)->pictures());
            progress.update(++done);
        }
        if (base::Status status = (*output)->finish(); !status)
            return status;
        return arguments_.statistics.empty() ? base::Status()
                                             : writeFileAtomically(arguments_.statistics, statistics_);
    }

    const Machine& machine() const { return machine_; }

private:
    void report(const RenderPlan::Frame& frame, const SnapshotRenderer& renderer)
    {
        const render::FrameStatistics& view = renderer.statistics();
        const nlohmann::json line = {
            {"time", base::toSeconds(frame.tick)},
            {"renderer", "gl"},
            {"blobs", view.blobs},
            {"blobs_culled", view.blobsCulled},
            {"nonfinite", view.blobsNonFinite},
            {"draw_calls", view.drawCalls},
            {"gl_calls", view.glCalls},
            {"bytes_textures", view.textureBytes},
            {"ms_render", renderer.millisecondsRender()},
        };
        statistics_ += line.dump() + "\n";
        if (!arguments_.json)
            return;
        nlohmann::json full = withMachine(line, machine_);
        full["file"] = plan_.output.frame(frame.number).string();
        full["threads"] = machine_.cores;
        full["seed"] = nullptr;
        printJsonLine(full);
    }

    const RenderArguments& arguments_;
    const RenderPlan& plan_;
    const scene_file::SceneFile* lights_;
    Machine machine_ = readMachine();
    std::string statistics_; ///< the text of the file
};

int failed(const base::Status& status, int code)
{
    std::fprintf(stderr, "fx render: %s\n", status.message().c_str());
    return code;
}

} // namespace

int runBlobList(const RenderArguments& arguments, const RenderPlan& plan, const scene_file::SceneFile* lights)
{
    const auto reference = planReference(arguments.reference);
    if (!reference.ok())
        return failed(reference.status(), kUsage);
    const auto camera = CameraChoice::create(arguments.reference, *reference);
    if (!camera.ok())
        return failed(camera.status(), exitCodeOf(camera.status()));
    if (camera->isNone())
        return failed(
            {base::Code::InvalidArgument, arguments.input + ": a list of blobs needs --view or --camera"},
            kUsage);
    BlobListJob job(arguments, plan, lights);
    if (base::Status status = job.run(*camera); !status)
        return failed(status, exitCodeOf(status));
    printRendered(arguments, plan, toText(job.machine()));
    return kSuccess;
}

} // namespace fx::cli
