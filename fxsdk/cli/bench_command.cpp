/// @file bench_command.cpp
/// fx bench: measurements of the running product, one subcommand each.

#include "fxsdk/cli/bench_budget.h"
#include "fxsdk/cli/commands.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace fx::cli {
namespace {

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
    command->add_flag("--json", arguments->json, "One object a way to choose quality");
    command->callback([arguments, &outExitCode] { outExitCode = runBenchBudget(*arguments); });
}

} // namespace

void addBenchCommand(CLI::App& app, int& outExitCode)
{
    CLI::App* bench = app.add_subcommand("bench", "Measure the running product");
    bench->require_subcommand(1);
    addBudget(*bench, outExitCode);
}

} // namespace fx::cli
