/// @file commands.h
/// The commands of fx, one for each line of commands.inl: `addRenderCommand()` and so on. Each adds its
/// options and a callback that does the work and stores its exit code.
#pragma once

namespace CLI {
class App;
}

namespace fx::cli {

#define FX_COMMAND(Name) void add##Name##Command(CLI::App& app, int& outExitCode);
#include "fxsdk/cli/commands.inl"
#undef FX_COMMAND

} // namespace fx::cli
