// fx bench lit-frame: what light slices cost in whole frames: the smoke column of the library, 10,000 blobs,
// and any scene files, with and without slices in turn. Prints one JSON object a case: least processor time
// of all threads and least wall time of the effects' part of a frame in which media have moved, of one in
// which everything rests, and the mean of frames whose planes are filled every time and every fourth. Fails
// when slices change nothing in the picture, or when a resting frame fills planes.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/lit_media.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kBlobs = 10'000;
constexpr int kRefreshFrames = 4; ///< SliceSettings::refreshFrames that is compared with 1

struct Options
{
    std::vector<std::string> files;
    FrameOptions frames{.time = 6.0, .width = 640, .height = 360};
};

struct Cost
{
    double wallMs = 1e30;
    double processorMs = 1e30; ///< of all threads

    void take(const std::function<void()>& work)
    {
        const double processor = processSeconds();
        const Clock::time_point start = Clock::now();
        work();
        wallMs = std::min(wallMs, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        processorMs = std::min(processorMs, 1e3 * (processSeconds() - processor));
    }
};

/// Something that is drawn again and again.
struct Subject
{
    std::string name;
    std::function<void()> move; ///< the next moment
    std::function<render::SliceSettings&()> slices;
    std::function<void()> draw; ///< and waits for it
    std::function<std::vector<float>()> picture;
    std::function<bool()> fillsPlanes; ///< in the frame that was drawn last
    std::function<size_t()> blobs;
    std::string renderer;
};

struct Costs
{
    Cost moving, resting;
};

/// Frames in which media move.
struct MovingFrames
{
    double ms = 1e30;    ///< [ms] mean processor time of a frame, the least of some rounds
    double fillings = 0; ///< [1] mean share of frames in which planes are filled
};

/// Lights that move are followed at once, so that planes may be filled more often than asked.
MovingFrames framesOf(const Subject& subject, int refreshFrames, int rounds)
{
    subject.slices().enabled = true;
    subject.slices().refreshFrames = refreshFrames;
    MovingFrames frames;
    for (int round = -1; round < rounds; ++round) { // in the first the planes may be from before
        int fillings = 0;
        double sum = 0.0;
        for (int i = 0; i < kRefreshFrames; ++i) {
            subject.move();
            const double start = processSeconds();
            subject.draw();
            sum += 1e3 * (processSeconds() - start);
            fillings += subject.fillsPlanes() ? 1 : 0;
        }
        if (round < 0)
            continue;
        if (fillings < kRefreshFrames / refreshFrames)
            fail(subject.name + ": planes are not filled as often as asked");
        frames.ms = std::min(frames.ms, sum / kRefreshFrames);
        frames.fillings += double(fillings) / (kRefreshFrames * rounds);
    }
    subject.slices().refreshFrames = 1;
    return frames;
}

void measureSubject(const Subject& subject, const FrameOptions& options, Machine machine)
{
    Costs with, without;
    std::vector<float> pictures[2];
    for (int i = -1; i < options.repeat; ++i) { // the first compiles
        subject.move();
        for (const bool slices : {true, false}) {
            Costs& costs = slices ? with : without;
            subject.slices().enabled = slices;
            Costs now;
            now.moving.take(subject.draw);
            now.resting.take(subject.draw);
            if (subject.fillsPlanes())
                fail(subject.name + ": a resting frame fills planes");
            pictures[slices ? 1 : 0] = subject.picture();
            if (i < 0)
                continue;
            for (const auto& [all, one] :
                 {std::pair(&costs.moving, &now.moving), std::pair(&costs.resting, &now.resting)})
            {
                all->wallMs = std::min(all->wallMs, one->wallMs);
                all->processorMs = std::min(all->processorMs, one->processorMs);
            }
        }
    }
    const MovingFrames often = framesOf(subject, 1, options.repeat);
    const MovingFrames seldom = framesOf(subject, kRefreshFrames, options.repeat);
    if (pictures[0] == pictures[1])
        fail(subject.name + ": the picture is the same without slices");
    machine.glRenderer = subject.renderer;
    printJsonLine(withMachine({{"name", "lit_frame"},
                               {"variant", subject.name},
                               {"count", subject.blobs()},
                               {"width", options.width},
                               {"height", options.height},
                               {"ms_moving", with.moving.processorMs},
                               {"ms_moving_without", without.moving.processorMs},
                               {"ratio_moving", with.moving.processorMs / without.moving.processorMs},
                               {"ms_frames", often.ms},
                               {"ms_frames_refreshed_seldom", seldom.ms},
                               {"fillings_refreshed_seldom", seldom.fillings},
                               {"ratio_refreshed_seldom", seldom.ms / often.ms},
                               {"ms_resting", with.resting.processorMs},
                               {"ms_resting_without", without.resting.processorMs},
                               {"ratio_resting", with.resting.processorMs / without.resting.processorMs},
                               {"ms_wall_moving", with.moving.wallMs},
                               {"ms_wall_moving_without", without.moving.wallMs}},
                              machine));
}

void require(const base::Status& status)
{
    if (!status)
        fail(status.message());
}

void measureScene(const std::string& name, const scene_file::SceneFile& file, const FrameOptions& options)
{
    const std::unique_ptr<QualityStage> stage =
        taken(QualityStage::create(file, options.width, options.height));
    base::Ticks now = base::toTicks(options.time);
    render::ViewRenderer& renderer = stage->view().renderer;
    const auto passes = [&] { return renderer.executedPasses(); };
    measureSubject({name,
                    [&] {
                        now += base::kTicksPerSecond / 60;
                        require(stage->simulate(now));
                        require(stage->look(file.camera));
                    },
                    [&]() -> render::SliceSettings& { return renderer.settings().slices; },
                    [&] { require(stage->draw()); }, [&] { return stage->picture(); },
                    [&] { return std::ranges::count(passes(), "light slices") > 0; },
                    [&] { return size_t(renderer.statistics().blobs); }, stage->rendererName()},
                   options, readMachine());
}

void measureBlobs(const FrameOptions& options)
{
    const uint32_t count = options.isSmall ? kBlobs / 20 : kBlobs;
    const std::vector<render::MediumBlob> blobs = blobsOf({count, 0.1, 4.0, 0.9, 0.3});
    render::ViewSettings settings;
    settings.lighting = daylight();
    settings.exposureEv100 = 14.5f;
    const auto renderer = taken(BlobListRenderer::create(blobs, settings, options.width, options.height));
    const LitView view;
    measureSubject({"blobs-" + std::to_string(count), [&] { renderer->show(blobs); },
                    [&]() -> render::SliceSettings& { return renderer->pictures().settings().slices; },
                    [&] { require(renderer->render(cameraOf(view), 0.0)); },
                    [&] { return renderer->pictures().read().color.pixels; },
                    [&] { return renderer->pictures().fillsPlanes(); },
                    [&] { return size_t(renderer->pictures().statistics().blobs); },
                    renderer->pictures().rendererName()},
                   options, readMachine());
}

void measure(const Options& asked)
{
    const FrameOptions options = asked.frames.orSmall(1.0);
    measureScene("smoke-column", taken(sceneOfPreset("library:smoke-column")), options);
    measureBlobs(options);
    for (const std::string& file : asked.files)
        measureScene(file, taken(scene_file::loadSceneFile(file)), options);
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("FILE", options->files, "Scenes (*.scene.json) besides the two that are built in");
    addFrameOptions(command, options->frames);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement litFrameBench()
{
    return {"lit-frame", "Frames of media in light, with and without the shadows of light slices",
            addOptions};
}

} // namespace fx::cli
