/// @file particles_plot.h
/// fx bench --plot: the number of particles that this machine can simulate in a frame.
#pragma once

#include <cstdint>
#include <string>

namespace fx::cli {

/// Runs `fx bench particles` for a thousand to ten million particles, and plots the time of a step against
/// their number.
/// @param file SVG to be written
/// @param most largest number of particles, at least a thousand
/// @return exit code
int runBenchPlot(const std::string& file, uint32_t threads, uint64_t most);

} // namespace fx::cli
