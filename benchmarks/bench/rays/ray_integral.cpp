// fx bench ray-integral: the integration alone of a picture of 270 overlapping blobs in a ball whose diameter
// is the picture's width: blobs of every ray are found beforehand. One JSON object a case: scheme, optical
// depth, processor time of one thread (the least of N interleaved runs) a frame, a ray and a blob that a ray
// meets, its ratio to the default scheme in the same run, the wall time on two threads, work counters, and a
// hash of the picture. The packets of a picture are 20 MB: they stream through the caches as they do in a
// renderer.
//
// Then, for the default and the high scheme, ray marching at equal error: the longest step, within 5 %, whose
// 99th percentile of the relative error (against reference_integral.h, on every 37th packet) is no larger,
// both in double, since sums of many small steps in float never get there; the ratio of the two times. Where
// even steps of 0.1 mm do not reach it, the ratio is a lower bound.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "foundation/math/hash.h"
#include "foundation/simd/instruction_set.h"
#include "foundation/tasks/task_runner.h"
#include "fxsdk/cli/support/json_line.h"
#include "rendering/reference/integral/accuracy_cases.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    int repeat = 7;
    uint32_t width = 480, height = 300; ///< [pixel] rounded down to multiples of 4
    uint64_t validate = 0;              ///< 0: nothing
    bool isSmall = false;
};

const Machine& machine()
{
    static const Machine read = readMachine();
    return read;
}

struct Variant
{
    std::string name;
    render::IntegralSettings settings;
    double seconds = 1e30; ///< of one thread
    double wall = 1e30;    ///< [s] on two
};

