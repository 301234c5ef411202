// fx bench explosion: the gas of the library's explosion alone, as a game steps it: 60 steps a second. Prints
// one JSON object: simulated seconds a second of wall time, over all and over the worst of its seconds, the
// work behind them, what the cloud looks like at the end, and how far apart its particles stay. --sound:
// `preset` limits the speed of sound as the preset says, `mach` only by the quality's Mach number, `full` not
// at all.
// --small: 500 particles for a second.
//
// --start: the first second instead, nine times, of which the least time of each update counts: the largest
// update against the median one, in milliseconds and in sub-steps, and what it takes to make the solver.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/explosion_run.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/named_choice.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Options
{
    uint32_t particles = 10'000;
    int seconds = 4;
    uint32_t threads = 2;
    std::string sound = "preset";
    bool start = false;
    bool isSmall = false;
};

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

ExplosionSetting settingOf(const Options& options)
{
    ExplosionSetting setting{options.particles};
    if (options.sound != "preset")
        setting.soundSpeed = 0;
    if (options.sound == "full")
        setting.flowMach = 0;
    return setting;
}

/// The updates of the first second.
void measureStart(const Options& options, base::TaskRunner& tasks)
{
    constexpr int kRepeats = 9;
    std::vector<double> least(kExplosionFrames, 1e30);   // [s]
    std::vector<uint64_t> subSteps(kExplosionFrames, 0); // the same each time
    double made = 1e30;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        const auto begin = Clock::now();
        const auto run = ExplosionRun::create(settingOf(options), tasks);
        if (!run)
            fail(run.status().message());
        made = std::min(made, secondsSince(begin));
        for (size_t frame = 0; frame < least.size(); ++frame) {
            const uint64_t before = (*run)->counters().subSteps;
            const auto start = Clock::now();
            (*run)->step();
            least[frame] = std::min(least[frame], secondsSince(start));
            subSteps[frame] = (*run)->counters().subSteps - before;
        }
    }
    const auto largest = size_t(std::max_element(least.begin(), least.end()) - least.begin());
    const uint64_t stepsOfLargest = subSteps[largest];
    const double longest = least[largest];
    std::nth_element(least.begin(), least.begin() + ptrdiff_t(least.size() / 2), least.end());
    std::nth_element(subSteps.begin(), subSteps.begin() + ptrdiff_t(subSteps.size() / 2), subSteps.end());
    printJsonLine(withMachine({{"name", "explosion"},
                               {"variant", "start"},
                               {"count", options.particles},
                               {"threads", options.threads},
                               {"ms_made", 1e3 * made},
                               {"largest_update", largest},
                               {"ms_largest", 1e3 * longest},
                               {"ms_median", 1e3 * least[least.size() / 2]},
                               {"sub_steps_largest", stepsOfLargest},
                               {"sub_steps_median", subSteps[subSteps.size() / 2]}},
                              readMachine()));
}

void measure(Options options)
{
    if (options.isSmall)
        options.particles = 500, options.seconds = 1;
    const auto tasks = base::makeTbbRunner(options.threads);
    if (options.start) {
        measureStart(options, *tasks);
        return;
    }
    const auto run = ExplosionRun::create(settingOf(options), *tasks);
    if (!run)
        fail(run.status().message());

    double wall = 0, worst = 0, cpu = 0;
    for (int second = 0; second < options.seconds; ++second) {
        const auto begin = Clock::now();
        const std::clock_t before = std::clock();
        for (int frame = 0; frame < kExplosionFrames; ++frame)
            (*run)->step();
        const double spent = secondsSince(begin);
        const double worked = double(std::clock() - before) / CLOCKS_PER_SEC;
        wall += spent;
        cpu += worked;
        worst = std::max(worst, spent);
        std::fprintf(stderr, "second %d: %.2f s, processors %.2f s, nearest neighbor at %.2f spacings\n",
                     second + 1, spent, worked, (*run)->nearestOverSpacing());
    }
    const ExplosionState cloud = (*run)->look();
    const sim::StepCounters& sum = (*run)->counters();
    printJsonLine(
        withMachine({{"name", "explosion"},
                     {"variant", options.sound},
                     {"count", options.particles},
                     {"threads", options.threads},
                     {"simulated_s", options.seconds},
                     {"wall_s", wall},
                     {"cpu_s", cpu},
                     {"simulated_per_second", options.seconds / wall},
                     {"worst_second_per_second", 1.0 / worst},
                     {"sub_steps", sum.subSteps},
                     {"particle_steps", sum.particleSteps},
                     {"ns_per_particle_step", 1e9 * wall / double(sum.particleSteps)},
                     {"pairs_per_particle_step", double(sum.neighborPairs) / double(sum.particleSteps)},
                     {"height_m", cloud.height},
                     {"radius_m", cloud.radius},
                     {"temperature_K", cloud.temperature},
                     {"nearest_over_spacing", (*run)->nearestOverSpacing()},
                     {"debt_s", base::toSeconds(sum.debt)},
                     {"clamped", sum.clamped}},
                    readMachine()));
    if (sum.particleSteps < uint64_t(options.particles) * kExplosionFrames * uint64_t(options.seconds))
        fail("the gas was not stepped to the end");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--particles", options->particles, "Of the gas")->check(CLI::Range(8u, 20'000u));
    command.add_option("--seconds", options->seconds, "Simulated")->check(CLI::Range(1, 60));
    command.add_option("--threads", options->threads, "Threads")->check(CLI::Range(1u, 256u));
    command.add_option("--sound", options->sound, "Limit on the speed of sound: preset, mach or full (none)")
        ->check(oneOf({"preset", "mach", "full"}));
    command.add_flag("--start", options->start, "The updates of the first second instead, nine times");
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement explosionBench()
{
    return {"explosion",
            "The gas of the library's explosion: simulated seconds a second, and the largest updates of its "
            "start",
            addOptions};
}

} // namespace fx::cli
