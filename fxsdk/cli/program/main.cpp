/// @file main.cpp
/// The fx command: picks the subcommand and turns what happened into an exit code; see docs/cli.md.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/program/usage_message.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <new>

namespace {

int run(int argumentCount, char** arguments)
{
    CLI::App app("fx: explosions, fire, smoke and dust from presets to pictures", "fx");
    app.set_version_flag("--version", "fx " FXSDK_VERSION);
    app.require_subcommand(1);
    app.failure_message(fx::cli::usageMessage);
    app.footer("Exit codes: 0 done, 1 failed, 2 the command line makes no sense, 130 interrupted.\n"
               "Start with: fx doctor; fx render library:explosion -o explosion.png --time 0.6");

    int exitCode = fx::cli::kSuccess;
#define FX_COMMAND(Name) fx::cli::add##Name##Command(app, exitCode);
#include "fxsdk/cli/commands.inl"
#undef FX_COMMAND
    try {
        app.parse(argumentCount, arguments);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? fx::cli::kSuccess : fx::cli::kUsage;
    }
    return exitCode;
}

} // namespace

int main(int argumentCount, char** arguments)
{
    fx::cli::installInterruptHandler();
    int exitCode = fx::cli::kFailed;
    try {
        exitCode = run(argumentCount, arguments);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "fx: not enough memory; ask for a smaller picture or fewer particles\n");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "fx: %s\n", error.what());
    }
    const fx::base::Status output = fx::cli::finishStandardOutput();
    if (!output.ok()) {
        std::fprintf(stderr, "fx: %s\n", output.message().c_str());
        return exitCode == fx::cli::kSuccess ? fx::cli::kFailed : exitCode;
    }
    return exitCode;
}
