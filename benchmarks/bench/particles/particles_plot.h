/// @file particles_plot.h
/// fx bench --plot: how many particles a frame affords on this machine.
#pragma once

#include <cstdint>
#include <string>

namespace fx::cli {

/// Measures `fx bench particles` for a thousand to ten million particles, and draws the time of a step
/// against their number.
/// @param file SVG to be written
/// @param most largest number of particles, at least a thousand
/// @return exit code
int runBenchPlot(const std::string& file, uint32_t threads, uint64_t most);

} // namespace fx::cli
