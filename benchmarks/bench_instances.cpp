// bench_instances bench idle|city [options]: `fx bench` as a program of its own, which the tests run under
// valgrind.
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/exit_code.h"

#include <CLI/CLI.hpp>

int main(int argumentCount, char** arguments)
{
    CLI::App app("Costs of instances, in sight and out of it");
    app.require_subcommand(1);
    int exitCode = fx::cli::kSuccess;
    fx::cli::addBenchCommand(app, exitCode);
    CLI11_PARSE(app, argumentCount, arguments);
    return exitCode;
}
