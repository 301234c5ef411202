/// @file volume_writer.h
/// Balls of medium at one moment to one OpenVDB file.
#pragma once

#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/vdb/vdb_volume.h"
#include "rendering/voxelization/block_plan.h"

#include <filesystem>
#include <functional>
#include <span>

namespace fx::cli {

struct VolumeOptions
{
    double voxelSize = 0.0; ///< [m]
    uint64_t maxVoxels = 0; ///< in blocks
    bool half = false;
    bool points = false;
};

struct VolumeReport
{
    uint64_t voxels = 0;         ///< with medium
    uint64_t bytes = 0;          ///< of the file
    double crossSection = 0.0;   ///< [m2] of the balls
    double densityVolume = 0.0;  ///< [m2] sum of density times volume over the voxels
    double largestDensity = 0.0; ///< [1/m]
};

/// Writes a file whole or not at all.
/// @param progress is called with blocks done and their number
/// @return TooLarge with the voxel size that would fit, Interrupted, Io, OutOfMemory
base::Result<VolumeReport> writeVolume(std::span<const render::VoxelBall> balls, const VolumeOptions& options,
                                       const render::VdbMetadata& metadata, const std::filesystem::path& file,
                                       base::TaskRunner& tasks,
                                       const std::function<void(uint64_t, uint64_t)>& progress);

} // namespace fx::cli
