/// @file tile_walk.h
/// Visits all rays of a part of a picture, each with the balls that it meets. Large tiles find candidates in
/// the tree, and smaller tiles filter the candidates of larger tiles.
#pragma once

#include "rendering/reference/trace/tile_candidates.h"

#include <array>
#include <functional>
#include <limits>
#include <span>

namespace fx::render {

/// A block of pixels: [x0, x1) x [y0, y1).
struct PixelBlock
{
    int x0, y0, x1, y1;
};

/// Beginning and end of rays.
struct RayLimits
{
    double nearDepth = 0.0; ///< [m] beginning of rays, as a distance along the view axis
    double farthest = std::numeric_limits<double>::infinity(); ///< [m] end of rays, as a ray parameter
};

/// Visits the rays of a block of pixels. Memory is reused in further calls. Each thread needs its own object.
class TileWalk
{
public:
    static constexpr int kLargest = 32; ///< [pixel] side of the tiles that find their candidates in the tree

    /// Divides `block` into blocks of at most `edge` x `edge` pixels, and calls leaf(block, candidates) once
    /// for each small block. Candidates are all balls that rays through the area of the block can meet.
    /// @param edge [pixel] a power of two, at most kLargest
    template <class Leaf>
    void visit(const BallTree& tree, const RayGrid& grid, const PixelBlock& block, double farthest, int edge,
               Leaf&& leaf)
    {
        for (int y = block.y0; y < block.y1; y += kLargest)
            for (int x = block.x0; x < block.x1; x += kLargest) {
                const PixelBlock tile{x, y, std::min(x + kLargest, block.x1),
                                      std::min(y + kLargest, block.y1)};
                collect(tree, grid, tile, farthest);
                divide(grid, tile, farthest, edge, 0, leaf);
            }
    }

    /// Calls ray(x, y, hits) once for the ray through the center of each pixel of `block`.
    template <class Ray>
    void run(const BallTree& tree, const RayGrid& grid, const PixelBlock& block, const RayLimits& limits,
             Ray&& ray)
    {
        visit(tree, grid, block, limits.farthest, 4,
              [&](const PixelBlock& part, const TileCandidates& candidates) {
                  for (int y = part.y0; y < part.y1; ++y)
                      for (int x = part.x0; x < part.x1; ++x) {
                          double lengthPerDepth = 0.0;
                          const TraceRay line = grid.ray(x + 0.5, y + 0.5, &lengthPerDepth);
                          candidates.hits(line, limits.nearDepth * lengthPerDepth, limits.farthest, hits_);
                          ray(x, y, static_cast<const RayHits&>(hits_));
                      }
              });
    }

private:
    static constexpr int kLevels = 6; ///< number of tile sizes: 32, 16, 8, 4, 2, 1
    static constexpr size_t kFew = 8; ///< lists of at most this length are not filtered

    static PixelRect rectOf(const PixelBlock& block)
    {
        return {double(block.x0), double(block.y0), double(block.x1), double(block.y1)};
    }
    void collect(const BallTree& tree, const RayGrid& grid, const PixelBlock& tile, double farthest)
    {
        candidates_[0].collect(tree, frustumOf(grid, rectOf(tile), farthest));
    }
    void narrow(const RayGrid& grid, const PixelBlock& part, double farthest, int level)
    {
        candidates_[size_t(level)].narrow(candidates_[size_t(level) - 1],
                                          frustumOf(grid, rectOf(part), farthest));
    }

    template <class Leaf>
    void divide(const RayGrid& grid, const PixelBlock& tile, double farthest, int edge, int level, Leaf& leaf)
    {
        const int size = kLargest >> level;
        if (size <= edge) {
            leaf(tile, static_cast<const TileCandidates&>(candidates_[size_t(level)]));
            return;
        }
        const int half = size / 2;
        for (int y = tile.y0; y < tile.y1; y += half)
            for (int x = tile.x0; x < tile.x1; x += half) {
                const PixelBlock part{x, y, std::min(x + half, tile.x1), std::min(y + half, tile.y1)};
                narrow(grid, part, farthest, level + 1);
                divide(grid, part, farthest, edge, level + 1, leaf);
            }
    }

    std::array<TileCandidates, kLevels> candidates_;
    RayHits hits_;
};

} // namespace fx::render
