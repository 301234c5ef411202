/// @file parameters_command.cpp
/// fx parameters: what presets can say, generated from the schema that validates them.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/exit_code.h"
#include "fxsdk/presets/parameter_reference.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace fx::cli {

void addParametersCommand(CLI::App& app, int& outExitCode)
{
    CLI::App* command = app.add_subcommand(
        "parameters", "Print the parameter reference: unit, range, default and cost (Markdown)");
    command->callback([&outExitCode] {
        std::fputs(preset::parameterReference().c_str(), stdout);
        outExitCode = kSuccess;
    });
}

} // namespace fx::cli
