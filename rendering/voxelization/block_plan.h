/// @file block_plan.h
/// Which blocks of voxels balls fill, found before any voxel is computed, so that work and memory are known.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/voxelization/voxel_ball.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace fx::render {

class BlockPlan
{
public:
    struct Block
    {
        glm::ivec3 origin{0}; ///< [voxel]
        size_t first = 0;     ///< of its balls, in balls()
        size_t count = 0;
    };

    /// @param voxelSize [m] > 0
    /// @param maxVoxels of all blocks
    /// @return nothing: more voxels are needed, or the balls are farther than 2^30 voxels from the origin
    static std::optional<BlockPlan> create(std::span<const VoxelBall> balls, double voxelSize,
                                           uint64_t maxVoxels);

    /// In rising order of x, then y, then z of their origins.
    std::span<const Block> blocks() const { return blocks_; }
    /// Numbers of balls, in rising order for each block.
    std::span<const uint32_t> balls() const { return balls_; }
    /// [m]
    double voxelSize() const { return voxelSize_; }
    /// Of all blocks; an upper bound of those that have medium.
    uint64_t voxels() const { return uint64_t(blocks_.size()) * uint64_t(kBlockVoxels); }

private:
    std::vector<Block> blocks_;
    std::vector<uint32_t> balls_;
    double voxelSize_ = 0.0;
};

/// The smallest side of a voxel [m], within 1 %, at which the blocks of the balls have at most `maxVoxels`.
/// @param least [m] smaller ones are not tried
/// @param maxVoxels at least kLeastVoxels
double voxelSizeFor(std::span<const VoxelBall> balls, uint64_t maxVoxels, double least = 0.0);

/// Of 64 blocks: enough for any balls when a voxel is as large as all of them together.
constexpr uint64_t kLeastVoxels = 64 * uint64_t(kBlockVoxels);

} // namespace fx::render
