/// @file vdb_points.h
/// Converts balls of medium to a grid of points of OpenVDB. The function has its own source file, because it
/// takes long to compile.
#pragma once

#include "rendering/voxelization/voxel_ball.h"

#include <openvdb/Grid.h>

#include <cstdint>
#include <span>
#include <vector>

namespace fx::render {

/// @param areMedium whether the balls are medium that no voxel has: attributes state it completely
/// @param voxelSize [m] side of a voxel of the lattice into which the points are sorted
openvdb::GridBase::Ptr makePoints(std::span<const VoxelBall> balls, double voxelSize, bool areMedium);

/// The balls of a grid of makePoints() with `areMedium`, in any order; a grid without these attributes has
/// none.
/// @param scale [m] of a unit of the file  @param outDropped number of points with numbers out of range
/// @throws std::length_error for more than kMostGridBalls points
std::vector<VoxelBall> ballsOfPoints(const openvdb::GridBase& grid, double scale, uint64_t& outDropped);

} // namespace fx::render
