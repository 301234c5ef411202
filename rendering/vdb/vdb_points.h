/// @file vdb_points.h
/// Converts balls of medium to a grid of points of OpenVDB. The function has its own source file, because it
/// takes long to compile.
#pragma once

#include "rendering/voxelization/voxel_ball.h"

#include <openvdb/Grid.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace fx::render {

/// @param areMedium whether the balls are medium that no voxel has: attributes state it completely
/// @param voxelSize [m] side of a voxel of the lattice into which the points are sorted
openvdb::GridBase::Ptr makePoints(std::span<const VoxelBall> balls, double voxelSize, bool areMedium);

/// Factors of what points state, by which they fit to the voxels of their file.
struct PointScales
{
    double length = 1.0;      ///< [m] of a unit of the file
    double extinction = 1.0;  ///< of cross sections, besides that of areas
    double temperature = 1.0; ///< [K] of temperature 1
    double luminance = 1.0;   ///< [cd/m2] of luminance 1
};

/// A grid has more than kMostGridBalls points of medium.
struct TooManyPoints final : std::runtime_error
{
    TooManyPoints() : std::runtime_error("too many points") {}
};

/// The balls of a grid of makePoints() with `areMedium`, in any order; a grid without these attributes has
/// none.
/// @param outDropped number of points with numbers out of range
/// @throws TooManyPoints; std::length_error for an index that is damaged
std::vector<VoxelBall> ballsOfPoints(const openvdb::GridBase& grid, const PointScales& scales,
                                     uint64_t& outDropped);

} // namespace fx::render
