/// @file block_turn.h
/// Random rotations of blocks.
#pragma once

#include <glm/gtc/quaternion.hpp>

#include <cstdint>

namespace fx::sim {

/// Rotations from which those of blocks are drawn.
enum class BlockTurn : uint8_t
{
    None,    ///< blocks are not rotated
    Upright, ///< about +Y, by any angle
    Free,    ///< any rotation
};

/// The rotation of block `index`, evenly distributed; a unit quaternion.
glm::quat turnOf(BlockTurn turn, uint64_t seed, uint64_t index);

} // namespace fx::sim
