/// @file bench_command.cpp
/// fx bench: measurements of the running product, one subcommand each.

#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/particles/particles_plot.h"
#include "fxsdk/cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace fx::cli {

void addBenchCommand(CLI::App& app, int& outExitCode)
{
    CLI::App* bench = app.add_subcommand("bench", "Measure what effects cost on this machine");
    auto plot = std::make_shared<std::string>();
    auto threads = std::make_shared<uint32_t>(1);
    CLI::Option* drawn =
        bench->add_option("--plot", *plot, "Draw the time of a step against the number of particles (SVG)");
    CLI::Option* onThreads = bench->add_option("--threads", *threads, "With --plot; 0 for all of the machine")
                                 ->check(CLI::Range(0u, 1024u))
                                 ->needs(drawn);
    auto most = std::make_shared<uint64_t>(10'000'000);
    CLI::Option* upTo = bench->add_option("--most", *most, "With --plot; the largest number of particles")
                            ->check(CLI::Range(uint64_t(1000), uint64_t(10'000'000)))
                            ->needs(drawn)
                            ->capture_default_str();
    bench->require_subcommand(0, 1);
    bench->callback([bench, drawn, plot, threads, most, &outExitCode] {
        if (!bench->get_subcommands().empty())
            return;
        if (drawn->count() == 0)
            throw CLI::RequiredError("A subcommand or --plot");
        outExitCode = runBenchPlot(*plot, *threads, *most);
    });
    for (const BenchMeasurement& measurement : benchMeasurements())
        measurement.addOptions(*bench->add_subcommand(measurement.name, measurement.summary), outExitCode);
    for (CLI::App* command : bench->get_subcommands({})) {
        command->excludes(drawn);
        command->excludes(onThreads);
        command->excludes(upTo);
    }
}

} // namespace fx::cli
