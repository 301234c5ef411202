/// @file commands.h
/// The commands of fx. Each line of commands.inl declares one function, such as `addRenderCommand()`. The
/// function adds the options of its command and a callback that runs the command and stores its exit code.
#pragma once

namespace CLI {
class App;
}

namespace fx::cli {

#define FX_COMMAND(Name) void add##Name##Command(CLI::App& app, int& outExitCode);
#include "fxsdk/cli/commands.inl"
#undef FX_COMMAND

} // namespace fx::cli
