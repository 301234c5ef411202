/// @file bench_program.h
/// Common code of measurements of fx bench that have their own options and print one JSON object per case.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace CLI {
class App;
}

namespace fx::cli {

/// Ends a measurement that cannot continue or whose result is wrong.
class BenchFailure : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

[[noreturn]] void fail(const std::string& what);

template <class T>
T taken(base::Result<T>&& result)
{
    if (!result.ok())
        fail(result.status().message());
    return std::move(*result);
}

/// Sets the callback of a subcommand. The callback calls `measure`, prints the message of a BenchFailure with
/// the name of the subcommand, and stores the exit code, 0 or 1.
void setMeasurement(CLI::App& command, int& outExitCode, std::function<void()> measure);

/// Adds --size WxH, each 1 to 16384 [pixel].
void addSizeOption(CLI::App& command, int& width, int& height);

/// Adds --repeat: number of frames, of which the shortest time is reported, 1 to 1,000,000.
void addRepeatOption(CLI::App& command, int& repeat);

/// Adds --small: sizes with which a measurement takes about a second, which override other options. Also
/// --json for scripts that ask each command for it: such a measurement prints objects in any case.
void addSmallOption(CLI::App& command, bool& isSmall);

/// Adds --validate-hash, hexadecimal with or without 0x.
void addHashOption(CLI::App& command, uint64_t& hash);

/// Options of measurements of whole frames.
struct FrameOptions
{
    double time = 0.0; ///< [s] scene time of the first frame
    int width = 320, height = 180;
    int repeat = 5; ///< number of frames, of which the shortest time is reported
    bool isSmall = false;

    /// Returns the options of --small if that is set, otherwise these. @param smallTime [s] of a small
    /// measurement
    FrameOptions orSmall(double smallTime) const;
};

/// Adds --time, --repeat, --size and --small, with the values of `options` as defaults.
void addFrameOptions(CLI::App& command, FrameOptions& options);

/// Formats a hash as "0x0123456789abcdef".
std::string hashText(uint64_t hash);

} // namespace fx::cli
