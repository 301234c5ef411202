/// @file slab_tiles.h
/// Finds the tiles of the layers that each ball may cover.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

constexpr int kSlabTile = 16; ///< [texel] side of a tile; shaders in shaders/slabs use an equal constant

/// Range of the tiles that a ball may cover. The first and the last column and row are included.
/// shaders/slabs/slab_tiles.comp.glsl reads this layout. If left > right, the ball is outside of the
/// picture.
struct TileRect
{
    uint16_t left, right; ///< columns
    uint16_t low, high;   ///< rows, numbered upwards
    /// Rank of the ball (BlobInstance::layer), times 2^32. A tile with too many balls lists those with the
    /// lowest ranks.
    uint32_t rank;
};
static_assert(sizeof(TileRect) == 12);

/// Fills `outRects` with one rectangle per ball. The eye may be inside of balls.
/// @param view view block of the layers, with the size of the layers [texel] and the least radius of a ball
/// @return total number of tiles in all rectangles
uint64_t findTiles(std::span<const BlobInstance> balls, const ViewBlock& view,
                   std::pmr::vector<TileRect>& outRects);

} // namespace fx::render
