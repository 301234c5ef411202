/// @file import_command.cpp
/// fx import: volumes of other programs.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/import/cloud_preset.h"
#include "fxsdk/cli/import/frame_files.h"
#include "fxsdk/cli/import/volume_import.h"
#include "fxsdk/cli/import/volume_preset.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/named_choice.h"
#include "fxsdk/cli/support/progress.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstring>
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
    std::string output; ///< empty: none
    bool bricks = false;
    render::FitOptions fit;
    double albedo = 0.8;
    std::string frames; ///< FIRST:LAST; empty: those that are there
    SequencePlay play;
    bool json = false;
};

void addImportOptions(CLI::App& command, ImportArguments& a)
{
    const auto scale = CLI::Range(kLeastScale, kMostScale);
    command.add_option("FILE", a.input, "A volume (*.vdb), or a sequence of volumes (NAME.%04d.vdb)")
        ->required();
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
    CLI::Option* const output =
        command.add_option("-o,--output", a.output, "NAME.fx.json: a preset with balls, in NAME.fxballs");
    CLI::Option* const bricks =
        command.add_flag("--bricks", a.bricks, "Keep the voxels, in NAME.fxvolume, instead of fitting balls")
            ->needs(output);
    command.add_option("--fit", a.fit.count, "Most balls")
        ->check(CLI::Range(uint32_t(1), uint32_t(sim::kMaxListedBalls)))
        ->needs(output)
        ->excludes(bricks)
        ->capture_default_str();
    command.add_option("--iterations", a.fit.iterations, "Steps of the fit")
        ->check(CLI::Range(0u, 1000u))
        ->needs(output)
        ->excludes(bricks)
        ->capture_default_str();
    command
        .add_option("--frames", a.frames,
                    "Frames of a sequence, FIRST:LAST, both included (default: all that are there)")
        ->needs(output);
    command.add_option("--fps", a.play.framesPerSecond, "Frames a second of a sequence")
        ->check(CLI::Range(0.01, 240.0))
        ->needs(output)
        ->capture_default_str();
    command.add_option("--end", a.play.end, "What follows the last frame of a sequence: hold or loop")
        ->check(oneOf({"hold", "loop"}))
        ->needs(output)
        ->capture_default_str();
    command.add_option("--memory", a.play.memory, "[MiB] For the voxels of a sequence while it is played")
        ->check(CLI::Range(1u, 65536u))
        ->needs(output)
        ->capture_default_str();
    command.add_option("--albedo", a.albedo, "Of volumes without a grid of colors")
        ->check(CLI::Range(0.0, 1.0))
        ->needs(output)
        ->capture_default_str();
    command
        .add_option("--anisotropy", a.read.anisotropy,
                    "Mean cosine of the scattering angle (default: that of the file's metadata, or 0)")
        ->check(CLI::Range(-render::kMostAnisotropy, render::kMostAnisotropy));
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

void report(const ImportArguments& arguments, const render::MediumGrid& grid, const ChildReport& child,
            const CloudFitReport* fit, const BrickReport* bricks)
{
    const render::MediumGridSums sums = render::sumsOf(grid);
    std::vector<std::string> names{"density"};
    for (const auto& [isThere, name] : {std::pair(!grid.temperature.empty(), "temperature"),
                                        {!grid.flame.empty(), "flame"},
                                        {!grid.flameRate.empty(), "flame_rate"},
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
                            {"anisotropy", grid.anisotropy},
                            {"reader_bytes", child.peakMemory},
                            {"reader_s", child.seconds}};
        if (fit) {
            line["balls"] = fit->balls;
            line["mass_error"] = fit->massError;
            line["view_errors"] = fit->viewErrors;
            line["fit_s"] = fit->seconds;
        }
        if (!grid.balls.empty())
            line["balls_beside"] = grid.balls.size();
        if (bricks) {
            line["bricks"] = bricks->bricks;
            line["voxel_side"] = bricks->side;
            line["resampled"] = bricks->isResampled;
            line["mass_error"] = bricks->massError;
        }
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
    if (!grid.balls.empty())
        std::printf("%zu balls beside the voxels%s\n", grid.balls.size(),
                    fit ? ", which are left out: only --bricks keeps them" : "");
    if (fit)
        std::printf("%s: %zu balls in %s, mass %+.2g %%, opacity from three sides wrong by %.3g %%, %.3g %%, "
                    "%.3g %%, %.1f s\n",
                    arguments.output.c_str(), fit->balls, fit->ballFile.string().c_str(),
                    100.0 * fit->massError, 100.0 * fit->viewErrors[0], 100.0 * fit->viewErrors[1],
                    100.0 * fit->viewErrors[2], fit->seconds);
    if (bricks)
        std::printf("%s: %zu bricks of voxels of %.4g m in %s%s, mass %+.2g %%\n", arguments.output.c_str(),
                    bricks->bricks, bricks->side, bricks->file.string().c_str(),
                    bricks->isResampled ? ", interpolated to cubes" : "", 100.0 * bricks->massError);
}

int failed(const base::Status& status)
{
    std::fprintf(stderr, "fx import: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

ChildLimits limitsOf(ImportArguments& io)
{
    ChildLimits limits;
    limits.memory = io.memory * kMebibyte;
    limits.seconds = io.seconds;
    limits.output = io.read.maxBytes = limits.memory / 4; // the tree, its copy, and that as bytes
    limits.output += kMebibyte;                           // warnings
    return limits;
}

/// Such as "0.1 m", or "0.09 m to 0.1 m".
std::string sidesText(const SequenceReport& report)
{
    char least[32], most[32];
    std::snprintf(least, sizeof least, "%.4g m", report.leastSide);
    std::snprintf(most, sizeof most, "%.4g m", report.side);
    return std::strcmp(least, most) == 0 ? most : std::string(least) + " to " + most;
}

int importSequence(ImportArguments& arguments, const NumberedFile& input)
{
    if (arguments.output.empty()) {
        std::fprintf(stderr, "fx import: a sequence needs -o NAME.fx.json\n");
        return kUsage;
    }
    const auto frames = chooseFrames(input, arguments.frames);
    if (!frames)
        return failed(frames.status());
    arguments.play.first = frames->first;
    arguments.play.count = frames->count;
    const ChildLimits limits = limitsOf(arguments);
    Progress progress("frame", arguments.play.count, !arguments.json);
    uint64_t done = 0;
    const FrameGrid gridOf = [&](uint32_t number) {
        progress.update(done++);
        const std::string file = input.frame(number).string();
        auto grid = importVolume(file, arguments.read, limits);
        if (grid)
            for (const std::string& warning : grid->warnings)
                std::fprintf(stderr, "warning: %s: %s\n", file.c_str(), warning.c_str());
        return grid;
    };
    const auto written = writeSequencePreset(gridOf, arguments.play, arguments.albedo, arguments.output);
    if (!written)
        return failed(written.status());
    progress.update(done);
    if (!written->hasVelocities)
        std::fprintf(stderr, "warning: %s: a frame has no velocities; all are cross-faded\n",
                     arguments.input.c_str());
    if (arguments.json)
        printJsonLine(withMachine({{"file", arguments.input},
                                   {"frames", arguments.play.count},
                                   {"first_frame", arguments.play.first},
                                   {"bricks", written->mostBricks},
                                   {"balls_beside", written->mostBalls},
                                   {"bytes", written->bytes},
                                   {"voxel_side", written->side},
                                   {"voxel_side_least", written->leastSide},
                                   {"velocities", written->hasVelocities},
                                   {"anisotropy", written->anisotropy},
                                   {"resampled", written->isResampled},
                                   {"mass_error", written->massError}},
                                  readMachine()));
    else
        std::printf(
            "%s: %u frames from %u, at most %zu bricks of voxels of %s in %s, %.1f MiB together, mass "
            "within %.2g %%\n",
            arguments.output.c_str(), arguments.play.count, arguments.play.first, written->mostBricks,
            sidesText(*written).c_str(), written->files.string().c_str(),
            double(written->bytes) / double(kMebibyte), 100.0 * written->massError);
    return kSuccess;
}

int runImport(ImportArguments arguments)
{
    if (!arguments.output.empty())
        if (base::Status status = checkTarget(arguments.output); !status)
            return failed(status);
    if (arguments.input.find('%') != std::string::npos) {
        const auto input = parseNumberedFile(arguments.input);
        return input ? importSequence(arguments, *input) : failed(input.status());
    }
    const ChildLimits limits = limitsOf(arguments);
    ChildReport child;
    const auto grid = importVolume(arguments.input, arguments.read, limits, &child);
    if (!grid)
        return failed(grid.status());
    for (const std::string& warning : grid->warnings)
        std::fprintf(stderr, "warning: %s: %s\n", arguments.input.c_str(), warning.c_str());
    if (arguments.output.empty()) {
        report(arguments, *grid, child, nullptr, nullptr);
        return kSuccess;
    }
    if (arguments.bricks) {
        const auto written = writeVolumePreset(*grid, arguments.albedo, arguments.output);
        if (!written)
            return failed(written.status());
        report(arguments, *grid, child, nullptr, &*written);
        return kSuccess;
    }
    const auto tasks = base::makeTbbRunner(); // threads begin here, after the child
    const auto fit =
        writeCloudPreset(*grid, arguments.fit, arguments.albedo, arguments.output, *tasks, !arguments.json);
    if (!fit)
        return failed(fit.status());
    report(arguments, *grid, child, &*fit, nullptr);
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
