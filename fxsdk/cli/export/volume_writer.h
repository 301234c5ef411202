/// @file volume_writer.h
/// Writes the balls of medium of one moment to an OpenVDB file.
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "fxsdk/cli/export/ball_source.h"
#include "rendering/vdb/vdb_volume.h"
#include "rendering/voxelization/block_plan.h"

#include <filesystem>
#include <functional>
#include <span>

namespace fx::cli {

struct VolumeOptions
{
    double voxelSize = 0.0; ///< [m] side of a voxel
    uint64_t maxVoxels = 0; ///< maximum number of voxels; each block counts with all of its voxels
    bool half = false;
    bool points = false;
    bool detail = false;      ///< of fields
    double pointsBelow = 0.0; ///< [m] balls of a smaller radius are points instead of voxels
};

struct VolumeReport
{
    uint64_t voxels = 0;         ///< number of voxels with medium
    uint64_t bytes = 0;          ///< [byte] size of the file
    uint64_t balls = 0;          ///< number of balls that are points instead of voxels
    double crossSection = 0.0;   ///< [m2] sum of the extinction cross sections of the balls in voxels
    double densityVolume = 0.0;  ///< [m2] sum of density times volume over the voxels
    double largestDensity = 0.0; ///< [1/m] largest density of a voxel
};

/// Writes a file atomically.
/// @param progress called with the number of finished blocks and the number of all blocks
/// @return TooLarge (the message states a voxel size that fits), Interrupted, Io, OutOfMemory
base::Result<VolumeReport> writeVolume(const MomentBalls& moment, const VolumeOptions& options,
                                       const render::VdbMetadata& metadata, const std::filesystem::path& file,
                                       base::TaskRunner& tasks,
                                       const std::function<void(uint64_t, uint64_t)>& progress);

} // namespace fx::cli
