/// @file bench_command.cpp
/// fx bench: measurements of the running product, one subcommand each.

#include "fxsdk/cli/bench_command.h"

#include "fxsdk/cli/bench_budget.h"
#include "fxsdk/cli/bench_city.h"
#include "fxsdk/cli/bench_idle.h"
#include "fxsdk/cli/bench_lod.h"
#include "fxsdk/cli/bench_plot.h"
#include "fxsdk/cli/bench_soak.h"
#include "fxsdk/cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace fx::cli {
namespace {

void addIdle(CLI::App& bench, int& outExitCode)
{
    auto options = std::make_shared<BenchIdleOptions>();
    CLI::App* command = bench.add_subcommand(
        "idle", "Instructions, time, GL calls and allocations of frames in which nothing is to be seen; "
                "counts instructions with valgrind when it is installed");
    command->add_option("--dormant", options->dormant, "Instances before their start")
        ->check(CLI::Range(0, 1000000));
    command->add_option("--hidden", options->hidden, "Instances behind the camera")
        ->check(CLI::Range(0, 1000000));
    command->add_flag("--gl", options->gl, "A view draws each frame as well");
    command->add_flag("--turn", options->turn, "The camera moves each frame");
    command->add_flag("--visit-all", options->visitAll,
                      "Ask every instance for its state: the gates' control");
    command->add_flag("--check", options->check,
                      "Compare an empty scene, a thousand and many with the gates; fail beyond them");
    command->add_flag("--json", options->json, "One object a line");
    command->add_flag("--count-work", options->countWork)->group(""); // for callgrind
    command->callback([options, &outExitCode] { outExitCode = runBenchIdle(*options); });
}

void addCity(CLI::App& bench, int& outExitCode)
{
    auto options = std::make_shared<BenchCityOptions>();
    CLI::App* command = bench.add_subcommand(
        "city", "Update and render time of many effects, few in sight, over that of only those in sight");
    command->add_option("--instances", options->instances, "Effects in the city")
        ->check(CLI::Range(100, 1000000));
    command->add_option("--frames", options->frames, "Frames to measure")->check(CLI::Range(1, 100000));
    command->add_option("--turn", options->turn, "Turn by so many degrees a frame: times, replays, memory")
        ->check(CLI::Range(0.0, 180.0));
    command->add_flag("--gl", options->gl, "A view draws each frame as well");
    command->add_flag(
        "--check", options->check,
        "Compare hashes, memory and pictures with a city that hides nothing; fail where an exact "
        "policy differs");
    command->add_flag("--json", options->json, "One object a line");
    command->callback([options, &outExitCode] { outExitCode = runBenchCity(*options); });
}

void addLod(CLI::App& bench, int& outExitCode)
{
    auto options = std::make_shared<BenchLodOptions>();
    CLI::App* command = bench.add_subcommand(
        "lod", "A field of far effects drawn with a level of detail: time, picture and a flight towards it");
    command->add_option("--instances", options->instances, "Effects in the field")
        ->check(CLI::Range(1, 100000));
    command->add_option("--size", options->pixels, "[pixel] Width and height of the picture")
        ->check(CLI::Range(64, 4096));
    command->add_option("--repeats", options->repeats, "Frames of which the mean time is taken")
        ->check(CLI::Range(1, 1000));
    command->add_option("--flight", options->flight, "Frames of the flight; 0: none")
        ->check(CLI::Range(0, 100000));
    command->add_flag("--check", options->check,
                      "Fail when a change of level is seen in the flight, or hard switches are not");
    command->add_flag("--json", options->json, "One object a level");
    command->callback([options, &outExitCode] { outExitCode = runBenchLod(*options); });
}

void addSoak(CLI::App& bench, int& outExitCode)
{
    auto options = std::make_shared<BenchSoakOptions>();
    CLI::App* command = bench.add_subcommand(
        "soak",
        "Many frames of coming and going: memory and instructions a frame, at the begin and at the end");
    command->add_option("--frames", options->frames, "To play; a whole number of rounds of 600 is used")
        ->check(CLI::Range(2400, 100000000));
    command->add_flag("--gl", options->gl, "A view draws each frame as well");
    command->add_flag("--leak", options->leak, "Leave an instance behind each round: the gates' control");
    command->add_flag("--check", options->check, "Fail when memory or instructions grow");
    command->add_flag("--json", options->json, "One object");
    command->add_flag("--count-work", options->countWork)->group(""); // for callgrind
    command->callback([options, &outExitCode] { outExitCode = runBenchSoak(*options); });
}

void addBudget(CLI::App& bench, int& outExitCode)
{
    auto arguments = std::make_shared<BenchBudgetArguments>();
    CLI::App* command =
        bench.add_subcommand("budget", "Frames whose load jumps, with quality by budget and without");
    command->add_option("--size", arguments->size, "Of the frames")->capture_default_str();
    command->add_option("--clock", arguments->clock, "auto, gpu, wall or processor")->capture_default_str();
    command->add_option("--calibration", arguments->calibration, "A file of fx calibrate");
    command->add_option("--budget", arguments->budget,
                        "[ms] default: 1.5 times a frame of the least load at full quality");
    command->add_option("--frames", arguments->frames, "Frames of equal load")->capture_default_str();
    command->add_flag("--check", arguments->check,
                      "Fail when the controller is over budget in more than 5 % of the frames or changes "
                      "settings in more than 3 %, or when the others keep that");
    command->add_flag("--json", arguments->json, "One object a way to choose quality");
    command->callback([arguments, &outExitCode] { outExitCode = runBenchBudget(*arguments); });
}

} // namespace

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
    addBenchMeasurements(*bench, outExitCode);
    addIdle(*bench, outExitCode);
    addCity(*bench, outExitCode);
    addLod(*bench, outExitCode);
    addSoak(*bench, outExitCode);
    addBudget(*bench, outExitCode);
    for (CLI::App* command : bench->get_subcommands({})) {
        command->excludes(drawn);
        command->excludes(onThreads);
        command->excludes(upTo);
    }
}

} // namespace fx::cli
