/// @file block_detail.h
/// Detail of the balls of a block of voxels.
#pragma once

#include "rendering/voxelization/block_plan.h"
#include "rendering/voxelization/voxel_ball.h"
#include "rendering/voxelization/voxel_detail.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace fx::render {

using BlockFactors = std::array<VoxelDetail::Factors, kBlockVoxels>;

/// One ball with the detail of a block.
struct DetailedBall
{
    const VoxelDetail& detail;
    const BlockFactors& factors;
    uint32_t index;
    const VoxelBall& ball;

    /// Luminance and red of the ball's light in a voxel, over the luminance that the ball has. The ball must
    /// emit light.
    std::pair<double, double> light(size_t voxel) const;
};

/// Threads: one at a time.
class BlockDetail
{
public:
    /// @param detail null: balls have no detail  @param voxelSize [m]
    BlockDetail(const VoxelDetail* detail, double voxelSize) : detail_(detail), voxelSize_(voxelSize) {}

    /// Evaluates the detail at the centers of the voxels of a block.
    /// @param list indices of the balls that reach the block  @param normalization of all balls
    void find(const BlockPlan::Block& block, std::span<const uint32_t> list, std::span<const VoxelBall> balls,
              std::span<const double> normalization);

    /// Detail of a ball in the last block; null: it has none.
    const DetailedBall* of(uint32_t index, const VoxelBall& ball);

private:
    struct Group
    {
        size_t number = 0;                                    ///< of VoxelDetail
        std::array<double, kBlockVoxels> extinction;          ///< [1/m]
        std::array<VoxelDetail::Values, kBlockVoxels> values; ///< sums, weighted with the extinction
        BlockFactors factors;
    };
    const VoxelDetail* detail_;
    double voxelSize_;
    Group* find(size_t number);
    Group& add(size_t number);

    std::vector<std::unique_ptr<Group>> groups_; ///< of the block, the first of them; the others are kept
    size_t count_ = 0;                           ///< groups of the block
    std::optional<DetailedBall> ball_;
};

} // namespace fx::render
