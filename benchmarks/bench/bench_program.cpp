#include "benchmarks/bench/bench_program.h"

#include "fxsdk/cli/support/exit_code.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdio>

namespace fx::cli {

void fail(const std::string& what)
{
    throw BenchFailure(what);
}

void setMeasurement(CLI::App& command, int& outExitCode, std::function<void()> measure)
{
    command.callback([&command, &outExitCode, measure = std::move(measure)] {
        try {
            measure();
            outExitCode = kSuccess;
        } catch (const BenchFailure& failure) {
            std::fprintf(stderr, "fx bench %s: %s\n", command.get_name().c_str(), failure.what());
            outExitCode = kFailed;
        }
    });
}

void addSizeOption(CLI::App& command, int& width, int& height)
{
    command.add_option_function<std::string>(
        "--size",
        [&width, &height](const std::string& text) {
            int w = 0, h = 0;
            char rest = 0;
            if (std::sscanf(text.c_str(), "%dx%d%c", &w, &h, &rest) != 2 || w < 1 || h < 1 || w > 16384 ||
                h > 16384)
                throw CLI::ValidationError("--size", "'" + text + "' is not WIDTHxHEIGHT, each 1 to 16384");
            width = w;
            height = h;
        },
        "[pixel] Of the picture, such as " + std::to_string(width) + "x" + std::to_string(height) +
            ", the default");
}

void addRepeatOption(CLI::App& command, int& repeat)
{
    command.add_option("--repeat", repeat, "Frames of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
}

void addSmallOption(CLI::App& command, bool& isSmall)
{
    command.add_flag("--small", isSmall, "Small sizes, to see that it works; times say nothing then");
    command.add_flag("--json")->description("Standard output has one object a line, also without this");
}

void addHashOption(CLI::App& command, uint64_t& hash)
{
    command.add_option_function<std::string>(
        "--validate-hash",
        [&hash](const std::string& text) {
            const char* const begin = text.data() + (text.starts_with("0x") ? 2 : 0);
            const char* const end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(begin, end, hash, 16);
            if (begin == end || error != std::errc{} || stop != end)
                throw CLI::ValidationError("--validate-hash", "'" + text + "' is not a hexadecimal number");
        },
        "Exit code 1 when the results have another hash (hexadecimal)");
}

FrameOptions FrameOptions::orSmall(double smallTime) const
{
    return isSmall ? FrameOptions{smallTime, 96, 54, 1, true} : *this;
}

void addFrameOptions(CLI::App& command, FrameOptions& options)
{
    command.add_option("--time", options.time, "[s] Scene time of the first frame")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    addRepeatOption(command, options.repeat);
    addSizeOption(command, options.width, options.height);
    addSmallOption(command, options.isSmall);
}

std::string hashText(uint64_t hash)
{
    char text[19];
    std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(hash));
    return text;
}

} // namespace fx::cli
