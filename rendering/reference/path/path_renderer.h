/// @file path_renderer.h
/// Renders a picture by path tracing, with tiles on several threads, a journal of finished tiles, and the
/// variance of every pixel.
///
/// Light of sun, lamps, sky, glowing gas and luminous particles is scattered by media and reflected by
/// diffuse triangles any number of times. Camera rays that hit nothing show the background of the scene. All
/// other rays that escape receive the luminance of the sky above the horizon. Below the horizon they receive
/// the light that the ground reflects with Lighting::groundAlbedo. The picture has the same bits for any
/// number of threads and any number of runs.
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
    int width = 640;  ///< [pixel] 1..16384
    int height = 360; ///< [pixel] 1..16384
    uint32_t samples =
        64; ///< number of paths per pixel, 1..2^24; if `error` is not 0, this is an upper limit
    /// [1] Requested standard error of pixels, as a root mean square over a tile, in the unit of written
    /// values. 0: all pixels have `samples` paths. A tile first traces kPilotSamples pilot paths per pixel,
    /// whose variance gives the required number of paths. The pilot paths are not part of the picture,
    /// because they would bias the mean.
    double error = 0.0;
    double exposure = 1.0;      ///< [m2/cd] exposure: written value divided by luminance
    double sunRadius = 0.00465; ///< [rad] angular radius of the sun, 0..pi/2
    uint64_t seed = 1;
    PathSettings path;
};

/// Values of a pixel, in this order.
namespace path_channel {
enum : uint32_t
{
    /// RGBA, linear and exposed; A is 1 in front of triangles and background, else the medium's opacity.
    Color,
    Variance = 4, ///< RGB: variance of the mean, which is the square of the standard error
    Samples = 7,  ///< number of paths of the pixel
    Count
};
}

/// Work counters.
struct PathWork
{
    uint64_t paths = 0;
    uint64_t collisions = 0; ///< number of tentative collisions
    uint64_t nonFinite = 0;  ///< number of paths whose result was not finite; they count as black
};

class PathRenderer
{
public:
    static constexpr uint32_t kPilotSamples = 16;

    PathRenderer();
    ~PathRenderer();

    /// Builds the data shared by all tiles. `tasks` and the spans of `scene` must outlive the renderer.
    /// @return InvalidArgument if a number is outside of its range
    base::Status build(const ReferenceScene& scene, const PathPictureSettings& settings,
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

    /// The values of one channel (see path_channel), width x height, top row first.
    const std::vector<float>& pixels(uint32_t channel) const { return tiles_.pixels(channel); }
    std::vector<float> interleaved(uint32_t first) const { return tiles_.interleaved(first); }
    PathWork work() const; ///< work of this run, without earlier runs
    /// [1] Standard error of written values, as a root mean square over all pixels and color channels.
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
