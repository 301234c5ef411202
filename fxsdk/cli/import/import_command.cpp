/// @file import_command.cpp
/// fx import: volumes of other programs.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/import/volume_import.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace fx::cli {
namespace {

constexpr double kLeastScale = 1e-12, kMostScale = 1e12;
constexpr uint64_t kMostVoxels = uint64_t(1) << 30;
constexpr uint64_t kMebibyte = uint64_t(1) << 20;

struct ImportArguments
{
    std::string input;
    render::VdbReadOptions read;
    uint64_t memory = 4096; ///< [MiB]
    unsigned seconds = 120;
    bool json = false;
};

void addImportOptions(CLI::App& command, ImportArguments& a)
{
    const auto scale = CLI::Range(kLeastScale, kMostScale);
    command.add_option("FILE", a.input, "A volume (*.vdb)")->required();
    command.add_option(
        "--density", a.read.density,
        "Grid of extinction: a fog volume, or a level set, which is filled (default: density)");
    command.add_option("--temperature", a.read.temperature, "Grid of temperatures (default: temperature)");
    command.add_option("--flame", a.read.flame, "Grid of emitted light (default: flame, heat or flames)");
    command.add_option("--color", a.read.color, "Grid of albedo (default: Cd or color)");
    command.add_option("--velocity", a.read.velocity, "Grid of velocities (default: v, vel or velocity)");
    command.add_option("--density-scale", a.read.densityScale, "[1/m] Extinction of density 1")
        ->check(scale)
        ->capture_default_str();
    command.add_option("--temperature-scale", a.read.temperatureScale, "[K] Of temperature 1")
        ->check(scale)
        ->capture_default_str();
    command.add_option("--flame-scale", a.read.flameScale, "[cd/m3] Of flame 1")
        ->check(scale)
        ->capture_default_str();
    command.add_option("--length-scale", a.read.lengthScale, "[m] Of a unit of length of the file")
        ->check(scale)
        ->capture_default_str();
    command.add_option("--max-voxels", a.read.maxVoxels, "Grids with more active voxels are refused")
        ->check(CLI::Range(uint64_t(1), kMostVoxels))
        ->capture_default_str();
    command.add_option("--max-memory", a.memory, "[MiB] The process that reads the file may take as much")
        ->check(CLI::Range(uint64_t(64), uint64_t(1) << 20))
        ->capture_default_str();
    command.add_option("--max-seconds", a.seconds, "[s] The process that reads the file may compute as long")
        ->check(CLI::Range(1u, 86400u))
        ->capture_default_str();
    command.add_flag("--json", a.json, "Print one JSON object");
}

std::string textOf(const glm::dvec3& v)
{
    char text[96];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", v.x, v.y, v.z);
    return text;
}

nlohmann::json arrayOf(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

void report(const ImportArguments& arguments, const render::MediumGrid& grid, const ChildReport& child)
{
    const render::MediumGridSums sums = render::sumsOf(grid);
    std::vector<std::string> names{"density"};
    for (const auto& [isThere, name] : {std::pair(!grid.temperature.empty(), "temperature"),
                                        {!grid.flame.empty(), "flame"},
                                        {!grid.albedo.empty(), "color"},
                                        {!grid.velocity.empty(), "velocity"}})
        if (isThere)
            names.emplace_back(name);
    if (arguments.json) {
        nlohmann::json line{{"file", arguments.input},
                            {"grids", names},
                            {"voxels", sums.voxels},
                            {"blocks", grid.blocks.size()},
                            {"voxel_low", {sums.low.x, sums.low.y, sums.low.z}},
                            {"voxel_high", {sums.high.x, sums.high.y, sums.high.z}},
                            {"low", arrayOf(sums.boxLow)},
                            {"high", arrayOf(sums.boxHigh)},
                            {"voxel_volume", grid.voxelVolume()},
                            {"cross_section", sums.crossSection},
                            {"center", arrayOf(sums.center)},
                            {"density_max", sums.largestDensity},
                            {"temperature_mean", sums.temperature},
                            {"flame_volume", sums.luminousVolume},
                            {"reader_bytes", child.peakMemory},
                            {"reader_s", child.seconds}};
        printJsonLine(withMachine(std::move(line), readMachine()));
        return;
    }
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    std::printf(
        "%s: %s; %llu voxels in %zu blocks, centers from %s to %s m, extinction up to %.4g /m, %.6g m2 "
        "together\n",
        arguments.input.c_str(), list.c_str(), static_cast<unsigned long long>(sums.voxels),
        grid.blocks.size(), textOf(sums.boxLow).c_str(), textOf(sums.boxHigh).c_str(), sums.largestDensity,
        sums.crossSection);
}

int runImport(ImportArguments arguments)
{
    ChildLimits limits;
    limits.memory = arguments.memory * kMebibyte;
    limits.seconds = arguments.seconds;
    limits.output = arguments.read.maxBytes = limits.memory / 4; // the tree, its copy, and that as bytes
    limits.output += kMebibyte;                                  // warnings
    ChildReport child;
    const auto grid = importVolume(arguments.input, arguments.read, limits, &child);
    if (!grid) {
        std::fprintf(stderr, "fx import: %s\n", grid.status().message().c_str());
        return exitCodeOf(grid.status());
    }
    for (const std::string& warning : grid->warnings)
        std::fprintf(stderr, "warning: %s: %s\n", arguments.input.c_str(), warning.c_str());
    report(arguments, *grid, child);
    return kSuccess;
}

} // namespace

void addImportCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<ImportArguments>();
    CLI::App* command = app.add_subcommand("import", "Read volumes of other programs (OpenVDB)");
    addImportOptions(*command, *arguments);
    command->callback([arguments, &outExitCode] { outExitCode = runImport(*arguments); });
}

} // namespace fx::cli
