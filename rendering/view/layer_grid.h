/// @file layer_grid.h
/// The texels of layers that are smaller than the picture, and the rays through them.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame/view_types.h"

namespace fx::render {

/// Each texel covers a block of divisor x divisor pixels. The first block begins at window position 0, 0.
/// Blocks at the opposite two borders of the picture may extend beyond the picture. With divisor 1, the rays
/// have the same bits as the rays of the picture.
struct LayerGrid
{
    int divisor;
    int width, height; ///< [texel]
    /// Rays through the centers of blocks. The member pass.x is the smallest radius of a blob divided by its
    /// distance. The value is 0 for divisor 1, because small blobs have already been enlarged by gathering.
    ViewBlock view;
};

/// @param width, height [pixel] size of the picture
/// @param divisor 1, 2 or 4
LayerGrid makeLayerGrid(const CameraView& camera, int width, int height, int divisor);

} // namespace fx::render
