/// @file brick_volume.h
/// Writes an imported volume as voxels, and a preset that draws them.
#pragma once

#include "foundation/assets/voxel_volume.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/medium_grid.h"

#include <filesystem>

namespace fx::cli {

struct BrickReport
{
    size_t bricks = 0;
    double side = 0.0;      ///< [m] of a voxel
    double massError = 0.0; ///< [1] relative, of the voxels as they are in the file
    bool isResampled = false;
    std::filesystem::path file;
};

/// The voxels of a grid. If those of the grid are cubes along the axes of the world, values are copied.
/// Otherwise the voxels have the shortest side of the grid's, values are interpolated along each axis of the
/// grid, and the extinction is multiplied by a factor that keeps its integral. A grid of flames gives emitted
/// light in the color of a black body of the temperature; without flames, the medium glows as its temperature
/// does.
/// @param albedo [1] of grids that have no colors
/// @return TooLarge with the remedy, InvalidArgument for a grid without medium
base::Result<base::VoxelVolume> voxelVolumeOf(const render::MediumGrid& grid, double albedo);

/// Writes `preset` (*.fx.json) and, beside it, the voxels (*.fxvolume) that it names.
/// @return errors of voxelVolumeOf() and writeVolume(); Io
base::Result<BrickReport> writeVolumePreset(const render::MediumGrid& grid, double albedo,
                                            const std::filesystem::path& preset);

} // namespace fx::cli
