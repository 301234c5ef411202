/// @file reference_renderer.h
/// A picture by the ray integral: tiles over threads, with a journal of what is done.
///
/// Every pixel is the integral of emission and absorption along its ray, through all blobs in double (or
/// float), up to the nearest triangle. What the GPU passes add for looks is left out: procedural detail,
/// scattering more than once, shimmer, glare. Light of sun, lamps, fires and sky that is scattered once is
/// an option. The picture has the same bits for any number of threads, any instruction set, and whether it
/// was made in one run or in several.
#pragma once

#include "rendering/reference/render/reference_scene.h"
#include "rendering/reference/render/tile_renderer.h"
#include "rendering/reference/render/tiled_picture.h"

#include <mutex>
#include <vector>

namespace fx::render {

class ReferenceRenderer
{
public:
    /// Builds what all tiles share. `tasks` must outlive the renderer.
    /// @return InvalidArgument for a size, sample count, camera or blob outside its range
    base::Status build(const ReferenceScene& scene, const ReferenceSettings& settings,
                       base::TaskRunner& tasks);

    /// Identifies the picture: a hash of everything that its pixels depend on.
    uint64_t key() const { return key_; }
    uint32_t tileCount() const { return tiles_.tileCount(); }

    /// Takes over a tile of an earlier run; ignored unless number and length are possible.
    void restore(uint32_t tile, std::span<const float> values) { tiles_.restore(tile, values); }
    /// Renders the tiles that are missing.
    /// @param journal receives each tile, may be null
    /// @return Interrupted on request, or the error of the journal
    base::Status render(TileJournal* journal, const RenderCallbacks& callbacks);

    /// One channel after another (see reference_channel), each width x height, rows from the top.
    const std::vector<float>& pixels(uint32_t channel) const { return tiles_.pixels(channel); }
    /// Four channels of each pixel together, beginning with `first`.
    std::vector<float> interleaved(uint32_t first) const { return tiles_.interleaved(first); }
    const ReferenceWork& work() const { return work_; }

private:
    std::unique_ptr<TileRenderer> borrow();
    void giveBack(std::unique_ptr<TileRenderer> renderer);

    base::TaskRunner* tasks_ = nullptr;
    ReferencePicture picture_;
    uint64_t key_ = 0;
    TiledPicture tiles_;
    ReferenceWork work_;

    std::mutex mutex_; ///< guards `idle_`
    std::vector<std::unique_ptr<TileRenderer>> idle_;
};

} // namespace fx::render
