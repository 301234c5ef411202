/// @file block_table.h
/// Finds blocks of a medium grid by their place.
#pragma once

#include "rendering/voxelization/medium_grid.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

/// Coordinates in its block of voxel `v` of the arrays, each 0..7.
inline glm::ivec3 placeInBlock(size_t v)
{
    return {int(v >> 6), int(v >> 3 & 7), int(v & 7)};
}

constexpr size_t kNoBlock = ~size_t(0);

/// Number of the block whose first voxel is `origin`, or kNoBlock.
/// @param blocks rising, as in MediumGrid
inline size_t findBlock(std::span<const glm::ivec3> blocks, const glm::ivec3& origin)
{
    const auto key = [](const glm::ivec3& b) { return std::array{b.x, b.y, b.z}; };
    const auto found = std::ranges::lower_bound(blocks, key(origin), {}, key);
    return found != blocks.end() && *found == origin ? size_t(found - blocks.begin()) : kNoBlock;
}

} // namespace fx::render
