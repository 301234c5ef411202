/// @file commands.h
/// The subcommands of fx. Each adds its options and a callback that does the work and stores its exit code.
#pragma once

namespace CLI {
class App;
}

namespace fx::cli {

void addRenderCommand(CLI::App& app, int& outExitCode);
void addValidateCommand(CLI::App& app, int& outExitCode);
void addDoctorCommand(CLI::App& app, int& outExitCode);
void addParametersCommand(CLI::App& app, int& outExitCode);
void addVerifyCommand(CLI::App& app, int& outExitCode);
void addAccuracyCommand(CLI::App& app, int& outExitCode);
void addStabilityCommand(CLI::App& app, int& outExitCode);
void addDazzleCommand(CLI::App& app, int& outExitCode);
void addBenchCommand(CLI::App& app, int& outExitCode);
void addGridCommand(CLI::App& app, int& outExitCode);
void addExplainCommand(CLI::App& app, int& outExitCode);
void addCalibrateCommand(CLI::App& app, int& outExitCode);

} // namespace fx::cli
