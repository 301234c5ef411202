/// @file block_kind.h
/// The kinds "block" and "blockBall": hierarchies of self-similar blocks of medium. Techniques that publish
/// blocks and passes that draw them include this header; the snapshot container does not.
///
/// A block type is a list of balls, or of blocks of other types. A variant is one phase of the animation of
/// one type; its number is variantOf(type, phase). A solver first publishes a group "block" with the owner
/// kNoOwner: the blocks of the effect, in its local space. Then comes one group for each variant that is in
/// use: "blockBall" with its balls, or "block" with the blocks that it consists of. Positions and velocities
/// in these groups are relative to the block, in units of the block.
///
/// A block scales the lengths of its content by Scale, and the extinction so that optical depths become
/// Density times as large. The group of the kind "blob" that follows the groups of a solver has the balls of
/// all blocks. If the preset has detail of the field, a group "blockMaterial" with the noise coordinates of
/// the blocks of the effect comes before all of these, and one of the kind "material" with those of the balls
/// last. Rows of the last groups are computed when they are first read, see expanded_blocks.h. Readers that
/// know blocks need not read them.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"

namespace fx::base {

/// Indices of the columns of the kind "block".
namespace block_column {
enum : size_t
{
    PositionX,
    PositionY,
    PositionZ,
    VelocityX,
    VelocityY,
    VelocityZ,
    RotationX, ///< unit quaternion
    RotationY,
    RotationZ,
    RotationW,
    Scale,   ///< [1] of lengths, > 0
    Density, ///< [1] factor of optical depths, >= 0
    Age,     ///< [s] since the birth of the block; kSettledAge: it has no birth
    Variant, ///< number of the variant that the block shows
    Count
};
}

/// Indices of the constants of a group of the kind "block".
namespace block_constant {
enum : size_t
{
    Owner,   ///< variant that consists of these blocks; kNoOwner: they are the blocks of the effect
    Blocks,  ///< number of blocks at all levels; only with kNoOwner
    Refused, ///< number of balls beyond the effect's bound, which are missing; only with kNoOwner
    Seconds, ///< [s] local time of animated content; 0 if no content is animated; only with kNoOwner
    Count
};
}

/// Indices of the constants of a group of the kind "blockBall". Its columns are those of the kind "blob".
namespace block_ball_constant {
enum : size_t
{
    Variant,
    ShadeR, ///< [1] as blob_constant::ShadeR
    ShadeG,
    ShadeB,
    Count
};
}

constexpr float kNoOwner = -1.0f;
constexpr float kSettledAge = 1e6f;      ///< [s] age of what has always been there
constexpr uint32_t kMaxBlockTypes = 64;  ///< of one solver
constexpr uint32_t kMaxBlockPhases = 16; ///< of one type
constexpr uint32_t kMaxBlockLevels = 4;  ///< of blocks above balls
constexpr uint32_t variantOf(uint32_t type, uint32_t phase)
{
    return type * kMaxBlockPhases + phase;
}
constexpr uint32_t kMaxBlockVariants = variantOf(kMaxBlockTypes, 0);

inline constexpr ColumnDesc kBlockColumns[block_column::Count] = {
    {"x", "m"},     {"y", "m"},         {"z", "m"},         {"vx", "m/s"},      {"vy", "m/s"},
    {"vz", "m/s"},  {"rotationX", "1"}, {"rotationY", "1"}, {"rotationZ", "1"}, {"rotationW", "1"},
    {"scale", "1"}, {"density", "1"},   {"age", "s"},       {"variant", "1"},
};

inline constexpr ColumnDesc kBlockConstants[block_constant::Count] = {
    {"owner", "1"}, {"blocks", "1"}, {"refused", "1"}, {"seconds", "s"}};

inline constexpr ColumnDesc kBlockBallConstants[block_ball_constant::Count] = {
    {"variant", "1"}, {"shadeR", "1"}, {"shadeG", "1"}, {"shadeB", "1"}};

inline constexpr KindDesc kBlockKind{"block", kBlockColumns, kBlockConstants};
inline constexpr KindDesc kBlockBallKind{"blockBall", kBlobColumns, kBlockBallConstants};
inline constexpr KindDesc kBlockMaterialKind{"blockMaterial", kMaterialColumns, kMaterialConstants};

} // namespace fx::base
