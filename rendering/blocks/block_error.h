/// @file block_error.h
/// Predicts how exactly tiles show the content of a block, and chooses tiles by it.
#pragma once

#include "rendering/blocks/block_contents.h"
#include "rendering/blocks/block_tiles.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <unordered_map>
#include <vector>

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
};

/// Errors by the factor of density, in powers of 2 from 2^-kDensityPower to 2^kDensityPower.
constexpr int kDensityPower = 4;
using TileErrors = std::array<TileError, 2 * kDensityPower + 1>;

/// Predicts the errors by rays through the balls. Cost: a bounded number of rays, and for each of them one
/// comparison with each ball.
TileErrors predictTileErrors(std::span<const BlockBall> balls, float radius, bool isColored);
/// Between the powers of 2; thinner than the least, errors are proportional to the density.
TileError errorAt(const TileErrors& errors, float density);

/// What a picture shows of a content.
struct TileSource
{
    float exposure = 1.0f; ///< [m2/cd]
    float value = 1.0f;    ///< [1] that it shows where it is opaque, in units of white
};
TileSource sourceOf(const BlockContent& content, float exposure);

/// The coarsest tile whose error is within a limit.
struct TileChoice
{
    int texels = kMinTile; ///< side of the tile
    float angle = 0.0f;    ///< [rad] largest difference of directions
    float least = 0.0f;    ///< [1] predicted error of the finest tile, in units of white
};
/// How a block is seen.
struct TileView
{
    float pixels = 96.0f;  ///< [pixel] diameter on the picture
    float nearness = 0.0f; ///< [1] radius over distance
};
/// @param limit [1] in units of white, > 0
TileChoice chooseTile(const TileError& error, const TileSource& source, const TileView& view, float limit);

/// Predictions of one view.
class BlockErrors
{
public:
    explicit BlockErrors(std::pmr::memory_resource* memory) : balls_(memory) {}

    /// @param isSpread false: all contents are predicted when they are needed
    void begin(bool isSpread);
    /// The errors of a content; null if it is predicted in a later frame.
    /// @param seconds local time of animated content, which is predicted anew every kSeconds
    const TileErrors* find(uint32_t variant, const BlockContents& contents, double seconds);
    uint32_t deferred() const { return deferred_; } ///< contents that find() has left to later frames

    static constexpr double kSeconds = 0.25; ///< [s] in which a prediction changes to the next one

private:
    struct Entry
    {
        TileErrors from, to, shown; ///< `shown` lies between the others
        double seconds = 0.0;       ///< local time of `to`
        uint64_t frame = 0;         ///< in which it was last used
    };

    void predict(uint32_t variant, const BlockContents& contents, TileErrors& out);

    std::unordered_map<uint64_t, Entry> entries_; ///< by the identity of the content
    std::pmr::vector<BlockBall> balls_;
    uint64_t frame_ = 0;
    uint64_t work_ = 0; ///< balls that were predicted in this frame
    bool isSpread_ = true;
    uint32_t deferred_ = 0;
};

} // namespace fx::render
