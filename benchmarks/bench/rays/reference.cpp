// fx bench reference: times a whole picture of the reference renderer: N blobs in a unit ball, that cover its
// cross-section C times and have the mean optical depth D over it, whatever N is. So pictures of different N
// show as much medium, and a ray meets as many blobs; what differs is the scene around it. Prints one JSON
// object: least time of `repeat` runs, of building and of rendering, work, and a hash of the picture.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/chance.h"
#include "foundation/math/hash.h"
#include "fxsdk/cli/support/json_line.h"
#include "rendering/reference/render/reference_renderer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

namespace fx::cli {
namespace {

struct Options
{
    size_t blobs = 100000;
    double cover = 32.0; ///< about what a ray meets within the ball
    double depth = 4.0;  ///< [1]
    int width = 640;
    int height = 360;
    uint32_t threads = 2;
    int repeat = 5;
    bool isSingle = false;
    bool isSmall = false;
};

render::ReferenceScene makeScene(const Options& options)
{
    bench::Chance chance(1);
    const double count = double(options.blobs);
    const double radius = std::sqrt(options.cover / count);
    render::ReferenceScene scene;
    scene.blobs.reserve(options.blobs);
    while (scene.blobs.size() < options.blobs) {
        render::MediumBlob blob;
        blob.center = chance.inCube();
        if (glm::dot(blob.center, blob.center) >= 1.0)
            continue;
        blob.radius = radius * chance.between(0.8, 1.2);
        blob.crossSection = options.depth * std::numbers::pi / count;
        blob.source = {chance(), chance(), chance()};
        scene.blobs.push_back(blob);
    }
    scene.opaque.isEmpty = true;
    scene.camera = render::ReferenceCamera::lookAt({0.0, 0.0, 3.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0});
    scene.camera.halfHeight = 0.36; // the ball fills most of the picture's height
    return scene;
}

struct Result
{
    double build = 1e30;  ///< [s] wall
    double render = 1e30; ///< [s] wall
    double cpu = 1e30;    ///< [s] of all threads
    render::ReferenceWork work;
    double meanDepth = 0.0; ///< [1] over the picture
    uint64_t hash = 0;
};

bool runOnce(const render::ReferenceScene& scene, const Options& options, base::TaskRunner& tasks,
             Result& out)
{
    using Clock = std::chrono::steady_clock;
    render::ReferenceSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    settings.isSingle = options.isSingle;
    const double cpu = processSeconds();
    const Clock::time_point start = Clock::now();
    render::ReferenceRenderer renderer;
    if (!renderer.build(scene, settings, tasks).ok())
        return false;
    const Clock::time_point built = Clock::now();
    if (!renderer.render(nullptr, {}).ok())
        return false;
    const Clock::time_point done = Clock::now();
    out.cpu = std::min(out.cpu, processSeconds() - cpu);
    out.build = std::min(out.build, std::chrono::duration<double>(built - start).count());
    out.render = std::min(out.render, std::chrono::duration<double>(done - built).count());
    out.work = renderer.work();
    out.hash = 0;
    for (uint32_t c = 0; c < render::reference_channel::Count; ++c) {
        const std::vector<float>& plane = renderer.pixels(c);
        out.hash = base::hashBytes(out.hash, plane.data(), plane.size() * sizeof(float));
    }
    double sum = 0.0;
    for (const float depth : renderer.pixels(render::reference_channel::OpticalDepth))
        sum += double(depth);
    out.meanDepth = sum / double(options.width * options.height);
    return true;
}

void measure(Options options)
{
    if (options.isSmall)
        options.blobs = 1000, options.width = 64, options.height = 36, options.repeat = 1;
    const render::ReferenceScene scene = makeScene(options);
    const auto tasks = base::makeTbbRunner(options.threads);
    Result result;
    for (int i = 0; i < options.repeat; ++i)
        if (!runOnce(scene, options, *tasks, result))
            fail("the renderer refuses the scene");
    printJsonLine(withMachine({{"name", "reference"},
                               {"variant", options.isSingle ? "float" : "double"},
                               {"blobs", options.blobs},
                               {"cover", options.cover},
                               {"threads", options.threads},
                               {"width", options.width},
                               {"height", options.height},
                               {"rays", result.work.rays},
                               {"hits", result.work.hits},
                               {"mean_depth", result.meanDepth},
                               {"ms_build", result.build * 1e3},
                               {"ms_render", result.render * 1e3},
                               {"ms_picture", (result.build + result.render) * 1e3},
                               {"ms_processor", result.cpu * 1e3},
                               {"hash", hashText(result.hash)}},
                              readMachine()));
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--blobs", options->blobs, "In the ball")
        ->check(CLI::Range(size_t(1), size_t(1) << 28));
    command.add_option("--cover", options->cover, "[1] Cross-sections of the ball that they cover")
        ->check(CLI::PositiveNumber);
    command.add_option("--depth", options->depth, "[1] Mean optical depth of the ball")
        ->check(CLI::PositiveNumber);
    addSizeOption(command, options->width, options->height);
    command.add_option("--threads", options->threads, "Threads")->check(CLI::Range(0u, 1024u));
    command.add_option("--repeat", options->repeat, "Runs of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    command.add_flag("--float", options->isSingle, "Rays in float instead of double");
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement referenceBench()
{
    return {"reference", "A picture of the reference renderer of N blobs at equal covered optical depth",
            addOptions};
}

} // namespace fx::cli
