// fx bench pair-loops: times the sums over neighbors of a jittered periodic lattice of N^3 particles that
// stand in the order of the tree: density with its search for the support, and forces. One thread, CPU time
// of the fastest of `repeat` runs, instruction sets interleaved (or only the widest). Supports start 1 %
// beside their solution, as a time step leaves them. Prints one JSON object per case. The hash of all results
// must be the same for every instruction set. `share_of_flops` compares the operations with what the same
// instruction set does at most in multiplications and additions that are not fused, `share_of_reading` the
// records read with what one thread reads from 1 MiB of memory nearby, both measured at the end.
// --small: 12^3 particles once.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/bench/gas/machine_peak.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/gas_stage.h"
#include "foundation/math/hash.h"
#include "foundation/simd/instruction_set.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

namespace fx::cli {
namespace {

struct Options
{
    uint32_t size = 32;
    uint32_t repeat = 7;
    double neighbors = 58;
    double reach = 0.05;
    bool onlyWidest = false;
    uint64_t validateHash = 0; ///< 0: nothing
    bool isSmall = false;
};

template <class T>
uint64_t hashOf(uint64_t hash, const std::vector<T>& column)
{
    return base::hashBytes(hash, column.data(), column.size() * sizeof(T));
}

/// What one kind of sum has taken and given.
struct Case
{
    double seconds = 1e30;
    uint64_t hash = 0;
    uint64_t pairs = 0; ///< neighbors that contributed
};

/// Operations of one pair in one evaluation, counted in the text; roots and divisions count as one.
constexpr double kMassFlops = 20;
constexpr double kAllFlops = 75;
constexpr double kForceFlops = 110;
/// [1] Numbers of a neighbor's record that are read once: position, support, velocity, mass; all of it.
constexpr double kDensityNumbers = 8;
constexpr double kForceNumbers = 16;

template <class T>
Case timeDensity(const bench::GasStage<T>& stage, const Options& options)
{
    sim::DensityRules rules;
    rules.neighbors = options.neighbors;
    bench::Densities<T> at = stage.template sized<bench::Densities<T>>();
    const bench::Densities<T> solved = stage.densities(rules, 1.0);
    at.support = solved.support;
    stage.sumDensity(rules, options.reach, at); // now by place
    const std::vector<T> solution = at.support;
    for (uint32_t i = 0; i < stage.count(); ++i)
        at.support[i] = solution[i] * T(0.99 + 0.02 * bench::chance(9, i, 0));
    Case result;
    const double start = threadSeconds();
    stage.sumDensity(rules, options.reach, at);
    result.seconds = threadSeconds() - start;
    for (const auto* column : {&at.support, &at.density, &at.correction, &at.divergence, &at.curl})
        result.hash = hashOf(result.hash, *column);
    result.hash = hashOf(result.hash, at.neighbors);
    for (const uint32_t n : at.neighbors)
        result.pairs += n;
    return result;
}

template <class T>
Case timeForces(const bench::GasStage<T>& stage)
{
    bench::Forces<T> at = stage.template sized<bench::Forces<T>>();
    Case result;
    const double start = threadSeconds();
    stage.sumForces({}, at);
    result.seconds = threadSeconds() - start;
    for (const auto* column : {&at.ax, &at.ay, &at.az, &at.heating, &at.signalSpeed, &at.fastestNeighbor})
        result.hash = hashOf(result.hash, *column);
    for (const uint32_t n : at.pairs)
        result.pairs += n;
    return result;
}

const Machine& machine()
{
    static const Machine read = readMachine();
    return read;
}

/// What a loop does for each entry of a list, and what the machine can do at most.
struct Work
{
    double flops;     ///< [1]
    double bytes;     ///< [B]
    double peakFlops; ///< [1/s]
    double peakBytes; ///< [B/s]
};

void print(const char* name, const char* precision, base::InstructionSet set, const Options& options,
           const Case& c, double entries, const Work& work)
{
    const double particles = double(options.size) * options.size * options.size;
    printJsonLine(
        withMachine({{"name", name},
                     {"variant", std::string(precision) + "." + std::string(base::instructionSetName(set))},
                     {"particles", uint64_t(particles)},
                     {"threads", 1},
                     {"repeat", options.repeat},
                     {"ns_per_particle", 1e9 * c.seconds / particles},
                     {"ns_per_pair", 1e9 * c.seconds / double(c.pairs)},
                     {"pairs_per_particle", double(c.pairs) / particles},
                     {"entries_per_particle", entries / particles},
                     {"gflops", 1e-9 * work.flops * entries / c.seconds},
                     {"gflops_at_most", 1e-9 * work.peakFlops},
                     {"share_of_flops", work.flops * entries / c.seconds / work.peakFlops},
                     {"bytes_per_entry", work.bytes},
                     {"share_of_reading", work.bytes * entries / c.seconds / work.peakBytes},
                     {"hash", hashText(c.hash)}},
                    machine()));
}

/// Runs all instruction sets of one precision. False when their results differ.
template <class T>
bool runPrecision(const char* precision, const Options& options, uint64_t& ioHash)
{
    bench::Gas gas = bench::latticeGas(options.size, 0.3, options.neighbors);
    bench::stir(gas);
    const bench::GasStage<T> stage(gas, bench::unitBox(sim::AxisKind::Periodic), options.reach);
    const base::InstructionSet widest = base::instructionSet();
    const uint32_t first = options.onlyWidest ? uint32_t(widest) : 0;
    std::array<Case, 4> density, forces;
    for (uint32_t run = 0; run < options.repeat; ++run) {
        for (uint32_t set = first; set <= uint32_t(widest); ++set) {
            base::limitInstructionSet(base::InstructionSet(set));
            const Case d = timeDensity(stage, options), f = timeForces(stage);
            density[set] = d.seconds < density[set].seconds ? d : density[set];
            forces[set] = f.seconds < forces[set].seconds ? f : forces[set];
        }
    }
    bool isSame = true;
    const double entries = double(stage.entries());
    for (uint32_t set = first; set <= uint32_t(widest); ++set) {
        base::limitInstructionSet(base::InstructionSet(set));
        const MachinePeak peak = measureMachinePeak();
        const double flops = sizeof(T) == sizeof(float) ? peak.floatFlops : peak.doubleFlops;
        print("pair_loops.density", precision, base::InstructionSet(set), options, density[set], entries,
              {kMassFlops + kAllFlops, kDensityNumbers * sizeof(T), flops, peak.nearBytes});
        print("pair_loops.forces", precision, base::InstructionSet(set), options, forces[set], entries,
              {kForceFlops, kForceNumbers * sizeof(T), flops, peak.nearBytes});
        isSame = isSame && density[set].hash == density[first].hash && forces[set].hash == forces[first].hash;
    }
    base::limitInstructionSet(widest);
    ioHash = base::hashWord(base::hashWord(ioHash, density[first].hash), forces[first].hash);
    return isSame;
}

void measure(Options options)
{
    if (options.isSmall)
        options.size = 12, options.repeat = 1;
    machine(); // before the instruction sets are limited
    uint64_t hash = 0;
    const bool sameFloats = runPrecision<float>("float", options, hash);
    const bool isSame = runPrecision<double>("double", options, hash) && sameFloats;
    if (!isSame)
        fail("instruction sets differ in their results");
    if (options.validateHash != 0 && options.validateHash != hash)
        fail("hash is " + hashText(hash));
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--size", options->size, "Particles along an edge")->check(CLI::Range(4u, 256u));
    command.add_option("--repeat", options->repeat, "Runs of which the least time is taken")
        ->check(CLI::Range(1u, 1'000'000u));
    command.add_option("--neighbors", options->neighbors, "4/3 pi n H^3, the neighbors within the support")
        ->check(CLI::Range(1.0, 1000.0));
    command.add_option("--reach", options->reach, "[1] Lists reach so much farther than supports")
        ->check(CLI::Range(0.0, 10.0));
    command.add_flag("--widest", options->onlyWidest, "Only the widest instruction set");
    addHashOption(command, options->validateHash);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement pairLoopsBench()
{
    return {"pair-loops",
            "Density and forces of a gas: nanoseconds a particle and a pair for every instruction set",
            addOptions};
}

} // namespace fx::cli
