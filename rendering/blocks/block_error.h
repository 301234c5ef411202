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
/// Between the powers of 2; beyond them errors are proportional to the density, which is what they are in
/// thin content and never less than they are in dense content.
TileError errorAt(const TileErrors& errors, float density);
/// @param t 0: `a`, 1: `b`
TileErrors errorsBetween(const TileErrors& a, const TileErrors& b, float t);

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
    explicit BlockErrors(std::pmr::memory_resource* memory) : entries_(memory), balls_(memory) {}

    /// @param isSpread false: all contents are predicted when they are needed
    void begin(bool isSpread);
    /// The errors of a content; null if it is predicted in a later frame. Content that is not predicted yet
    /// is predicted before animated content that is due, and of this the one first that has waited longest.
    /// @param seconds local time of animated content, which is predicted anew every kSeconds
    const TileErrors* find(uint32_t variant, const BlockContents& contents, double seconds);
    uint32_t deferred() const { return deferred_; } ///< contents that find() has left to later frames
    /// [frame] age of the oldest prediction that is due and left to later frames
    uint32_t longestWait() const { return uint32_t(oldestLeft_); }
    void forget(); ///< discards all predictions

    static constexpr double kSeconds = 0.25; ///< [s] in which a prediction changes to the next one

private:
    struct Entry
    {
        TileErrors from, to, shown; ///< `shown` lies between the others
        double seconds = 0.0;       ///< local time of `to`
        uint64_t frame = 0;         ///< in which it was last used
        uint64_t made = 0;          ///< frame in which `to` was predicted
    };

    bool canPredict(const Entry* known);
    void predict(uint32_t variant, const BlockContents& contents, TileErrors& out);

    std::pmr::unordered_map<uint64_t, Entry> entries_; ///< by the identity of the content
    std::pmr::vector<BlockBall> balls_;
    uint64_t frame_ = 0;
    uint64_t work_ = 0; ///< of the predictions of this frame
    bool isSpread_ = true;
    uint32_t deferred_ = 0;
    bool isNewLeft_ = false, wasNewLeft_ = false;    ///< new content waits since this frame, the last one
    uint64_t oldestLeft_ = 0, oldestLeftBefore_ = 0; ///< [frame] age of what this frame, the last one left
};

} // namespace fx::render
