/// @file vdb_points.h
/// Converts balls of medium to a grid of points of OpenVDB. The function has its own source file, because it
/// takes long to compile.
#pragma once

#include "rendering/voxelization/voxel_ball.h"

#include <openvdb/Grid.h>

#include <span>

namespace fx::render {

/// @param voxelSize [m] side of a voxel of the lattice into which the points are sorted
openvdb::GridBase::Ptr makePoints(std::span<const VoxelBall> balls, double voxelSize);

} // namespace fx::render
