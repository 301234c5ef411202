// fx bench parallel-loop: from how much work on a loop is worth other threads. A loop of two parts is run by
// one thread and by T, in turn, each time after a pause in which the others fall asleep, as they do between
// the frames of a game. Prints one JSON object for each amount of work, 10 us to 30 ms: microseconds of the
// loop on one thread, and what T threads take of that time; then what offering the loop cost where it brought
// nothing, the least amount of work, and the amount from which on T threads take less: the break-even, -1 if
// there is none. See simulation/particles/rows_of_a_task.h.
// --small: three repeats after short pauses.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "foundation/tasks/task_runner.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint64_t kMinSteps = 1 << 13; // about 10 us
constexpr uint64_t kMaxSteps = 1 << 25; // about 30 ms

struct Options
{
    uint32_t threads = 2;
    int pause = 4; ///< [ms]
    int repeats = 40;
    bool isSmall = false;
};

/// A chain of operations, so that its time follows the number of steps.
uint64_t work(uint64_t steps, uint64_t x)
{
    for (uint64_t i = 0; i < steps; ++i)
        x = x * 6364136223846793005u + 1442695040888963407u;
    return x;
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// [us] of a loop of two parts with so many steps in all.
double timeLoop(base::TaskRunner& tasks, uint64_t steps, uint64_t& ioSum)
{
    uint64_t sums[2] = {};
    const auto start = Clock::now();
    tasks.parallelFor(2, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t part = begin; part < end; ++part)
            sums[part] = work(steps / 2, part);
    });
    const double microseconds = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    ioSum += sums[0] ^ sums[1];
    return microseconds;
}

void measure(Options options)
{
    if (options.isSmall)
        options.pause = 1, options.repeats = 3;
    const auto one = base::makeSerialRunner();
    const auto many = base::makeTbbRunner(options.threads);
    const Machine machine = readMachine();
    uint64_t sum = 0;
    double breakEven = -1, offer = 0;
    for (uint64_t steps = kMinSteps; steps <= kMaxSteps; steps += steps / 2) {
        std::vector<double> serial, parallel;
        for (int i = 0; i < options.repeats; ++i) {
            for (const bool isParallel : {false, true}) {
                std::this_thread::sleep_for(std::chrono::milliseconds(options.pause));
                (isParallel ? parallel : serial).push_back(timeLoop(isParallel ? *many : *one, steps, sum));
            }
        }
        const double alone = median(serial), together = median(parallel);
        if (steps == kMinSteps)
            offer = together - alone;
        if (together >= alone)
            breakEven = -1;
        else if (breakEven < 0)
            breakEven = alone;
        printJsonLine(withMachine({{"name", "parallel_loop"},
                                   {"threads", options.threads},
                                   {"us_one_thread", alone},
                                   {"us_threads", together},
                                   {"share", together / alone}},
                                  machine));
    }
    printJsonLine(withMachine({{"name", "parallel_loop"},
                               {"variant", "break-even"},
                               {"us_offer", offer},
                               {"us_one_thread", breakEven}},
                              machine));
    if (sum == 0)
        fail("the loops did nothing");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--threads", options->threads, "Threads")->check(CLI::Range(2u, 256u));
    command.add_option("--pause", options->pause, "[ms] Before each loop")->check(CLI::Range(0, 100));
    command.add_option("--repeats", options->repeats, "Loops of which the median time is taken")
        ->check(CLI::Range(3, 10'000));
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement parallelLoopBench()
{
    return {"parallel-loop", "From how much work on a loop is worth other threads", addOptions};
}

} // namespace fx::cli
