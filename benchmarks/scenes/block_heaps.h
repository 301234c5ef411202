/// @file block_heaps.h
/// Blocks of balls that emit light and scatter none, and the balls that the blocks stand for.
#pragma once

#include "rendering/reference/render/medium_blobs.h"
#include "simulation/blocks/blocks_def.h"

#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <vector>

namespace fx::cli {

/// A heap of overlapping balls.
struct HeapOfBalls
{
    uint32_t balls = 60;
    double smallest = 0.3, largest = 0.5; ///< [1] radius of a ball over that of the heap
    double depth = 1.5;                   ///< [1] mean optical depth through the cross section of the heap
    bool isColored = false;               ///< true: the emitted light differs between balls
    uint64_t seed = 1;
};

/// A block type of radius 1 m. Its balls emit up to `brightest` [cd/m2].
sim::BlockType heapOf(const HeapOfBalls& heap, float brightest);

/// Any rotation.
glm::quat anyTurn(uint64_t seed, uint64_t index);

/// The balls of all blocks, at all levels, composed in double precision without the code of the product.
std::vector<render::MediumBlob> ballsOf(const sim::BlocksDef& blocks);

} // namespace fx::cli