/// Packets in chunks over two threads, each with an integrator of its own.
double twoThreads(const render::PacketPicture<float>& picture, const render::IntegralSettings& settings,
                  base::TaskRunner& tasks, std::vector<render::PacketLight<float>>& lights)
{
    const auto begin = std::chrono::steady_clock::now();
    constexpr uint32_t kChunk = 64;
    tasks.parallelFor(
        uint32_t(picture.packets() + kChunk - 1) / kChunk, 1, [&](uint32_t first, uint32_t last) {
            render::PacketIntegrator<float> integrator(settings);
            picture.integrate(integrator, first * kChunk, std::min<size_t>(last * kChunk, picture.packets()),
                              lights.data());
        });
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

uint64_t run(const Options& options, double depth)
{
    const render::PacketPicture<float> picture =
        render::ballOfBlobs<float>(depth, options.width, options.height);
    std::vector<render::PacketLight<float>> lights(picture.packets());
    std::vector<Variant> variants;
    for (const char* name :
         {"gauss-5", "gauss-8", "gauss-3", "paper-1", "paper-4", "simpson-4", "march-0.01"})
        variants.push_back({name, {*render::parseScheme(name), render::SourceModel::PerBlob, 2}});
    const std::unique_ptr<base::TaskRunner> tasks = base::makeTbbRunner(2);
    for (int repeat = 0; repeat < options.repeat; ++repeat)
        for (Variant& variant : variants) {
            render::PacketIntegrator<float> integrator(variant.settings);
            const double begin = threadSeconds();
            picture.integrate(integrator, 0, picture.packets(), lights.data());
            variant.seconds = std::min(variant.seconds, threadSeconds() - begin);
            variant.wall = std::min(variant.wall, twoThreads(picture, variant.settings, *tasks, lights));
        }
    uint64_t all = 0;
    for (const Variant& variant : variants) {
        render::PacketIntegrator<float> integrator(variant.settings);
        integrator.countWork(true);
        picture.integrate(integrator, 0, picture.packets(), lights.data());
        const render::RayWork& work = integrator.work();
        uint64_t hash = 0;
        for (const render::PacketLight<float>& light : lights)
            hash = base::hashBytes(hash, light.radiance, sizeof(light.radiance));
        all = base::hashWord(all, hash);
        printJsonLine(
            withMachine({{"name", "ray_integral"},
                         {"variant", variant.name},
                         {"simd", base::instructionSetName(base::instructionSet())},
                         {"tau", depth},
                         {"ms_per_frame_one_thread", variant.seconds * 1e3},
                         {"ms_per_frame_two_threads", variant.wall * 1e3},
                         {"ns_per_ray", variant.seconds * 1e9 / double(work.rays)},
                         {"ns_per_hit", variant.seconds * 1e9 / double(work.hits)},
                         {"ratio_to_default", variant.seconds / variants.front().seconds},
                         {"rays", work.rays},
                         {"hits", work.hits},
                         {"intervals", work.intervals},
                         {"parts", work.parts},
                         {"blobs_per_interval",
                          work.intervals > 0 ? double(work.blobSums) / double(work.intervals) : 0.0},
                         {"nodes", work.nodes},
                         {"hash", hashText(hash)}},
                        machine()));
    }
    return all;
}

double secondsOf(const Options& options, const render::PacketPicture<double>& picture,
                 const render::IntegralSettings& settings)
{
    std::vector<render::PacketLight<double>> lights(picture.packets());
    render::PacketIntegrator<double> integrator(settings);
    double least = 1e30;
    for (int repeat = 0; repeat < options.repeat; ++repeat) {
        const double begin = threadSeconds();
        picture.integrate(integrator, 0, picture.packets(), lights.data());
        least = std::min(least, threadSeconds() - begin);
    }
    return least;
}

void runMarching(const Options& options, double depth)
{
    constexpr uint32_t kEvery = 37;
    constexpr double kFinest = 1e-4; // [m]
    const auto picture = render::ballOfBlobs<double>(depth, options.width, options.height, kEvery);
    const auto reference = render::referenceLight(picture, {});
    for (const char* name : {"gauss-5", "gauss-8"}) {
        const render::IntegralSettings own{*render::parseScheme(name), render::SourceModel::PerBlob, 2};
        const double wanted = render::integralError(picture, own, reference).p99;
        render::IntegralSettings march{*render::parseScheme("march-0.02"), render::SourceModel::PerBlob, 2};
        double reached = render::integralError(picture, march, reference).p99;
        while (reached > wanted && march.scheme.step > kFinest) {
            march.scheme.step *= 0.5;
            reached = render::integralError(picture, march, reference).p99;
        }
        for (bool isLonger = reached <= wanted; isLonger;) {
            render::IntegralSettings longer = march;
            longer.scheme.step *= 1.05;
            const double error = render::integralError(picture, longer, reference).p99;
            isLonger = error <= wanted;
            if (isLonger) {
                march = longer;
                reached = error;
            }
        }
        const double ratio = secondsOf(options, picture, march) / secondsOf(options, picture, own);
        printJsonLine(withMachine({{"name", "marching_at_equal_error"},
                                   {"variant", name},
                                   {"precision", "double"},
                                   {"tau", depth},
                                   {"error_p99", wanted},
                                   {"march_step", march.scheme.step},
                                   {"march_error_p99", reached},
                                   {"march_reaches_it", reached <= wanted},
                                   {"time_ratio", ratio}},
                                  machine()));
    }
}

void measure(Options options)
{
    if (options.isSmall)
        options.width = 32, options.height = 16, options.repeat = 1;
    options.width = std::max(options.width / 4, 1u) * 4;
    options.height = std::max(options.height / 4, 1u) * 4;
    uint64_t hash = 0;
    for (const double depth : {0.1, 1.0, 10.0, 100.0}) {
        hash = base::hashWord(hash, run(options, depth));
        runMarching(options, depth);
    }
    if (options.validate != 0 && hash != options.validate)
        fail("the pictures differ from those of --validate-hash");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--repeat", options->repeat, "Interleaved runs of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--width", options->width, "[pixel] Of the picture")->check(CLI::Range(1u, 16'384u));
    command.add_option("--height", options->height, "[pixel] Of the picture")->check(CLI::Range(1u, 16'384u));
    addHashOption(command, options->validate);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement rayIntegralBench()
{
    return {"ray-integral",
            "The light of 270 overlapping blobs: time of every scheme, and of ray marching at equal error",
            addOptions};
}

} // namespace fx::cli
