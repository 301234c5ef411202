/// @file block_type.h
/// Types of blocks: what a block consists of.
#pragma once

#include "foundation/result/status.h"
#include "foundation/snapshot/block_kind.h"
#include "simulation/blocks/block_loop.h"
#include "simulation/cloud/ball_list.h"

#include <glm/gtc/quaternion.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fx::sim {

/// A block within a block type or an effect.
struct BlockPlacement
{
    glm::vec3 position{0.0f};                   ///< [m] in units of the block that contains it
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f}; ///< unit quaternion
    float scale = 1.0f;                         ///< [1] of lengths, > 0
    float density = 1.0f;                       ///< [1] factor of optical depths, >= 0
    uint32_t type = 0;                          ///< index of its type
    uint32_t phase = 0;                         ///< of the type's animation, below BlockType::phases
};

constexpr size_t kMaxBlockBalls = size_t(1) << 20;      ///< in all lists and loops of the types of a solver
constexpr size_t kMaxBlockPlaces = size_t(1) << 18;     ///< in all lists of the types of a solver
constexpr uint64_t kMaxBlockSpan = uint64_t(1) << 36;   ///< ids of a type
constexpr uint64_t kMaxInnerBlocks = uint64_t(1) << 22; ///< blocks in a block, at all levels

/// A type has one of `balls`, `loop` and `blocks`.
struct BlockType
{
    std::string name;
    BallList balls;                        ///< balls that do not move
    std::shared_ptr<const BlockLoop> loop; ///< balls of an emitter, in a loop
    std::vector<BlockPlacement> blocks;    ///< blocks of types of lower index
    uint32_t phases = 1;                   ///< 1 to base::kMaxBlockPhases

    // What completeTypes() computes.
    float ballRadius = 0;      ///< [m] mean radius of its balls, by their cross section
    float crossSection = 0;    ///< [m2] sum over its balls
    float radius = 0;          ///< [m] of the smallest ball about the block's origin that holds its content
    uint64_t span = 0;         ///< number of ids that its balls take
    uint64_t ballCount = 0;    ///< largest number of balls, with those of its blocks
    uint64_t blockCount = 0;   ///< number of blocks in it, at all levels
    uint32_t levels = 1;       ///< of blocks, with itself
    std::vector<uint64_t> ids; ///< of `blocks`

    bool hasBlocks() const { return !blocks.empty(); }
};

/// Computes what follows from the content of the types, in the order of the list. The phases of a type of
/// blocks are the largest number of its blocks' types; each phase shifts those of its blocks.
/// @return InvalidArgument, with the name of the type, for more than base::kMaxBlockLevels levels and for
///         blocks of a type that does not come before; TooLarge for too many balls
base::Status completeTypes(std::span<BlockType> ioTypes);

/// The phase of a block of type `inner` in phase `phase` of a block that contains it.
inline uint32_t innerPhase(const BlockPlacement& block, const BlockType& inner, uint32_t phase)
{
    return (block.phase + phase) % inner.phases;
}

} // namespace fx::sim
