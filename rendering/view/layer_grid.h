/// @file layer_grid.h
/// The texels of layers that are smaller than the picture, and the rays through them.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/frame/view_types.h"

namespace fx::render {

/// Each texel covers a block of divisor x divisor pixels. The first block begins at window position 0, 0.
/// Blocks at the other two borders may extend beyond the picture. With divisor 1, results equal those at the
/// size of the picture, bit for bit.
struct LayerGrid
{
    int divisor;
    int width, height; ///< [texel]
    /// Rays through the centers of blocks. view.pass.x is the least radius of a blob over its distance. It is
    /// 0 for divisor 1, because gathering has already enlarged small blobs.
    ViewBlock view;
};

/// @param width, height size of the picture [pixel]
/// @param divisor 1, 2 or 4
LayerGrid makeLayerGrid(const CameraView& camera, int width, int height, int divisor);

} // namespace fx::render
