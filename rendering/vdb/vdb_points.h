/// @file vdb_points.h
/// Balls of medium as a grid of points of OpenVDB. Part of vdb_volume, in a file of its own because it takes
/// long to compile.
#pragma once

#include "rendering/voxelization/voxel_ball.h"

#include <openvdb/Grid.h>

#include <span>

namespace fx::render {

/// @param voxelSize [m] of the lattice that the points are sorted into
openvdb::GridBase::Ptr makePoints(std::span<const VoxelBall> balls, double voxelSize);

} // namespace fx::render
