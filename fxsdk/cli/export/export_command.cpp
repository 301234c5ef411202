/// @file export_command.cpp
/// fx export: the media of scenes and presets as volumes for other programs.

#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/export/ball_source.h"
#include "fxsdk/cli/export/export_options.h"
#include "fxsdk/cli/export/volume_writer.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/progress.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fx::cli {
namespace {

constexpr uint64_t kBytesPerVoxel =
    72; // values of all grids, their copy in the file, and what is around them
constexpr double kEmptyVoxelSize = 0.1; // [m] of files without any medium
/// [1] Of successive frames: a moment between them is shown on the voxels of the finer one.
constexpr double kMostGrowth = 1.25;

EffectSceneOptions optionsOf(const ExportArguments& arguments)
{
    EffectSceneOptions options;
    options.seed = arguments.seed;
    options.compute = "cpu";
    if (arguments.quality == "reference") {
        options.stepsPerSecond = 120;
        options.quality = FX_QUALITY_REFERENCE;
    } else if (arguments.quality == "low") {
        options.quality = FX_QUALITY_LOW;
    }
    return options;
}

/// Everything between the loaded file and the last volume.
class ExportJob
{
public:
    ExportJob(const ExportArguments& arguments, const ExportPlan& plan, const BallFile& file)
        : arguments_(arguments), plan_(plan), file_(file)
    {}

    base::Status run()
    {
        const uint64_t affordable = machine_.memory / kBytesPerVoxel;
        if (arguments_.voxels && plan_.maxVoxels > affordable)
            return {base::Code::TooLarge, "--voxels " + std::to_string(plan_.maxVoxels) + " may take " +
                                              std::to_string(plan_.maxVoxels * kBytesPerVoxel >> 20) +
                                              " MiB, more than this machine has; give at most " +
                                              std::to_string(affordable)};
        options_ = {
            0.0, std::min(plan_.maxVoxels, affordable), arguments_.half, arguments_.points, arguments_.detail,
            0.0};
        voxelSizes_.assign(plan_.frames.size(), arguments_.voxelSize.value_or(0.0));
        if (!arguments_.voxelSize)
            if (base::Status status = chooseVoxelSizes(); !status)
                return status;
        options_.pointsBelow = arguments_.ballsBelow * largestVoxelSize();
        return writeFrames();
    }

    double smallestVoxelSize() const { return *std::ranges::min_element(voxelSizes_); }
    double largestVoxelSize() const { return *std::ranges::max_element(voxelSizes_); }
    uint64_t mostVoxels() const { return mostVoxels_; }
    uint64_t nonFinite() const { return nonFinite_; }
    bool leftDetailOut() const { return leftDetailOut_; }

private:
    /// Of each frame the smallest at which it, with small balls as voxels too, keeps to the budget; a
    /// sequence is simulated once more for that.
    base::Status chooseVoxelSizes()
    {
        auto source = file_.start(optionsOf(arguments_));
        if (!source.ok())
            return source.status();
        Progress progress("measuring frame", plan_.frames.size(), !arguments_.json);
        for (size_t i = 0; i < plan_.frames.size(); ++i) {
            progress.update(i);
            if (interruptRequested())
                return interruptedStatus();
            auto moment = (*source)->at(plan_.frames[i].tick);
            if (!moment.ok())
                return moment.status();
            if (!moment->balls.empty())
                voxelSizes_[i] = render::voxelSizeFor(moment->balls, options_.maxVoxels);
            if (plan_.frames.size() == 1)
                only_ = std::move(*moment);
        }
        limitGrowth();
        return {};
    }

    /// Makes voxels of frames larger whose successor or predecessor has far larger ones. Frames without
    /// medium have those of their neighbors.
    void limitGrowth()
    {
        std::vector<double>& sizes = voxelSizes_;
        for (size_t i = 1; i < sizes.size(); ++i)
            sizes[i] = std::max(sizes[i], sizes[i - 1] / kMostGrowth);
        for (size_t i = sizes.size() - 1; i > 0; --i)
            sizes[i - 1] = std::max(sizes[i - 1], sizes[i] / kMostGrowth);
        for (double& size : sizes)
            size = size > 0.0 ? size : kEmptyVoxelSize;
    }

    base::Status writeFrames()
    {
        const bool isSequence = plan_.frames.size() > 1;
        if (only_)
            return writeFrame(0, *only_, true);
        auto source = file_.start(optionsOf(arguments_));
        if (!source.ok())
            return source.status();
        uint64_t done = 0;
        Progress frames("frame", plan_.frames.size(), isSequence && !arguments_.json);
        for (const ExportPlan::Frame& frame : plan_.frames) {
            frames.update(done);
            if (interruptRequested())
                return interruptedStatus();
            const auto moment = (*source)->at(frame.tick);
            if (!moment.ok())
                return moment.status();
            if (base::Status status = writeFrame(done, *moment, !isSequence); !status)
                return status;
            frames.update(++done);
        }
        return {};
    }

