#include "fxsdk/cli/export/export_options.h"

#include "fxsdk/cli/support/named_choice.h"
#include "rendering/voxelization/block_plan.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <utility>

namespace fx::cli {
namespace {

constexpr double kDefaultTime = 0.5;                           // [s]
constexpr uint64_t kDefaultVoxels = 1'000'000;                 // where they decide on the voxel size
constexpr uint64_t kDefaultMostVoxels = 64'000'000;            // where --voxel-size is given
constexpr uint64_t kMostVoxels = uint64_t(1'000'000'000);      // 24 GB of values
constexpr double kMostBallsBelow = 1000.0;                     // [voxel]
constexpr double kLeastVoxelSize = 1e-6, kMostVoxelSize = 1e6; // [m]

base::Status usage(const std::string& message)
{
    return {base::Code::InvalidArgument, message};
}

base::Status planFrames(const ExportArguments& arguments, ExportPlan& plan)
{
    const bool isSingle = !plan.output.isSequence();
    auto frames =
        listFrames({arguments.time, arguments.frames, arguments.framesPerSecond}, isSingle, kDefaultTime,
                   "a sequence (-o name.%04d.vdb)", "one file (-o name.vdb); for a sequence give --frames");
    if (!frames.ok())
        return frames.status();
    plan.frames = std::move(*frames);
    plan.hasDefaultTime = isSingle && !arguments.time;
    return {};
}

} // namespace

void addExportOptions(CLI::App& command, ExportArguments& arguments)
{
    command
        .add_option("FILE", arguments.input,
                    "A scene (*.scene.json), a preset (*.fx.json), library:NAME, or a list of blobs "
                    "(*.blobs.csv)")
        ->required();
    command.add_option("-o,--output", arguments.output, "NAME.vdb, or a sequence (NAME.%04d.vdb)")
        ->required();
    command
        .add_option("--time", arguments.time,
                    "Scene time of one file [s] (default: of the preset's preview, or 0.5)")
        ->check(CLI::Range(0.0, kMaxSceneTime));
    command.add_option("--frames", arguments.frames,
                       "Frames of a sequence, FIRST:LAST, both included (default: 2 seconds)");
    command.add_option("--fps", arguments.framesPerSecond, "Frames a second; frame N shows the time N / fps")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    command
        .add_option("--voxel-size", arguments.voxelSize,
                    "[m] Side of a voxel in all frames (default: of each frame the smallest that --voxels "
                    "allows)")
        ->check(CLI::Range(kLeastVoxelSize, kMostVoxelSize));
    command
        .add_option("--voxels", arguments.voxels,
                    "Most voxels of a frame, counted in blocks of 8x8x8 (default: 1000000; with "
                    "--voxel-size 64000000)")
        ->check(CLI::Range(render::kLeastVoxels, kMostVoxels));
    command.add_flag("--detail", arguments.detail,
                     "With the detail of fields, down to a voxel: lumps that fx render draws in them");
    command.add_flag("--half", arguments.half,
                     "Store values with 16 bits, except grids with values above 65504");
    CLI::Option* const points = command.add_flag(
        "--points", arguments.points,
        "Also the balls of medium as points, with id, instance, velocity, radius, age and albedo");
    command
        .add_option("--balls-below", arguments.ballsBelow,
                    "[voxel] Balls with a smaller radius, such as sparks, are points instead of voxels; in "
                    "the largest voxels of a sequence")
        ->check(CLI::Range(0.0, kMostBallsBelow))
        ->excludes(points)
        ->capture_default_str();
    command
        .add_option("--quality", arguments.quality,
                    "Of the simulation, as that of fx render: low, high, or reference (120 steps a second)")
        ->check(oneOf({"low", "high", "reference"}))
        ->capture_default_str();
    command.add_option("--seed", arguments.seed, "Instance k gets the seed N + k instead of the file's")
        ->check(CLI::Validator(
            [](std::string& text) { return text.starts_with('-') ? "must not be negative" : ""; }, "UINT"));
    command.add_flag("--json", arguments.json, "Print one JSON object a file");
}

base::Result<ExportPlan> planExport(const ExportArguments& arguments)
{
    // CLI11's ranges let NaN through.
    if (!std::isfinite(arguments.time.value_or(kDefaultTime)) || !std::isfinite(arguments.framesPerSecond) ||
        !std::isfinite(arguments.voxelSize.value_or(1.0)) || !std::isfinite(arguments.ballsBelow))
        return usage("--time, --fps, --voxel-size and --balls-below must be numbers");
    ExportPlan plan;
    if (suffixOf(arguments.output) != ".vdb")
        return usage("output '" + arguments.output + "': the name must end in .vdb");
    auto output = parseNumberedFile(arguments.output);
    if (!output.ok())
        return output.status();
    plan.output = std::move(*output);
    plan.maxVoxels = arguments.voxels.value_or(arguments.voxelSize ? kDefaultMostVoxels : kDefaultVoxels);
    if (base::Status status = planFrames(arguments, plan); !status)
        return status;
    return plan;
}

} // namespace fx::cli
