/// @file slab_tiles.h
/// Which tiles of the layers each ball may cover.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

constexpr int kSlabTile = 16; ///< [texel] side; also in shaders/slabs

/// First and last tile of a ball, both included; layout of shaders/slabs/slab_tiles.comp.glsl. left > right:
/// it is beside the picture.
struct TileRect
{
    uint16_t left, right; ///< columns
    uint16_t low, high;   ///< rows, upwards
    uint32_t rank;        ///< stays with the ball; of a crowded tile those with the lowest are listed
};
static_assert(sizeof(TileRect) == 12);

/// Fills `outRects` with one for each ball. The eye may be inside of balls.
/// @param view of the layers, whose size [texel] and least radius it has
/// @return tiles of all rectangles
uint64_t findTiles(std::span<const BlobInstance> balls, const ViewBlock& view,
                   std::pmr::vector<TileRect>& outRects);

} // namespace fx::render
