/// @file bench_measurement.h
/// A subcommand of fx bench. A function in its own file describes the subcommand. fx_measurements() in the
/// CMakeLists.txt beside that file names the function. cmake/FxMeasurements.cmake generates the list.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fx::cli {

struct BenchMeasurement
{
    std::string name;    ///< name of the subcommand
    std::string summary; ///< text in the help

    /// Adds the options, and a callback that runs the measurement and stores the exit code.
    std::function<void(CLI::App& command, int& outExitCode)> addOptions;
};

/// All measurements, in the order of the help.
const std::vector<BenchMeasurement>& benchMeasurements();

} // namespace fx::cli
