#include "rendering/reference/trace/tile_walk.h"

namespace fx::render {

namespace {

PixelRect rectOf(const PixelBlock& block)
{
    return {double(block.x0), double(block.y0), double(block.x1), double(block.y1)};
}

} // namespace

void TileWalk::collect(const BallTree& tree, const RayGrid& grid, const PixelBlock& tile, double farthest)
{
    candidates_[0].collect(tree, frustumOf(grid, rectOf(tile), farthest));
}

void TileWalk::narrow(const RayGrid& grid, const PixelBlock& part, double farthest, int level)
{
    candidates_[size_t(level)].narrow(candidates_[size_t(level) - 1],
                                      frustumOf(grid, rectOf(part), farthest));
}

} // namespace fx::render
