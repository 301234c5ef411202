/// @file block_plan.h
/// Finds the blocks of voxels that balls fill. The blocks are found before any voxel is computed, so that
/// work and memory are known.
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
        glm::ivec3 origin{0}; ///< [voxel] first voxel of the block
        size_t first = 0;     ///< index in balls() of the block's first ball
        size_t count = 0;
    };

    /// @param voxelSize [m] > 0
    /// @param maxVoxels largest number of voxels of all blocks
    /// @return no value if more voxels are needed, or if a ball is farther than 2^30 voxels from the origin
    static std::optional<BlockPlan> create(std::span<const VoxelBall> balls, double voxelSize,
                                           uint64_t maxVoxels);

    /// The blocks, sorted by x, then y, then z of their origins.
    std::span<const Block> blocks() const { return blocks_; }
    /// Indices of the balls of all blocks, ascending within each block.
    std::span<const uint32_t> balls() const { return balls_; }
    /// [m] Side of a voxel.
    double voxelSize() const { return voxelSize_; }
    /// Number of voxels of all blocks, an upper bound of the number of voxels with medium.
    uint64_t voxels() const { return uint64_t(blocks_.size()) * uint64_t(kBlockVoxels); }

private:
    std::vector<Block> blocks_;
    std::vector<uint32_t> balls_;
    double voxelSize_ = 0.0;
};

/// Returns the smallest side of a voxel [m] with which the blocks of the balls have at most `maxVoxels`
/// voxels. The result is within 1 % of the smallest side.
/// @param least [m] lower bound of the result
/// @param maxVoxels at least kLeastVoxels
double voxelSizeFor(std::span<const VoxelBall> balls, uint64_t maxVoxels, double least = 0.0);

/// Number of voxels of 64 blocks. This number suffices for any balls if a voxel is as large as the bounding
/// box of all balls.
constexpr uint64_t kLeastVoxels = 64 * uint64_t(kBlockVoxels);

} // namespace fx::render
