/// @file layer_grid.h
/// The texels of layers that are smaller than the picture, and the rays through them.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame/view_types.h"

namespace fx::render {

/// Each texel covers a block of divisor x divisor pixels, the first at window position 0, 0; blocks at the
/// other two borders may reach beyond the picture. Divisor 1 is the picture itself, bit for bit.
struct LayerGrid
{
    int divisor;
    int width, height; ///< [texel]
    /// rays through the middles of the blocks; view.pass.x is the radius of the smallest blob over its
    /// distance, 0 for divisor 1, where blobs are as wide as they must be
    ViewBlock view;
};

/// @param width, height of the picture [pixel]
/// @param divisor 1, 2 or 4
LayerGrid makeLayerGrid(const CameraView& camera, int width, int height, int divisor);

} // namespace fx::render
