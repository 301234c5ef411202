// fx bench network: what a sweep of an illumination network costs on the processor: a cloud of lumps of
// optical depth 20, over cells, directions and moments. Prints one JSON object a case: milliseconds to take
// over a medium and of a sweep, of one color, and the sweeps from black until the scattered light changes by
// less than 1 %, with and without acceleration. Fails when other numbers of workers give other bits. Then, a
// line for each number of cells: frames after a jump from a lamp inside to the sun until light is within 1 %
// of its rest, and how far it is from it in the frames of an explosion, with 1 and 2 sweeps a frame.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/lumpy_cloud.h"
#include "foundation/math/hash.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    int repeat = 5;
    uint32_t threads = 1;
    double albedo = 0.9;
    bool isSmall = false;
};

/// [ms] of the fastest of some calls.
template <class F>
double fastest(int repeat, F&& f)
{
    double least = 1e30;
    for (int i = 0; i < repeat; ++i) {
        const auto start = std::chrono::steady_clock::now();
        f();
        least = std::min(
            least,
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    return least;
}

uint64_t hashOf(const render::NetworkState& state)
{
    return base::hashBytes(1, state.light.data(), state.light.size() * sizeof(float));
}

void measureCase(const LumpyCloud& cloud, const CloudNetwork& form, const Options& options)
{
    const auto tasks = base::makeTbbRunner(options.threads), alone = base::makeSerialRunner();
    render::ScatteringNetwork network;
    double msMedium = 1e30;
    {
        const render::NetworkGrid grid{glm::dvec3(0.0), 1.0, glm::ivec3(form.cells)};
        const std::vector<float> extinction(grid.count(), 0.3f), albedo(grid.count(), float(form.albedo));
        msMedium = fastest(options.repeat, [&] {
            (void)network.setMedium({grid, extinction, albedo, {}}, form.settings);
        });
    }
    const auto sweepsTo = [&](int acceleration, render::NetworkState& state, base::TaskRunner& runner) {
        if (const base::Status status = give(cloud, form, network); !status)
            fail(status.message());
        return network.sweep({500, acceleration, 0.01}, state, runner).sweeps;
    };
    render::NetworkState plain, mixed, again;
    const int sweepsPlain = sweepsTo(0, plain, *tasks), sweepsMixed = sweepsTo(2, mixed, *tasks);
    sweepsTo(2, again, *alone);
    if (hashOf(mixed) != hashOf(again))
        fail("another number of workers gives other light");
    const double ms = fastest(options.repeat, [&] { network.sweep({1, 0, 0.0}, plain, *tasks); });
    printJsonLine({{"name", "network"},
                   {"cells", form.cells},
                   {"directions", form.settings.directions},
                   {"moments", form.settings.moments},
                   {"threads", options.threads},
                   {"albedo", form.albedo},
                   {"ms_medium", msMedium},
                   {"ms_sweep", ms},
                   {"sweeps_plain", sweepsPlain},
                   {"sweeps_accelerated", sweepsMixed},
                   {"bytes", mixed.light.size() * sizeof(float)},
                   {"hash", hashText(hashOf(mixed))}});
}

constexpr render::SweepRules kToRest{500, 2, 1e-4};

/// [1] root mean square difference relative to the root mean square of `rest`.
double differenceTo(const render::NetworkState& rest, const render::NetworkState& state)
{
    double squares = 0.0, all = 0.0;
    for (size_t i = 0; i < rest.light.size(); ++i) {
        const double difference = double(state.light[i]) - double(rest.light[i]);
        squares += difference * difference;
        all += double(rest.light[i]) * double(rest.light[i]);
    }
    return std::sqrt(squares / std::max(all, 1e-300));
}

void giveOrFail(const LumpyCloud& cloud, const CloudNetwork& form, render::ScatteringNetwork& outNetwork)
{
    if (const base::Status status = give(cloud, form, outNetwork); !status)
        fail(status.message());
}

/// Light at rest in the medium that the network has, from any start.
render::NetworkState restOf(render::ScatteringNetwork& network, render::NetworkState start)
{
    const auto tasks = base::makeSerialRunner();
    network.sweep(kToRest, start, *tasks);
    return start;
}

/// Frames of so many sweeps after one light has gone out and another has come until light is within 1 % of
/// its rest; -1: more than 100.
int framesAfterJump(const LumpyCloud& before, const LumpyCloud& after, const CloudNetwork& form, int sweeps)
{
    const auto tasks = base::makeSerialRunner();
    render::ScatteringNetwork network;
    giveOrFail(before, form, network);
    render::NetworkState light = restOf(network, {});
    giveOrFail(after, form, network);
    const render::NetworkState rest = restOf(network, light);
    for (int frame = 1; frame <= 100; ++frame) {
        network.sweep({sweeps, 0, 0.0}, light, *tasks);
        if (differenceTo(rest, light) <= 0.01)
            return frame;
    }
    return -1;
}

/// [1] differences of light that follows the frames of an explosion, to its rest in each of them. The lumps
/// begin in darkness at 0.3 of their distances; the first half of the way takes a fifth of the time.
std::vector<double> differencesOfFrames(const std::vector<LumpyCloud>& frames, const CloudNetwork& form,
                                        int sweeps)
{
    const auto tasks = base::makeSerialRunner();
    render::ScatteringNetwork network;
    render::NetworkState light;
    std::vector<double> differences;
    for (const LumpyCloud& frame : frames) {
        giveOrFail(frame, form, network);
        network.sweep({sweeps, 0, 0.0}, light, *tasks);
        differences.push_back(differenceTo(restOf(network, light), light));
    }
    return differences;
}

double meanOf(std::span<const double> values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

void measureMotion(const std::vector<int>& sizes, const Options& options)
{
    const int fine = options.isSmall ? 32 : 64, count = options.isSmall ? 12 : 60;
    const LumpyCloud side(20.0, CloudLight::Side, fine), inside(20.0, CloudLight::Inside, fine);
    std::vector<LumpyCloud> frames;
    for (int i = 0; i < count; ++i)
        frames.emplace_back(20.0, CloudLight::Side, fine,
                            1.0 - 0.7 * std::exp(-std::log(2.0) * 5.0 * i / double(count)));
    for (const int cells : sizes)
        for (const int sweeps : {1, 2}) {
            const CloudNetwork form{cells, {26, 4, 0.5}, options.albedo};
            const std::vector<double> differences = differencesOfFrames(frames, form, sweeps);
            const std::span<const double> all(differences), followed = all.subspan(all.size() / 6);
            printJsonLine({{"name", "network-motion"},
                           {"cells", cells},
                           {"sweeps", sweeps},
                           {"albedo", options.albedo},
                           {"frames_after_jump", framesAfterJump(inside, side, form, sweeps)},
                           {"difference_mean", meanOf(followed)},
                           {"difference_most", *std::ranges::max_element(followed)},
                           {"difference_last", all.back()},
                           {"differences", differences}});
        }
}

void measure(Options options)
{
    if (options.isSmall)
        options.repeat = 1;
    const LumpyCloud cloud(20.0, CloudLight::Side, options.isSmall ? 32 : 96);
    std::vector<int> sizes{24, 32, 48};
    if (options.isSmall)
        sizes = {8};
    for (const int cells : sizes)
        for (const auto& [directions, moments] : {std::pair(14, 4), {26, 4}, {26, 9}})
            measureCase(cloud, {cells, {directions, moments, 0.5}, options.albedo}, options);
    measureMotion(sizes, options);
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--repeat", options->repeat, "Sweeps of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--threads", options->threads, "Workers; 0: as many as the machine has");
    command.add_option("--albedo", options->albedo, "[1] Of the cloud")->check(CLI::Range(0.0, 1.0));
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement networkBench()
{
    return {"network", "Milliseconds of a sweep of an illumination network, and sweeps until its light rests",
            addOptions};
}

} // namespace fx::cli
