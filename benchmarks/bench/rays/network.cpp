// fx bench network: what a sweep of an illumination network costs on the processor: a cloud of lumps of
// optical depth 20, over cells, directions and moments. Prints one JSON object a case: milliseconds to take
// over a medium and of a sweep, of one color, and the sweeps from black until the scattered light changes by
// less than 1 %, with and without acceleration. Fails when other numbers of workers give other bits.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/lumpy_cloud.h"
#include "foundation/math/hash.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
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
