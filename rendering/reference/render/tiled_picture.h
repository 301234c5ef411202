/// @file tiled_picture.h
/// The tiles of a picture over threads: which are missing, their journal, progress and interruption.
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

/// Callbacks of a long render. Called from any thread.
struct RenderCallbacks
{
    std::function<void(uint32_t done, uint32_t total)> progress; ///< may be empty; one call at a time
    std::function<bool()> shouldStop; ///< may be empty; called often, by several threads at once
};

class TiledPicture
{
public:
    /// Renders the pixels of `block`, row by row from the top, each with all channels; called by several
    /// threads.
    /// @return false when it was stopped: `out` is not used
    using RenderTile = std::function<bool(const PixelBlock& block, std::span<float> out)>;

    /// Starts a picture without any tile. @param edge [pixel] of a tile, the part that a killed process loses
    void start(int width, int height, int edge, uint32_t channels);
    uint32_t tileCount() const { return tilesX_ * tilesY_; }

    /// Takes over a tile of an earlier run; ignored unless number and length are possible.
    void restore(uint32_t tile, std::span<const float> values);
    /// Renders the tiles that are missing.
    /// @param journal receives each tile, may be null
    /// @return Interrupted on request, or the error of the journal
    base::Status render(base::TaskRunner& tasks, const RenderTile& renderTile, TileJournal* journal,
                        const RenderCallbacks& callbacks);

    /// Of one channel, width x height, rows from the top.
    const std::vector<float>& pixels(uint32_t channel) const { return planes_[channel]; }
    /// Four channels of each pixel together, beginning with `first`.
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

    std::mutex mutex_; ///< guards the members below and the callbacks
    uint32_t done_ = 0;
    base::Status status_;
};

} // namespace fx::render
