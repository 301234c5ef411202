/// @file brick_volume.h
/// Turns an imported volume into voxels of the product's own format.
#pragma once

#include "foundation/assets/voxel_volume.h"
#include "foundation/result/status.h"
#include "rendering/voxelization/medium_grid.h"

#include <cstddef>
#include <string>

namespace fx::cli {

/// The voxels of a grid. If those of the grid are cubes along the axes of the world, values are copied.
/// Otherwise the voxels have the shortest side of the grid's, values are interpolated along each axis of the
/// grid, and the extinction is multiplied by a factor that keeps its integral. A grid of flames gives emitted
/// light in the color of a black body of the temperature; without flames, the medium glows as its temperature
/// does.
/// @param isFrame whether it is a frame of a sequence: velocities, and rates of flames, are taken
/// @param albedo [1] of grids that have no colors
/// @return TooLarge with the remedy, InvalidArgument for a grid whose voxels have no medium
base::Result<base::VoxelVolume> voxelVolumeOf(const render::MediumGrid& grid, double albedo,
                                              bool isFrame = false);

/// A file of voxels, and what is in it.
struct VolumeBytes
{
    std::string bytes;
    size_t bricks = 0;
    double side = 0.0;      ///< [m] of a voxel
    double massError = 0.0; ///< [1] relative, of the voxels as they are in the file
    bool isResampled = false;
    bool hasVelocities = false;
};

/// The file of voxelVolumeOf().  @return its errors, and those of asset::writeVolume()
base::Result<VolumeBytes> volumeBytesOf(const render::MediumGrid& grid, double albedo, bool isFrame = false);

} // namespace fx::cli