    base::Status writeFrame(size_t number, const MomentBalls& moment, bool showBlocks)
    {
        const ExportPlan::Frame& frame = plan_.frames[number];
        options_.voxelSize = voxelSizes_[number];
        if (!arguments_.voxelSize && !moment.balls.empty() && // limitGrowth() has changed it
            !render::BlockPlan::create(moment.balls, options_.voxelSize, options_.maxVoxels))
            options_.voxelSize = render::voxelSizeFor(moment.balls, options_.maxVoxels, options_.voxelSize);
        std::unique_ptr<Progress> blocks;
        const auto report =
            writeVolume(moment, options_, metadataOf(frame, moment), plan_.output.frame(frame.number),
                        *tasks_, [&](uint64_t done, uint64_t total) {
                            if (showBlocks && !blocks)
                                blocks = std::make_unique<Progress>("block", total, !arguments_.json);
                            if (blocks)
                                blocks->update(done);
                        });
        if (!report.ok())
            return {report.status().code(), placeOf(frame) + report.status().message()};
        mostVoxels_ = std::max(mostVoxels_, report->voxels);
        nonFinite_ += moment.nonFinite;
        leftDetailOut_ = leftDetailOut_ || (moment.details.isGiven() && !arguments_.detail);
        if (arguments_.json)
            printJsonLine(withMachine({{"file", plan_.output.frame(frame.number).string()},
                                       {"time", base::toSeconds(frame.tick)},
                                       {"voxel_size", options_.voxelSize},
                                       {"voxels", report->voxels},
                                       {"bytes", report->bytes},
                                       {"blobs", moment.balls.size()},
                                       {"balls", report->balls},
                                       {"nonfinite", moment.nonFinite},
                                       {"cross_section", report->crossSection},
                                       {"density_volume", report->densityVolume},
                                       {"density_max", report->largestDensity}},
                                      machine_));
        return {};
    }

    /// Of messages.
    std::string placeOf(const ExportPlan::Frame& frame) const
    {
        char time[48];
        std::snprintf(time, sizeof time, " at %g s: ", base::toSeconds(frame.tick));
        return arguments_.input + time;
    }

    render::VdbMetadata metadataOf(const ExportPlan::Frame& frame, const MomentBalls& moment) const
    {
        render::VdbMetadata metadata{{"creator", std::string("fx " FXSDK_VERSION)},
                                     {"fxsdk_version", std::string(FXSDK_VERSION)},
                                     {"source", arguments_.input},
                                     {"time", base::toSeconds(frame.tick)},
                                     {"voxel_size", options_.voxelSize},
                                     {"anisotropy", moment.anisotropy},
                                     {"length_unit", std::string("m")},
                                     {"up_axis", std::string("+Y")}};
        if (plan_.output.isSequence()) {
            metadata.emplace_back("frame", frame.number);
            metadata.emplace_back("frames_per_second", arguments_.framesPerSecond);
        }
        if (const auto seed = arguments_.seed ? arguments_.seed : file_.seed())
            metadata.emplace_back("seed", int64_t(*seed));
        return metadata;
    }

    const ExportArguments& arguments_;
    const ExportPlan& plan_;
    const BallFile& file_;
    Machine machine_ = readMachine();
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeTbbRunner();
    VolumeOptions options_;
    std::vector<double> voxelSizes_;  ///< [m] of each frame
    std::optional<MomentBalls> only_; ///< of one file, where it is known already
    uint64_t mostVoxels_ = 0;
    uint64_t nonFinite_ = 0;
    bool leftDetailOut_ = false; ///< of fields that have it
};

std::string sizesText(double smallest, double largest)
{
    char text[64];
    if (smallest == largest)
        std::snprintf(text, sizeof text, "%.4g", smallest);
    else
        std::snprintf(text, sizeof text, "%.4g to %.4g", smallest, largest);
    return text;
}

int failed(const base::Status& status)
{
    std::fprintf(stderr, "fx export: %s\n", status.message().c_str());
    return exitCodeOf(status);
}

int runExport(const ExportArguments& arguments)
{
    auto plan = planExport(arguments);
    if (!plan.ok()) {
        failed(plan.status());
        return kUsage;
    }
    if (base::Status status = render::checkVdb(); !status)
        return failed(status);
    for (const ExportPlan::Frame& frame : plan->frames)
        if (base::Status status = checkTarget(plan->output.frame(frame.number)); !status)
            return failed(status);
    const auto file = openBallFile(arguments.input);
    if (!file.ok())
        return failed(file.status());
    for (const std::string& warning : (*file)->warnings())
        std::fprintf(stderr, "warning: %s\n", warning.c_str());
    if (plan->hasDefaultTime && (*file)->previewTime())
        plan->frames[0].tick = base::toTicks(*(*file)->previewTime());
    ExportJob job(arguments, *plan, **file);
    if (base::Status status = job.run(); !status)
        return failed(status);
    if (job.nonFinite() > 0)
        std::fprintf(stderr, "warning: %llu balls were left out because a number was not finite\n",
                     static_cast<unsigned long long>(job.nonFinite()));
    if (job.leftDetailOut())
        std::fprintf(stderr, "warning: media are smooth without the detail that fx render draws in them; "
                             "--detail writes it\n");
    if (!arguments.json)
        std::printf("%s: %zu %s with voxels of %s m, at most %llu\n", arguments.output.c_str(),
                    plan->frames.size(), plan->frames.size() == 1 ? "file" : "files",
                    sizesText(job.smallestVoxelSize(), job.largestVoxelSize()).c_str(),
                    static_cast<unsigned long long>(job.mostVoxels()));
    return kSuccess;
}

} // namespace

void addExportCommand(CLI::App& app, int& outExitCode)
{
    auto arguments = std::make_shared<ExportArguments>();
    CLI::App* command =
        app.add_subcommand("export", "Write the media of a scene or a preset as OpenVDB volumes");
    addExportOptions(*command, *arguments);
    command->callback([arguments, &outExitCode] { outExitCode = runExport(*arguments); });
}

} // namespace fx::cli
