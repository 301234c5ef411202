/// @file reference_renderer.h
/// Renders a picture by the ray integral, with tiles on several threads and a journal of finished tiles.
///
/// The value of a pixel is the integral of emission and absorption along its ray, through all blobs, up to
/// the nearest triangle. The integral is computed in double or float. These effects of GPU passes are
/// omitted: noise of single balls, multiple scattering, shimmer, glare. Single scattering of the light of
/// sun, lamps, fires and sky is optional. The picture has the same bits for any number of threads, any
/// instruction set, and any number of runs.
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
    /// Builds the data shared by all tiles. `tasks` must outlive the renderer.
    /// @return InvalidArgument if a size, sample count, camera or blob is outside of its range
    base::Status build(const ReferenceScene& scene, const ReferenceSettings& settings,
                       base::TaskRunner& tasks);

    /// Identifies the picture: a hash of all inputs of its pixels.
    uint64_t key() const { return key_; }
    uint32_t tileCount() const { return tiles_.tileCount(); }

    /// Sets the values of a tile that an earlier run has rendered. The values are ignored if their number or
    /// the tile number is invalid.
    void restore(uint32_t tile, std::span<const float> values) { tiles_.restore(tile, values); }
    /// Renders the missing tiles.
    /// @param journal receives each finished tile; may be null
    /// @return Interrupted if `callbacks` requested it, or the error of the journal
    base::Status render(TileJournal* journal, const RenderCallbacks& callbacks);

    /// The values of one channel (see reference_channel), width x height, top row first.
    const std::vector<float>& pixels(uint32_t channel) const { return tiles_.pixels(channel); }
    /// The values of four channels, interleaved by pixel. `first` is the first channel.
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

    std::mutex mutex_; ///< guards the member `idle_`
    std::vector<std::unique_ptr<TileRenderer>> idle_;
};

} // namespace fx::render
