#include "rendering/voxelization/block_plan.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fx::render {
namespace {

constexpr double kFarthest = double(1 << 30);      // [voxel] from the origin
constexpr size_t kMaxPairs = size_t(1) << 27;      // of a ball and a block: 2 GiB
constexpr double kSmallestVoxel = 1e-9;            // [m]
constexpr double kFineStep = 1.010889286051700475; // 2^(1/64)

struct Pair
{
    std::array<int32_t, 3> block; ///< origin over kBlockSide
    uint32_t ball;
};

int32_t blockOf(double voxel)
{
    return int32_t(std::floor(voxel / kBlockSide));
}

/// Adds the blocks in which a ball has medium. The tent of a sample reaches to the centers of voxels less
/// than one voxel away. @return whether at most `maxBlocks` were added
bool addPairs(const VoxelBall& ball, uint32_t number, double voxelSize, size_t maxBlocks,
              std::vector<Pair>& io)
{
    const glm::dvec3 center = ball.center / voxelSize;
    const double radius = ball.radius / voxelSize;
    const double reach = radius + 1.0;
    if (!(std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)}) + reach < kFarthest))
        return false;
    glm::ivec3 low, high;
    for (int a = 0; a < 3; ++a) {
        low[a] = blockOf(center[a] - reach);
        high[a] = blockOf(center[a] + reach);
    }
    const glm::dvec3 extent(high - low + 1);
    // Of the blocks of the box around a ball at least an eighth meet the ball.
    if (extent.x * extent.y * extent.z > 8.0 * double(maxBlocks) + 64.0)
        return false;
    const size_t before = io.size();
    for (int32_t x = low.x; x <= high.x; ++x)
        for (int32_t y = low.y; y <= high.y; ++y)
            for (int32_t z = low.z; z <= high.z; ++z) {
                const glm::dvec3 lowest = glm::dvec3(x, y, z) * double(kBlockSide) - 1.0;
                const glm::dvec3 away = center - glm::clamp(center, lowest, lowest + double(kBlockSide + 1));
                if (glm::dot(away, away) <= radius * radius)
                    io.push_back({{x, y, z}, number});
            }
    return io.size() - before <= maxBlocks && io.size() <= kMaxPairs;
}

} // namespace

std::optional<BlockPlan> BlockPlan::create(std::span<const VoxelBall> balls, double voxelSize,
                                           uint64_t maxVoxels)
{
    const size_t maxBlocks = size_t(maxVoxels / uint64_t(kBlockVoxels));
    std::vector<Pair> pairs;
    for (size_t i = 0; i < balls.size(); ++i)
        if (!addPairs(balls[i], uint32_t(i), voxelSize, maxBlocks, pairs))
            return std::nullopt;
    std::ranges::stable_sort(pairs, {}, &Pair::block);

    BlockPlan plan;
    plan.voxelSize_ = voxelSize;
    plan.balls_.reserve(pairs.size());
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (i == 0 || pairs[i].block != pairs[i - 1].block) {
            const auto& b = pairs[i].block;
            if (plan.blocks_.size() == maxBlocks)
                return std::nullopt;
            plan.blocks_.push_back({glm::ivec3(b[0], b[1], b[2]) * kBlockSide, i, 0});
        }
        ++plan.blocks_.back().count;
        plan.balls_.push_back(pairs[i].ball);
    }
    return plan;
}

double voxelSizeFor(std::span<const VoxelBall> balls, uint64_t maxVoxels, double least)
{
    if (balls.empty())
        return least;
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const VoxelBall& ball : balls) {
        low = glm::min(low, ball.center - ball.radius);
        high = glm::max(high, ball.center + ball.radius);
    }
    const glm::dvec3 extent = high - low;
    const auto fits = [&](double size) { return BlockPlan::create(balls, size, maxVoxels).has_value(); };
    double size = std::max({extent.x, extent.y, extent.z, least});
    while (size * 0.5 >= std::max(least, kSmallestVoxel) && fits(size * 0.5))
        size *= 0.5;
    for (int step = 0; step < 64 && size / kFineStep >= least && fits(size / kFineStep); ++step)
        size /= kFineStep;
    return size;
}

} // namespace fx::render
