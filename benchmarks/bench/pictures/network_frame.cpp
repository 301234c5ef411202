// fx bench network-frame: what illumination networks cost in whole frames: the smoke column and the steam of
// the library in voxels, with the closed form and with networks of as many cells as 24^3, 32^3 and 48^3.
// Prints one JSON object a case: least processor time of all threads and least wall time of the effects' part
// of a frame in which media have moved and of one in which everything rests, the sweeps of the first, and the
// frames until light rests. Fails when a frame at rest executes a pass of a network.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostFrames = 40; ///< in which light comes to rest

struct FrameCost
{
    double wallMs = 1e30, processorMs = 1e30; ///< least of all frames
};

void require(const base::Status& status)
{
    if (!status)
        fail(status.message());
}

/// Draws a scene, and counts the passes of networks.
struct NetworkFrames
{
    const scene_file::SceneFile& file;
    std::unique_ptr<QualityStage> stage;
    base::Ticks now;

    void move()
    {
        now += base::kTicksPerSecond / 60;
        require(stage->simulate(now));
        require(stage->look(file.camera));
    }
    void draw(FrameCost& io)
    {
        const double processor = processSeconds();
        const Clock::time_point start = Clock::now();
        require(stage->draw());
        const double wall = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        io.wallMs = std::min(io.wallMs, wall);
        io.processorMs = std::min(io.processorMs, 1e3 * (processSeconds() - processor));
    }
    size_t passes(std::string_view start) const
    {
        return size_t(std::ranges::count_if(stage->view().renderer.executedPasses(),
                                            [&](std::string_view name) { return name.starts_with(start); }));
    }
};

void measureCase(const char* preset, const scene_file::SceneFile& file, int cells,
                 const FrameOptions& options)
{
    NetworkFrames frames{file, taken(QualityStage::create(file, options.width, options.height)),
                         base::toTicks(options.time)};
    render::ViewSettings& settings = frames.stage->view().renderer.settings();
    settings.composition = render::Composition::Volume;
    settings.slices.automatic = false;
    settings.slices.network = cells > 0;
    settings.slices.networkCells = uint8_t(cells);
    FrameCost warm, moving, resting;
    for (int i = 0; i < 3; ++i) { // compiles, and begins in darkness
        frames.move();
        frames.draw(warm);
    }
    for (int i = 0; i < options.repeat; ++i) {
        frames.move();
        frames.draw(moving);
    }
    const size_t sweeps = frames.passes("network rays");
    int untilRest = 0;
    do
        frames.draw(warm);
    while (frames.passes("network") > 0 && ++untilRest < kMostFrames);
    for (int i = 0; i < options.repeat; ++i)
        frames.draw(resting);
    if (frames.passes("network") > 0)
        fail("a frame at rest executes passes of a network");
    Machine machine = readMachine();
    machine.glRenderer = frames.stage->rendererName();
    printJsonLine(withMachine({{"name", "network_frame"},
                               {"variant", preset},
                               {"network_cells", cells},
                               {"width", options.width},
                               {"height", options.height},
                               {"ms_moving", moving.processorMs},
                               {"ms_resting", resting.processorMs},
                               {"ms_wall_moving", moving.wallMs},
                               {"ms_wall_resting", resting.wallMs},
                               {"sweeps_moving", sweeps},
                               {"frames_until_rest", untilRest},
                               {"bytes_textures", frames.stage->view().renderer.statistics().textureBytes}},
                              machine));
}

void measure(const FrameOptions& asked)
{
    const FrameOptions options = asked.orSmall(2.0);
    for (const char* preset : {"library:smoke-column", "library:steam"}) {
        const scene_file::SceneFile file = taken(sceneOfPreset(preset));
        for (const int cells : {0, 24, 32, 48})
            if (!options.isSmall || cells < 32)
                measureCase(preset, file, cells, options);
    }
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<FrameOptions>(FrameOptions{.time = 4.0});
    addFrameOptions(command, *options);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement networkFrameBench()
{
    return {"network-frame", "Frames of media with illumination networks, moving and at rest", addOptions};
}

} // namespace fx::cli
