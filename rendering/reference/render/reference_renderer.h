/// @file reference_renderer.h
/// A picture by the ray integral: tiles over threads, with a journal of what is done.
///
/// Every pixel is the integral of emission and absorption along its ray, through all blobs in double (or
/// float), up to the nearest triangle. What the GPU passes add for looks is left out: procedural detail,
/// scattering more than once, shimmer, glare. Light of sun, fires and sky that is scattered once is an
/// option. The picture has the same bits for any number of threads, any instruction set, and whether it was
/// made in one run or in several.
#pragma once

#include "rendering/reference/render/tile_journal.h"
#include "rendering/reference/render/tile_renderer.h"

#include <functional>
#include <mutex>
#include <vector>

namespace fx::render {

/// All that a picture is made of. Spans in `opaque` must stay valid.
struct ReferenceScene
{
    std::vector<MediumBlob> blobs;
    OpaqueScene opaque;
    ReferenceCamera camera;
};

class ReferenceRenderer
{
public:
    /// Builds what all tiles share. `tasks` must outlive the renderer.
    /// @return InvalidArgument for a size, sample count, camera or blob outside its range
    base::Status build(const ReferenceScene& scene, const ReferenceSettings& settings,
                       base::TaskRunner& tasks);

    /// Identifies the picture: a hash of everything that its pixels depend on.
    uint64_t key() const { return key_; }
    uint32_t tileCount() const { return tilesX_ * tilesY_; }

    /// Called from any thread.
    struct Callbacks
    {
        std::function<void(uint32_t done, uint32_t total)> progress; ///< may be empty; one call at a time
        std::function<bool()>
            shouldStop; ///< may be empty; asked before every few rays, several calls at once
    };

    /// Takes over a tile of an earlier run; ignored unless number and length are possible.
    void restore(uint32_t tile, std::span<const float> values);
    /// Renders the tiles that are missing.
    /// @param journal receives each tile, may be null
    /// @return Interrupted when asked to stop, or what the journal failed with
    base::Status render(TileJournal* journal, const Callbacks& callbacks);

    /// One channel after another (see reference_channel), each width x height, rows from the top.
    const std::vector<float>& pixels(uint32_t channel) const { return planes_[channel]; }
    /// Four channels of each pixel together, beginning with `first`.
    std::vector<float> interleaved(uint32_t first) const;
    const ReferenceWork& work() const { return work_; }

private:
    PixelBlock blockOf(uint32_t tile) const;
    void place(uint32_t tile, std::span<const float> values);
    std::unique_ptr<TileRenderer> borrow();
    void giveBack(std::unique_ptr<TileRenderer> renderer);
    void stop();
    void renderTile(uint32_t tile, TileJournal* journal, const Callbacks& callbacks);

    base::TaskRunner* tasks_ = nullptr;
    ReferencePicture picture_;
    uint64_t key_ = 0;
    uint32_t tilesX_ = 0, tilesY_ = 0;
    int edge_ = 16; ///< [pixel] of a tile: what a killed process has to do again
    std::vector<std::vector<float>> planes_;
    std::vector<uint8_t> isDone_;

    std::mutex mutex_; ///< guards the members below and the callbacks
    std::vector<std::unique_ptr<TileRenderer>> idle_;
    uint32_t done_ = 0;
    base::Status status_;
    ReferenceWork work_;
};

} // namespace fx::render
