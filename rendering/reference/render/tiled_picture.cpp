#include "rendering/reference/render/tiled_picture.h"

#include <algorithm>
#include <utility>

namespace fx::render {

void TiledPicture::start(int width, int height, int edge, uint32_t channels)
{
    width_ = width;
    height_ = height;
    edge_ = edge;
    tilesX_ = uint32_t((width + edge - 1) / edge);
    tilesY_ = uint32_t((height + edge - 1) / edge);
    planes_.assign(channels, std::vector<float>(size_t(width) * size_t(height), 0.0f));
    isDone_.assign(tileCount(), 0);
    done_ = 0;
    status_ = {};
}

PixelBlock TiledPicture::blockOf(uint32_t tile) const
{
    const int x = int(tile % tilesX_) * edge_;
    const int y = int(tile / tilesX_) * edge_;
    return {x, y, std::min(x + edge_, width_), std::min(y + edge_, height_)};
}

void TiledPicture::place(uint32_t tile, std::span<const float> values)
{
    const PixelBlock block = blockOf(tile);
    size_t from = 0;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
            for (std::vector<float>& plane : planes_)
                plane[size_t(y) * size_t(width_) + size_t(x)] = values[from++];
    isDone_[tile] = 1;
}

void TiledPicture::restore(uint32_t tile, std::span<const float> values)
{
    if (tile >= tileCount() || isDone_[tile])
        return;
    const PixelBlock block = blockOf(tile);
    const size_t pixels = size_t(block.x1 - block.x0) * size_t(block.y1 - block.y0);
    if (values.size() != pixels * planes_.size())
        return;
    place(tile, values);
    ++done_;
}

void TiledPicture::stop()
{
    const std::lock_guard lock(mutex_);
    if (status_.ok())
        status_ = {base::Code::Interrupted, "interrupted"};
}

void TiledPicture::renderOne(uint32_t tile, const RenderTile& renderTile, TileJournal* journal,
                             const RenderCallbacks& callbacks)
{
    if (callbacks.shouldStop && callbacks.shouldStop())
        stop();
    {
        const std::lock_guard lock(mutex_);
        if (!status_.ok())
            return;
    }
    const PixelBlock block = blockOf(tile);
    std::vector<float> values(size_t(block.x1 - block.x0) * size_t(block.y1 - block.y0) * planes_.size());
    if (!renderTile(block, values))
        return stop();
    place(tile, values);
    base::Status written = journal ? journal->append(tile, values) : base::Status();
    const std::lock_guard lock(mutex_);
    ++done_;
    if (status_.ok() && !written.ok())
        status_ = std::move(written);
    if (callbacks.progress)
        callbacks.progress(done_, tileCount());
}

base::Status TiledPicture::render(base::TaskRunner& tasks, const RenderTile& renderTile, TileJournal* journal,
                                  const RenderCallbacks& callbacks)
{
    status_ = {};
    tasks.parallelFor(tileCount(), 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t tile = begin; tile < end; ++tile)
            if (!isDone_[tile])
                renderOne(tile, renderTile, journal, callbacks);
    });
    return status_;
}

std::vector<float> TiledPicture::interleaved(uint32_t first) const
{
    std::vector<float> result(planes_[first].size() * 4);
    for (size_t i = 0; i < planes_[first].size(); ++i)
        for (uint32_t c = 0; c < 4; ++c)
            result[4 * i + c] = planes_[first + c][i];
    return result;
}

} // namespace fx::render
