/// @file block_errors.h
/// Chooses tiles by their predicted errors, and keeps the predictions of a view.
#pragma once

#include "rendering/blocks/tile_error.h"

#include <cstdint>
#include <memory_resource>
#include <unordered_map>
#include <vector>

namespace fx::render {

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
    float least = 0.0f;    ///< [1] predicted error of the finest tile that it may have, in units of white
};
/// How a block is seen.
struct TileView
{
    float pixels = 96.0f;  ///< [pixel] diameter on the picture
    float nearness = 0.0f; ///< [1] radius over distance
    int finest = kMaxTile; ///< [texel] largest side of its tile
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
    /// @param seconds local time of animated content, which is predicted again every kSeconds
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
