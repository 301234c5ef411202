#include "foundation/assets/voxel_volume.h"

#include "foundation/assets/volume_lattice.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace fx::base {

namespace {

/// A sample of a brick: the voxel, and the share of its volume that belongs to the cells of the brick.
struct CellSample
{
    size_t voxel = 0; ///< index in the arrays
    double weight = 0.0;
};

/// Sums of one brick.
struct CellSums
{
    double extinction = 0.0, heat = 0.0;
    glm::dvec3 scattered{0.0}, emission{0.0};
};

void addSample(const VoxelVolume& volume, const CellSample& sample, CellSums& io)
{
    const double extinction = double(volume.extinction[sample.voxel]);
    const double amount = sample.weight * extinction;
    io.extinction += amount;
    io.scattered +=
        amount * glm::dvec3(volume.albedo.empty() ? volume.evenAlbedo : volume.albedo[sample.voxel]);
    if (!volume.temperature.empty())
        io.heat += amount * double(volume.temperature[sample.voxel]);
    if (!volume.emission.empty())
        io.emission += sample.weight * glm::dvec3(volume.emission[sample.voxel]);
}

/// Half of a voxel on a face of a brick belongs to the cells of each side.
double shareAlong(int i)
{
    return i == 0 || i == kVolumeBrickSide ? 0.5 : 1.0;
}

CellSums sumsOf(const VoxelVolume& volume, const BrickIndex& index, const glm::ivec3& brick)
{
    std::array<uint32_t, 8> around{}; // the brick and those that follow along the axes
    for (int k = 0; k < 8; ++k)
        around[size_t(k)] = index.find(brick + glm::ivec3(k & 1, k >> 1 & 1, k >> 2));
    CellSums sums;
    constexpr int n = kVolumeBrickSide;
    for (int z = 0; z <= n; ++z)
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x) {
                const uint32_t found = around[size_t(x / n + 2 * (y / n) + 4 * (z / n))];
                if (found == BrickIndex::kNone)
                    continue;
                const size_t voxel =
                    size_t(found) * kVolumeBrickVoxels + size_t(x % n + n * (y % n) + n * n * (z % n));
                addSample(volume, {voxel, shareAlong(x) * shareAlong(y) * shareAlong(z)}, sums);
            }
    return sums;
}

/// Bricks whose cells reach stored voxels: the stored bricks and those before them, ascending.
std::vector<glm::ivec3> bricksWithCells(const std::vector<glm::ivec3>& stored)
{
    std::vector<glm::ivec3> bricks;
    bricks.reserve(8 * stored.size());
    for (const glm::ivec3& brick : stored)
        for (int k = 0; k < 8; ++k)
            bricks.push_back(brick - glm::ivec3(k & 1, k >> 1 & 1, k >> 2));
    std::ranges::sort(bricks, isBefore);
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
    return bricks;
}

} // namespace

size_t VoxelVolume::bytes() const
{
    return bricks.size() * sizeof(glm::ivec3) +
           (extinction.size() + temperature.size() + emissionRate.size()) * sizeof(float) +
           (emission.size() + albedo.size() + velocity.size()) * sizeof(glm::vec3);
}

BrickIndex::BrickIndex(const std::vector<glm::ivec3>& bricks)
{
    if (bricks.empty())
        return;
    glm::ivec3 high = low_ = bricks.front();
    for (const glm::ivec3& brick : bricks) {
        low_ = glm::min(low_, brick);
        high = glm::max(high, brick);
    }
    size_ = high - low_ + 1;
    table_.assign(size_t(size_.x) * size_t(size_.y) * size_t(size_.z), kNone);
    for (size_t i = 0; i < bricks.size(); ++i) {
        const glm::ivec3 p = bricks[i] - low_;
        table_[size_t(p.x) + size_t(size_.x) * (size_t(p.y) + size_t(size_.y) * size_t(p.z))] = uint32_t(i);
    }
}

std::vector<VolumeCells> volumeCells(const VoxelVolume& volume)
{
    const BrickIndex index(volume.bricks);
    const double voxel = double(volume.side) * double(volume.side) * double(volume.side);
    std::vector<VolumeCells> cells;
    for (const glm::ivec3& brick : bricksWithCells(volume.bricks)) {
        const CellSums sums = sumsOf(volume, index, brick);
        const auto section = float(sums.extinction * voxel);
        if (!(section > 0.0f))
            continue;
        VolumeCells& out = cells.emplace_back();
        out.brick = brick;
        out.crossSection = section;
        out.temperature = float(sums.heat / sums.extinction);
        out.albedo = glm::vec3(sums.scattered / sums.extinction);
        out.emission = glm::vec3(glm::min(sums.emission / sums.extinction, glm::dvec3(kMostVolumeLight)));
    }
    return cells;
}

} // namespace fx::base
