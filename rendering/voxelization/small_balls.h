/// @file small_balls.h
/// Balls that are too small for voxels, which files of volumes hold as points beside the voxels.
#pragma once

#include "rendering/voxelization/voxel_ball.h"

#include <span>
#include <vector>

namespace fx::render {

/// Joins the pieces of streaks (foundation/snapshot/streak.h) that follow each other: a ball whose `streak`
/// is the way on which the pieces lie, with the medium of all of them. Balls without pieces stay as they are.
std::vector<VoxelBall> joinStreaks(std::span<const VoxelBall> balls);

} // namespace fx::render
