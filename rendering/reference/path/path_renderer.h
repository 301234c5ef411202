/// @file path_renderer.h
/// Renders a picture by path tracing: tiles over threads, with a journal of finished tiles and the variance
/// of every pixel.
///
/// Light of the scene's sun, lamps and sky, of glowing gas and of shining particles is scattered by media and
/// reflected by diffuse triangles any number of times. Camera rays that hit nothing show the scene's
/// background; other rays that escape hit the sky: its luminance above, light reflected by ground of the
/// lighting's albedo below. The picture has the same bits for any number of threads, and whether it was made
/// in one run or in several.
#pragma once

#include "rendering/reference/path/path_integrator.h"
#include "rendering/reference/render/reference_scene.h"
#include "rendering/reference/render/tiled_picture.h"

#include <atomic>
#include <memory>
#include <vector>

namespace fx::render {

struct PathPictureSettings
{
    int width = 640;       ///< [pixel] 1..16384
    int height = 360;      ///< [pixel] 1..16384
    uint32_t samples = 64; ///< paths of a pixel, 1..2^24; with `error` the most that it may take
    /// [1] standard error that pixels are to have, root mean square over a tile, in the unit of written
    /// values; 0: all pixels take `samples`. A tile first takes kPilotSamples, from whose variance follows
    /// how many the pixels need. The picture is made of other paths: a mean over a number of samples that
    /// depends on the samples is biased.
    double error = 0.0;
    double exposure = 1.0;      ///< [m2/cd] written value per luminance
    double sunRadius = 0.00465; ///< [rad] angular radius of the sun, 0..pi/2
    uint64_t seed = 1;
    PathSettings path;
};

/// Values of a pixel, in this order.
namespace path_channel {
enum : uint32_t
{
    Color, ///< RGBA, linear, exposed; A is 1 in front of triangles and background, or the medium's opacity
    Variance = 4, ///< RGB, of the pixel's mean: the square of its standard error
    Samples = 7,  ///< paths that the pixel took
    Count
};
}

/// Work counters.
struct PathWork
{
    uint64_t paths = 0;
    uint64_t collisions = 0; ///< tentative ones
    uint64_t nonFinite = 0;  ///< paths that gave no number; each counts as black
};

class PathRenderer
{
public:
    static constexpr uint32_t kPilotSamples = 16;

    PathRenderer();
    ~PathRenderer();

    /// Builds the data shared by all tiles. `tasks` and the spans of `scene` must outlive the renderer.
    /// @return InvalidArgument for a number outside its range
    base::Status build(const ReferenceScene& scene, const PathPictureSettings& settings,
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

    /// One channel (see path_channel), width x height, rows from the top.
    const std::vector<float>& pixels(uint32_t channel) const { return tiles_.pixels(channel); }
    std::vector<float> interleaved(uint32_t first) const { return tiles_.interleaved(first); }
    PathWork work() const; ///< of this run; tiles of earlier ones are not counted
    /// [1] root mean square over all pixels and color channels of the standard error of written values
    double standardError() const;

private:
    struct Shared;
    class Tile;
    bool renderTile(const PixelBlock& block, std::span<float> out, const RenderCallbacks& callbacks);

    base::TaskRunner* tasks_ = nullptr;
    PathPictureSettings settings_;
    std::unique_ptr<Shared> shared_;
    uint64_t key_ = 0;
    TiledPicture tiles_;
    std::atomic<uint64_t> paths_ = 0, collisions_ = 0, nonFinite_ = 0;
};

} // namespace fx::render
