/// @file block_table.h
/// Finds blocks of 8 x 8 x 8 voxels by their place.
#pragma once

#include <glm/vec3.hpp>

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

/// Number of the block at a place, or kNoBlock.
/// @param blocks places in rising order of x, then y, then z
inline size_t findBlock(std::span<const glm::ivec3> blocks, const glm::ivec3& place)
{
    const auto key = [](const glm::ivec3& b) { return std::array{b.x, b.y, b.z}; };
    const auto found = std::ranges::lower_bound(blocks, key(place), {}, key);
    return found != blocks.end() && *found == place ? size_t(found - blocks.begin()) : kNoBlock;
}

} // namespace fx::render
