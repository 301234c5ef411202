/// @file voxel_sums.h
/// Voxelized balls, and sums over their voxels.
#pragma once

#include "rendering/voxelization/ball_voxelizer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace fx::render {

constexpr uint64_t kManyVoxels = uint64_t(1) << 26;

inline std::vector<VoxelBlock> voxelize(std::span<const VoxelBall> balls, double voxelSize,
                                        base::TaskRunner& tasks)
{
    const auto plan = BlockPlan::create(balls, voxelSize, kManyVoxels);
    std::vector<VoxelBlock> blocks;
    if (plan)
        BallVoxelizer(balls, *plan, tasks).fill(0, plan->blocks().size(), blocks);
    return blocks;
}

inline std::vector<VoxelBlock> voxelize(std::span<const VoxelBall> balls, double voxelSize)
{
    const auto tasks = base::makeSerialRunner();
    return voxelize(balls, voxelSize, *tasks);
}

struct VoxelSums
{
    double mass = 0.0;        ///< [m2] density times volume
    glm::dvec3 moment{0.0};   ///< [m3] first moment of the density
    double light = 0.0;       ///< [cd] flame times volume
    double heat = 0.0;        ///< [K m2] temperature times mass
    glm::dvec3 momentum{0.0}; ///< [m3/s] velocity times mass
    double squares = 0.0;     ///< [m4] second moment about the origin
    glm::ivec3 low{std::numeric_limits<int>::max()},
        high{std::numeric_limits<int>::min()}; ///< range of voxels with medium

    glm::dvec3 center() const { return moment / mass; }
};

inline VoxelSums sumsOf(std::span<const VoxelBlock> blocks, double h)
{
    VoxelSums sums;
    for (const VoxelBlock& block : blocks)
        for (int v = 0; v < kBlockVoxels; ++v) {
            const double mass = double(block.density[size_t(v)]) * h * h * h;
            if (!(mass > 0.0))
                continue;
            const glm::ivec3 voxel = block.origin + glm::ivec3(v / 64, v / 8 % 8, v % 8);
            const glm::dvec3 place = glm::dvec3(voxel) * h;
            sums.mass += mass;
            sums.moment += mass * place;
            sums.light += double(block.flame[size_t(v)]) * h * h * h;
            sums.heat += mass * double(block.temperature[size_t(v)]);
            sums.momentum += mass * glm::dvec3(block.velocity[size_t(v)]);
            sums.squares += mass * glm::dot(place, place);
            sums.low = glm::min(sums.low, voxel);
            sums.high = glm::max(sums.high, voxel);
        }
    return sums;
}

} // namespace fx::render
