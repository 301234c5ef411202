// fx bench trace: times finding all balls that every ray of a picture meets, with where it enters them, among
// `balls` balls, the sum of whose volumes is `fill` times that of a unit ball around them. The tree is built
// again for each run, after the caches have been filled with other data. One thread, CPU time, minimum of
// `repeat` runs. Prints one JSON object with a hash of the hits.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/chance.h"
#include "foundation/math/hash.h"
#include "foundation/simd/instruction_set.h"
#include "rendering/reference/trace/tile_walk.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    size_t balls = 262144;
    int width = 640;
    int height = 360;
    int repeat = 5;
    double fill = 8.0; ///< sum of ball volumes per volume of the unit ball
    bool isSmall = false;
};

std::vector<render::TraceBall> makeBalls(const Options& options)
{
    bench::Chance chance(1);
    const double radius = std::cbrt(options.fill / double(options.balls));
    std::vector<render::TraceBall> balls;
    while (balls.size() < options.balls) {
        const glm::dvec3 p = chance.inCube();
        if (glm::dot(p, p) < 1.0)
            balls.push_back({p, radius * chance.between(0.8, 1.2)});
    }
    return balls;
}

render::RayGrid makeGrid(const Options& options)
{
    const double slope = 0.36; // the ball fills most of the picture's height
    const double aspect = double(options.width) / options.height;
    render::RayGrid grid;
    grid.direction = {-slope * aspect, slope, -1.0};
    grid.directionX = {2 * slope * aspect / options.width, 0, 0};
    grid.directionY = {0, -2 * slope / options.height, 0};
    return grid;
}

void clearCaches()
{
    static std::vector<uint64_t> other(size_t(8) << 20);
    for (uint64_t& word : other)
        word += 1;
}

struct Result
{
    double build = 1e30;
    double find = 1e30;
    uint64_t hits = 0;
    uint64_t hash = 0;
};

void runOnce(const std::vector<render::TraceBall>& balls, const Options& options, Result& result)
{
    const auto tasks = base::makeSerialRunner();
    const render::RayGrid grid = makeGrid(options);
    const glm::dvec3 eye(0.0, 0.0, 3.0);
    static render::BallTree tree;
    static render::TileWalk walk;
    clearCaches();
    double start = threadSeconds();
    tree.build(balls, eye, *tasks);
    result.build = std::min(result.build, threadSeconds() - start);

    uint64_t hits = 0;
    double sum = 0.0;
    start = threadSeconds();
    walk.run(tree, grid, {0, 0, options.width, options.height}, {},
             [&](int, int, const render::RayHits& ray) {
                 hits += ray.size();
                 if (ray.size() > 0)
                     sum += ray.enter[0] + ray.chordSquare[ray.size() - 1];
             });
    result.find = std::min(result.find, threadSeconds() - start);
    result.hits = hits;
    uint64_t bits;
    std::memcpy(&bits, &sum, sizeof bits);
    result.hash = base::hashWord(base::hashWord(0, hits), bits);
}

void measure(Options options)
{
    if (options.isSmall)
        options.balls = 2000, options.width = 64, options.height = 36, options.repeat = 1;
    const std::vector<render::TraceBall> balls = makeBalls(options);
    Result result;
    for (int i = 0; i < options.repeat; ++i)
        runOnce(balls, options, result);
    const double hits = double(result.hits);
    std::printf(
        "{\"name\":\"trace\",\"variant\":\"%s\",\"balls\":%zu,\"rays\":%d,\"hits\":%" PRIu64
        ",\"hits_per_ray\":%.1f,\"build_ns_per_ball\":%.1f,\"find_ns_per_hit\":%.2f,"
        "\"build_and_find_ns_per_hit\":%.2f,\"ms_build\":%.2f,\"ms_find\":%.2f,\"hash\":\"0x%016" PRIx64
        "\"}\n",
        std::string(base::instructionSetName(base::instructionSet())).c_str(), options.balls,
        options.width * options.height, result.hits, hits / (options.width * options.height),
        result.build * 1e9 / double(options.balls), result.find * 1e9 / hits,
        (result.build + result.find) * 1e9 / hits, result.build * 1e3, result.find * 1e3, result.hash);
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--balls", options->balls, "To be found")
        ->check(CLI::Range(size_t(1), size_t(1) << 28));
    addSizeOption(command, options->width, options->height);
    command.add_option("--repeat", options->repeat, "Runs of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--fill", options->fill, "[1] Their volume over that of the unit ball around them")
        ->check(CLI::PositiveNumber);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement traceBench()
{
    return {"trace",
            "Finding all blobs that rays meet: nanoseconds a blob to build the tree, and a hit to find it",
            addOptions};
}

} // namespace fx::cli
