/// @file lit_media.h
/// Media lit by sun and sky, and their pictures by OpenGL, by the ray integral with exact single scattering,
/// and by path tracing. The pictures are used in measurements of the lighting of media. The pictures have no
/// background, procedural detail and post-processing.
///
/// Threads: only the thread that created the object, which is its GL thread.
#pragma once

#include "fxsdk/cli/render/blob_list_renderer.h"
#include "rendering/reference/render/reference_scene.h"

#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {

/// Eye position and light.
struct LitView
{
    glm::dvec3 eye{0.0, 0.0, 6.0}; ///< [m]
    glm::dvec3 target{0.0};        ///< [m]
    double fovYDegrees = 24.0;     ///< [degree]
    render::Lighting lighting;
    float exposureEv100 = 14.5f; ///< [EV100]
};

render::ReferenceCamera cameraOf(const LitView& view);

/// The daylight of the scenes in examples/scenes.
render::Lighting daylight();

/// Blobs of a preset of the library at a time. @param name without "library:" @param time [s]
base::Result<std::vector<render::MediumBlob>> presetMedia(const std::string& name, double time);

/// A ball filled with blobs of one substance and size.
struct BallOfMedia
{
    uint32_t blobs = 300;
    double radius = 0.25;    ///< [m] radius of a blob, below 1
    double depth = 1.0;      ///< [1] mean optical depth through the center of the ball, over all directions
    double albedo = 0.9;     ///< [1]
    double anisotropy = 0.0; ///< [1] Henyey-Greenstein g
};

/// Blobs distributed evenly in a ball of radius 1 m around the origin.
std::vector<render::MediumBlob> blobsOf(const BallOfMedia& ball);

/// Size of a picture, and number of samples.
struct LitSize
{
    int width = 96, height = 96; ///< [pixel]
    uint32_t paths = 64;         ///< number of paths per pixel
    int rays = 1;                ///< the ray integral takes the mean of rays x rays rays per pixel
    int skyRings = 3;            ///< the ray integral uses 4 skyRings^2 directions of the sky
};

/// A picture, rows from the top.
struct LitPicture
{
    std::vector<glm::dvec3> light; ///< [1] after exposure
    std::vector<double> opacity;   ///< [1]
    double variance = 0.0;         ///< [1] mean squared standard error over pixels and channels
    double seconds = 0.0;          ///< [s] time of computing the picture
};

/// Draws lists of blobs by OpenGL.
class LitPainter
{
public:
    static base::Result<std::unique_ptr<LitPainter>> create(int width, int height);

    /// Draws a picture of blobs.
    /// @param slices settings of light slices
    base::Result<LitPicture> paint(std::span<const render::MediumBlob> blobs, const LitView& view,
                                   const render::SliceSettings& slices);
    /// Settings of the next picture. paint() sets the members of LitView, slices, shimmer and glare.
    render::ViewSettings& settings() { return renderer_->pictures().settings(); }
    const std::string& rendererName() const { return renderer_->pictures().rendererName(); }

private:
    LitPainter(int width, int height) : width_(width), height_(height) {}

    int width_, height_;
    std::unique_ptr<BlobListRenderer> renderer_;
    std::vector<render::MediumBlob> shown_;
};

/// Picture by the ray integral, with single scattering.  @param stop see RenderCallbacks
base::Result<LitPicture> integrated(std::span<const render::MediumBlob> blobs, const LitView& view,
                                    const LitSize& size, const std::function<bool()>& stop);

/// Picture by path tracing, with paths of any length.
base::Result<LitPicture> traced(std::span<const render::MediumBlob> blobs, const LitView& view,
                                const LitSize& size, const std::function<bool()>& stop);

/// [1] Root mean square difference from a true picture over the pixels that media cover, relative to the root
/// mean square of the light in these pixels. The noise of the true picture is subtracted.
/// @param outRelative receives the difference of each of these pixels and channels, relative to the root mean
/// square of the light; may be null
double relativeError(const LitPicture& picture, const LitPicture& truth,
                     std::vector<double>* outRelative = nullptr);

/// [1] Mean light over all pixels and channels.
double meanLight(const LitPicture& picture);

} // namespace fx::cli
