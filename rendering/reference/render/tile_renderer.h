/// @file tile_renderer.h
/// Renders tiles of a picture independently of each other, with the same bits in any order and on any thread.
#pragma once

#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/render/opaque_view.h"
#include "rendering/reference/render/reference_camera.h"
#include "rendering/reference/render/scattered_light.h"
#include "rendering/reference/render/seen_depth.h"
#include "rendering/reference/render/seen_outputs.h"
#include "rendering/reference/render/surface_light.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace fx::render {

/// Method by which single scattering in the medium is computed.
enum class ScatteringMode : uint8_t
{
    None,
    Centers, ///< uses the illumination at the centers of blobs, see blob_light.h
    /// uses shadow rays from points along each ray, see scattered_light.h, and shadow rays from surfaces
    Single
};

struct ReferenceSettings
{
    int width = 640;  ///< [pixel] 1..16384
    int height = 360; ///< [pixel] 1..16384
    /// [1] Square root of the number of rays per pixel, 1..16; a pixel is the mean of its rays.
    int samples = 1;
    double exposure = 1.0; ///< [m2/cd] exposure: written value divided by luminance
    bool isSingle = false; ///< true: integrate in float instead of double
    ScatteringMode scattering = ScatteringMode::None;
    /// Number of rings of directions in each hemisphere, 1..64. ScatteringMode::Single samples the sky in 4
    /// skyRings^2 directions.
    int skyRings = 3;
    IntegralSettings integral;
    /// [1] tolerance e of formula detailed-ray-integral, 1e-6..0.1
    double detailTolerance = 1e-3;
    bool outputs = false; ///< true: also compute reference_channel::InstanceId and the channels after it
    ReferencePast past;   ///< camera and time of the previous frame, for motion

    uint32_t channels() const;
};

/// Values of a pixel, in this order.
namespace reference_channel {
enum : uint32_t
{
    Color, ///< RGBA, linear and exposed; A is 1 in front of opaque surfaces, else the medium's opacity
    Background = 4, ///< RGBA of the opaque scene
    Fire = 8,       ///< RGBA premultiplied
    Smoke = 12,
    Dust = 16,
    Depth = 20,   ///< [m] mean distance of the visible medium, +infinity without medium
    OpticalDepth, ///< [1] optical depth of the medium
    Count,
    /// [1] MediumBlob::instance of the instance with the largest part of the opacity, exact below 2^24; 0
    /// without medium.
    InstanceId = Count,
    MotionX,    ///< [pixel] motion to the right since the previous frame
    MotionY,    ///< [pixel] motion upwards since the previous frame
    FirstDepth, ///< [m] distance at which media begin to be visible, +infinity without medium
    CountWithOutputs
};
}

inline uint32_t ReferenceSettings::channels() const
{
    return outputs ? reference_channel::CountWithOutputs : reference_channel::Count;
}

/// Data shared by all tiles. The data are built once. Then all threads read the data.
struct ReferencePicture
{
    ReferenceSettings settings;
    ReferenceCamera camera;
    MediumView medium;
    OpaqueView opaque;
    SceneLights lights;
};

/// Work counters.
struct ReferenceWork
{
    uint64_t rays = 0;
    uint64_t hits = 0;      ///< number of blobs that rays met
    uint64_t nonFinite = 0; ///< number of pixel values that were replaced because they were not finite

    ReferenceWork& operator+=(const ReferenceWork& other);
};

/// Renders tiles. Each thread needs its own object.
class TileRenderer
{
public:
    explicit TileRenderer(const ReferencePicture& picture);
    ~TileRenderer();

    /// Writes ReferenceSettings::channels() floats for each pixel of `block`, row by row from the top.
    /// @param shouldStop function that is called repeatedly between rays. Rendering stops when the function
    ///         returns true. May be empty
    /// @return false if rendering was stopped; `out` is then invalid
    bool render(const PixelBlock& block, std::span<float> out, const std::function<bool()>& shouldStop);

    const ReferenceWork& work() const { return work_; }

private:
    struct Sample;
    void renderOpaque(const PixelBlock& rays);
    bool renderMedium(const PixelBlock& rays, const std::function<bool()>& shouldStop);
    void addScattered(std::span<Sample* const> samples);
    void renderDetailed(const PixelBlock& rays, const PixelBlock& part, const TileCandidates& candidates);
    void renderBundle(const PixelBlock& rays, const PixelBlock& part, const TileCandidates& candidates);
    Sample& sampleAt(const PixelBlock& rays, int x, int y);
    void writePixel(const PixelBlock& rays, int x, int y, float* out);
    void writeOutputs(const PixelBlock& rays, int x, int y, float* out);
    void seeOutputs(const PixelBlock& rays, int x, int y, DetailedRay* detailed);

    const ReferencePicture& picture_;
    RayGrid grid_;
    TileWalk walk_;
    std::unique_ptr<BundleIntegrator> integrator_;
    SeenDepth seenDepth_;
    SeenOutputs seenOutputs_;
    std::vector<InstanceShare> pixelShares_; ///< scratch memory
    DetailedRay detailed_;
    ScatteredLight scattered_;
    SurfaceLight surfaceLight_;
    Illuminance illuminance_; ///< calls `surfaceLight_`; empty: shading as in rendering/stage
    std::vector<Sample> samples_;
    RayHits hits_;
    RayHits shadowHits_;
    ReferenceWork work_;
};

} // namespace fx::render
