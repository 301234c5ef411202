#include "fxsdk/cli/export/volume_writer.h"

#include "fxsdk/cli/export/field_voxel_detail.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/interrupt.h"
#include "rendering/voxelization/ball_voxelizer.h"
#include "rendering/voxelization/medium_grid.h"
#include "rendering/voxelization/small_balls.h"

#include <algorithm>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr size_t kBatch = 1024; // blocks between two looks at Ctrl-C, 12 MiB

std::string numberText(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

base::Status tooManyVoxels(std::span<const render::VoxelBall> balls, const VolumeOptions& options)
{
    const double fits = render::voxelSizeFor(balls, options.maxVoxels, options.voxelSize);
    return {base::Code::TooLarge, "voxels of " + numberText(options.voxelSize) + " m are more than " +
                                      std::to_string(options.maxVoxels) + "; give --voxel-size " +
                                      numberText(fits * 1.01) + " or larger, or a larger --voxels"};
}

void sumUp(std::span<const render::VoxelBlock> blocks, double volume, VolumeReport& io)
{
    for (const render::VoxelBlock& block : blocks)
        for (const float density : block.density) {
            io.densityVolume += double(density) * volume;
            io.largestDensity = std::max(io.largestDensity, double(density));
        }
}

} // namespace

namespace {

/// Balls of a moment that become voxels, and those that become points, with their streaks.
struct SplitBalls
{
    MomentBalls voxels;
    std::vector<render::VoxelBall> points;
};

SplitBalls split(const MomentBalls& moment, const VolumeOptions& options)
{
    const bool hasDetails = moment.details.isGiven();
    SplitBalls out;
    out.voxels.details.groups = moment.details.groups;
    out.voxels.details.octaves = moment.details.octaves;
    std::vector<render::VoxelBall> small;
    for (size_t i = 0; i < moment.balls.size(); ++i) {
        const bool isDetailed = options.detail && hasDetails && moment.details.balls[i].group >= 0;
        // The detail of points would be lost.
        if (moment.balls[i].radius < options.pointsBelow && !isDetailed) {
            small.push_back(moment.balls[i]);
            continue;
        }
        out.voxels.balls.push_back(moment.balls[i]);
        if (hasDetails)
            out.voxels.details.balls.push_back(moment.details.balls[i]);
    }
    out.points = render::joinStreaks(small);
    return out;
}

base::Result<VolumeReport> writeSplit(const MomentBalls& moment, std::span<const render::VoxelBall> points,
                                      const VolumeOptions& options, const render::VdbMetadata& metadata,
                                      const std::filesystem::path& file, base::TaskRunner& tasks,
                                      const std::function<void(uint64_t, uint64_t)>& progress)
{
    const std::vector<render::VoxelBall>& balls = moment.balls;
    const auto plan = render::BlockPlan::create(balls, options.voxelSize, options.maxVoxels);
    if (!plan)
        return tooManyVoxels(balls, options);
    render::BallVoxelizer voxelizer(balls, *plan, tasks);
    const FieldVoxelDetail detail(moment, options.voxelSize);
    if (options.detail && moment.details.isGiven())
        voxelizer.setDetail(&detail);
    voxelizer.findEscapeDepths();
    render::VdbVolume volume(options.voxelSize);
    VolumeReport report;
    std::vector<render::VoxelBlock> blocks;
    const size_t count = plan->blocks().size();
    for (size_t first = 0; first < count; first += kBatch) {
        if (interruptRequested())
            return interruptedStatus();
        voxelizer.fill(first, std::min(kBatch, count - first), blocks);
        volume.add(blocks);
        sumUp(blocks, options.voxelSize * options.voxelSize * options.voxelSize, report);
        progress(first + blocks.size(), count);
    }
    if (options.points)
        volume.addPoints(balls);
    if (options.pointsBelow > 0.0)
        volume.addPoints(points, true);
    const auto bytes = volume.encode(metadata, options.half);
    if (!bytes.ok())
        return bytes.status();
    if (interruptRequested())
        return interruptedStatus();
    if (base::Status status = writeFileAtomically(file, *bytes); !status)
        return status;
    report.voxels = volume.voxels();
    report.bytes = bytes->size();
    report.balls = points.size();
    for (const render::VoxelBall& ball : balls)
        report.crossSection += ball.crossSection;
    return report;
}

} // namespace

base::Result<VolumeReport> writeVolume(const MomentBalls& moment, const VolumeOptions& options,
                                       const render::VdbMetadata& metadata, const std::filesystem::path& file,
                                       base::TaskRunner& tasks,
                                       const std::function<void(uint64_t, uint64_t)>& progress)
{
    if (!(options.pointsBelow > 0.0))
        return writeSplit(moment, {}, options, metadata, file, tasks, progress);
    const SplitBalls parts = split(moment, options);
    if (parts.points.size() > render::kMostGridBalls)
        return base::Status(base::Code::TooLarge, std::to_string(parts.points.size()) +
                                                      " balls are smaller than --balls-below; allowed are " +
                                                      std::to_string(render::kMostGridBalls) +
                                                      ": decrease it");
    return writeSplit(parts.voxels, parts.points, options, metadata, file, tasks, progress);
}

} // namespace fx::cli
