// bench_explosion [--particles=N] [--seconds=S] [--threads=T] [--sound=preset|mach|full] [--start] [--small]
//
// The gas of the library's explosion alone, as a game steps it: 60 steps a second. Prints one JSON object:
// simulated seconds a second of wall time, over all and over the worst of its seconds, the work behind them,
// what the cloud looks like at the end, and how far apart its particles stay. --sound: `preset` limits the
// speed of sound as the preset says, `mach` only by the quality's Mach number, `full` not at all.
// --small: 500 particles for a second, to see that the program works.
//
// --start: the first second instead, nine times, of which the least time of each update counts: the largest
// update against the median one, in milliseconds and in sub-steps, and what it takes to make the solver.
#include "benchmarks/bench_failure.h"
#include "benchmarks/scenes/explosion_run.h"
#include "fxsdk/cli/support/json_line.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace fx;
using bench::fail;
using Clock = std::chrono::steady_clock;

struct Options
{
    uint32_t particles = 10'000;
    int seconds = 4;
    uint32_t threads = 2;
    std::string sound = "preset";
    bool start = false;
};

Options parse(int argc, char** argv)
{
    Options options;
    for (int i = 1; i < argc; ++i) {
        const std::string_view a = argv[i];
        if (a.starts_with("--particles="))
            options.particles = uint32_t(std::clamp(std::atoi(a.data() + 12), 8, 20'000));
        else if (a.starts_with("--seconds="))
            options.seconds = std::clamp(std::atoi(a.data() + 10), 1, 60);
        else if (a.starts_with("--threads="))
            options.threads = uint32_t(std::clamp(std::atoi(a.data() + 10), 1, 256));
        else if (a == "--sound=preset" || a == "--sound=mach" || a == "--sound=full")
            options.sound = a.substr(8);
        else if (a == "--small")
            options.particles = 500, options.seconds = 1;
        else if (a == "--start")
            options.start = true;
        else
            fail("usage: bench_explosion [--particles=8..20000] [--seconds=1..60] [--threads=N] "
                 "[--sound=preset|mach|full] [--start] [--small]");
    }
    return options;
}

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

cli::ExplosionSetting settingOf(const Options& options)
{
    cli::ExplosionSetting setting{options.particles};
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
    std::vector<double> least(cli::kExplosionFrames, 1e30);   // [s]
    std::vector<uint64_t> subSteps(cli::kExplosionFrames, 0); // the same each time
    double made = 1e30;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        const auto begin = Clock::now();
        const auto run = cli::ExplosionRun::create(settingOf(options), tasks);
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
    cli::printJsonLine(cli::withMachine({{"name", "explosion"},
                                         {"variant", "start"},
                                         {"count", options.particles},
                                         {"threads", options.threads},
                                         {"ms_made", 1e3 * made},
                                         {"largest_update", largest},
                                         {"ms_largest", 1e3 * longest},
                                         {"ms_median", 1e3 * least[least.size() / 2]},
                                         {"sub_steps_largest", stepsOfLargest},
                                         {"sub_steps_median", subSteps[subSteps.size() / 2]}},
                                        cli::readMachine()));
}

} // namespace

int main(int argc, char** argv)
{
    const Options options = parse(argc, argv);
    const auto tasks = base::makeTbbRunner(options.threads);
    if (options.start) {
        measureStart(options, *tasks);
        return 0;
    }
    const auto run = cli::ExplosionRun::create(settingOf(options), *tasks);
    if (!run)
        fail(run.status().message());

    double wall = 0, worst = 0, cpu = 0;
    for (int second = 0; second < options.seconds; ++second) {
        const auto begin = Clock::now();
        const std::clock_t before = std::clock();
        for (int frame = 0; frame < cli::kExplosionFrames; ++frame)
            (*run)->step();
        const double spent = secondsSince(begin);
        const double worked = double(std::clock() - before) / CLOCKS_PER_SEC;
        wall += spent;
        cpu += worked;
        worst = std::max(worst, spent);
        std::fprintf(stderr, "second %d: %.2f s, processors %.2f s, nearest neighbor at %.2f spacings\n",
                     second + 1, spent, worked, (*run)->nearestOverSpacing());
    }
    const cli::ExplosionState cloud = (*run)->look();
    const sim::StepCounters& sum = (*run)->counters();
    cli::printJsonLine(
        cli::withMachine({{"name", "explosion"},
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
                         cli::readMachine()));
    if (sum.particleSteps < uint64_t(options.particles) * cli::kExplosionFrames * uint64_t(options.seconds))
        fail("the gas was not stepped to the end");
    return 0;
}
