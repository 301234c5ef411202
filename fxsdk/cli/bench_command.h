/// @file bench_command.h
/// Parts of fx bench.
#pragma once

#include <CLI/App.hpp>

namespace fx::cli {

/// A subcommand for each entry of bench_entries.cpp.
void addBenchMeasurements(CLI::App& bench, int& outExitCode);

} // namespace fx::cli
