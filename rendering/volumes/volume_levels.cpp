#include "rendering/volumes/volume_levels.h"

#include "foundation/assets/volume_lattice.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <vector>

namespace fx::render {

namespace {

/// The bricks that those of the next finer level may reach: a voxel belongs to the coarser ones around it.
/// @param last [voxel] of the coarser level, behind which there is no medium
std::vector<glm::ivec3> coarserBricks(const std::vector<glm::ivec3>& finer, const glm::ivec3& last)
{
    std::vector<glm::ivec3> bricks;
    bricks.reserve(8 * finer.size());
    for (const glm::ivec3& brick : finer)
        for (int k = 0; k < 8; ++k) {
            const glm::ivec3 next = brick + glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
            const glm::ivec3 reached(next.x >> 1, next.y >> 1, next.z >> 1);
            if (glm::all(glm::lessThanEqual(base::kVolumeBrickSide * reached, last)))
                bricks.push_back(reached);
        }
    std::ranges::sort(bricks, base::isBefore);
    bricks.erase(std::unique(bricks.begin(), bricks.end()), bricks.end());
    return bricks;
}

} // namespace

base::VolumeLevel packedLevel(const MediumVolume& medium)
{
    return {medium.index(), uint32_t(medium.bricks()), medium.brightest(), medium.packedWithVelocities()};
}

base::CoarserLevels coarserLevels(const base::VoxelVolume& volume)
{
    auto levels = std::make_shared<base::VolumeLevels>();
    levels->coarser.reserve(base::kMostVolumeLevel);
    MediumVolume medium(volume);
    for (int level = 1; level <= base::kMostVolumeLevel; ++level) {
        medium = medium.halved();
        levels->coarser.push_back(packedLevel(medium));
    }
    return levels;
}

uint64_t mostCoarserBytes(std::vector<glm::ivec3> bricks, bool hasVelocities)
{
    constexpr size_t kPacked = sizeof(base::VolumeLevel::Packed);
    const size_t voxel = hasVelocities ? kPacked + kPacked / 2 : kPacked;
    uint64_t sum = 0;
    glm::ivec3 last(0);
    for (const glm::ivec3& brick : bricks)
        last = glm::max(last, brick * base::kVolumeBrickSide + (base::kVolumeBrickSide - 1));
    for (int level = 1; level <= base::kMostVolumeLevel; ++level) {
        last = (last + 1) / 2;
        bricks = coarserBricks(bricks, last);
        const base::BrickIndex index(bricks);
        sum += bricks.size() * base::kVolumeBrickVoxels * voxel + index.table().size() * sizeof(uint32_t);
    }
    return sum;
}

} // namespace fx::render
