/// @file bench_measurement.h
/// A subcommand of fx bench. Each is described by a function in a file of its own, which fx_measurements() of
/// the CMakeLists.txt beside it names; cmake/FxMeasurements.cmake makes the list.
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
    std::string name;    ///< of the subcommand
    std::string summary; ///< in the help

    /// Adds the options, and a callback that measures and stores the exit code.
    std::function<void(CLI::App& command, int& outExitCode)> addOptions;
};

/// All measurements, in the order of the help.
const std::vector<BenchMeasurement>& benchMeasurements();

} // namespace fx::cli
