/// @file tiled_picture.h
/// Renders the missing tiles of a picture on several threads, with a journal, progress and interruption.
#pragma once

#include "foundation/tasks/task_runner.h"
#include "rendering/reference/render/tile_journal.h"
#include "rendering/reference/trace/tile_walk.h"

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <vector>

namespace fx::render {

/// Callbacks of a long render. Any thread may call the callbacks.
struct RenderCallbacks
{
    /// Receives the number of finished tiles and the number of all tiles. Calls do not overlap. The function
    /// may be empty.
    std::function<void(uint32_t done, uint32_t total)> progress;
    /// Returns true to stop rendering. Several threads call the function often and at the same time. It may
    /// be empty.
    std::function<bool()> shouldStop;
};

class TiledPicture
{
public:
    /// A function that renders the pixels of `block`, row by row from the top, with all channels of a pixel
    /// together. Several threads call the function at the same time.
    /// @return false if rendering was stopped; `out` is then not used
    using RenderTile = std::function<bool(const PixelBlock& block, std::span<float> out)>;

    /// Starts a picture without tiles.
    /// @param edge [pixel] side of a tile; if the process is killed, the tiles in progress are lost
    void start(int width, int height, int edge, uint32_t channels);
    uint32_t tileCount() const { return tilesX_ * tilesY_; }

    /// Sets the values of a tile that an earlier run has rendered. The values are ignored if their number or
    /// the tile number is invalid.
    void restore(uint32_t tile, std::span<const float> values);
    /// Renders the missing tiles.
    /// @param journal receives each finished tile; may be null
    /// @return Interrupted if `callbacks` requested it, or the error of the journal
    base::Status render(base::TaskRunner& tasks, const RenderTile& renderTile, TileJournal* journal,
                        const RenderCallbacks& callbacks);

    /// The values of one channel, width x height, top row first.
    const std::vector<float>& pixels(uint32_t channel) const { return planes_[channel]; }
    /// The values of four channels, interleaved by pixel. `first` is the first channel.
    std::vector<float> interleaved(uint32_t first) const;

private:
    PixelBlock blockOf(uint32_t tile) const;
    void place(uint32_t tile, std::span<const float> values);
    void stop();
    void renderOne(uint32_t tile, const RenderTile& renderTile, TileJournal* journal,
                   const RenderCallbacks& callbacks);

    int width_ = 0, height_ = 0, edge_ = 1; ///< [pixel]
    uint32_t tilesX_ = 0, tilesY_ = 0;
    std::vector<std::vector<float>> planes_;
    std::vector<uint8_t> isDone_;

    std::mutex mutex_; ///< guards the members below, and calls of the callbacks
    uint32_t done_ = 0;
    base::Status status_;
};

} // namespace fx::render
