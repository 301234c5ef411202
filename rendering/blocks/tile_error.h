/// @file tile_error.h
/// Predicts how exactly tiles show the content of a block.
#pragma once

#include "rendering/blocks/block_contents.h"
#include "rendering/blocks/block_tiles.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

/// An error over rays.
struct ErrorPart
{
    float rms = 0.0f;  ///< root of the mean square
    float tail = 0.0f; ///< fourth root of the mean fourth power: how much larger the error of few rays may be
};

/// Errors of the tiles of a content at one factor of its density, over rays of an opacity above 0.01 in
/// several directions.
struct TileError
{
    std::array<ErrorPart, kTileSizes> texels{}; ///< [1] of opacity, by interpolation; tiles of kMinTile * 2^i
    ErrorPart shift;  ///< [1/rad] of opacity, by the difference of the direction of a tile to that of rays
    ErrorPart albedo; ///< [1] of the mean albedo that is seen along a ray, times opacity
    ErrorPart light;  ///< [cd/m2] likewise of the emitted light
    float covered = 1.0f; ///< [1] share of the cross section of the block with an opacity above 0.01
    float rays = 1e9f;    ///< [1] number of rays that these errors are of
};

/// Errors by the factor of density, in powers of 2 about the one at which the mean depth is about 1.
constexpr int kDensityPower = 4;
struct TileErrors
{
    std::array<TileError, 2 * kDensityPower + 1> ofPowers{};
    int lowest = -kDensityPower; ///< power of 2 of the first
    uint64_t work = 0;           ///< of the prediction, in comparisons of a ray with a ball
};

/// Predicts the errors by rays through the balls. Rays are aimed at balls where few others meet any. Cost: a
/// bounded number of rays, and for each of them one comparison with each ball.
TileErrors predictTileErrors(std::span<const BlockBall> balls, float radius, bool isColored);
} // namespace fx::render
