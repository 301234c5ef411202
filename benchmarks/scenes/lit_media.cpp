#include "benchmarks/scenes/lit_media.h"

#include "benchmarks/scenes/slice_forms.h"
#include "fxsdk/cli/render/reference_scene.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "rendering/frame/exposure.h"
#include "rendering/reference/path/path_renderer.h"
#include "rendering/reference/render/reference_renderer.h"

#include <glm/geometric.hpp>

#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

namespace fx::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kCovered = 0.01; ///< [1] opacity from which on a pixel is covered

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

render::ReferenceScene sceneOf(std::span<const render::MediumBlob> blobs, const LitView& view)
{
    render::ReferenceScene scene;
    scene.blobs.assign(blobs.begin(), blobs.end());
    scene.opaque.isEmpty = true;
    scene.opaque.lighting = view.lighting;
    scene.camera = cameraOf(view);
    return scene;
}

/// @param rgba four values a pixel, rows from the top
LitPicture pictureOf(const std::vector<float>& rgba)
{
    LitPicture picture;
    for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
        picture.light.emplace_back(rgba[i], rgba[i + 1], rgba[i + 2]);
        picture.opacity.push_back(double(rgba[i + 3]));
    }
    return picture;
}

/// Builds and renders all tiles of a renderer without a GPU, whose color comes first of its channels.
template <class Renderer, class Settings>
base::Result<LitPicture> rendered(Renderer& renderer, const render::ReferenceScene& scene,
                                  const Settings& settings, const std::function<bool()>& stop)
{
    const Clock::time_point start = Clock::now();
    const std::unique_ptr<base::TaskRunner> tasks = base::makeTbbRunner();
    if (base::Status status = renderer.build(scene, settings, *tasks); !status)
        return status;
    if (base::Status status = renderer.render(nullptr, {{}, stop}); !status)
        return status;
    LitPicture picture = pictureOf(renderer.interleaved(0));
    picture.seconds = secondsSince(start);
    return picture;
}

} // namespace

render::ReferenceCamera cameraOf(const LitView& view)
{
    auto camera = render::ReferenceCamera::lookAt(view.eye, view.target, glm::dvec3(0.0, 1.0, 0.0));
    camera.halfHeight = std::tan(view.fovYDegrees * std::numbers::pi / 360.0);
    camera.nearDistance = 1e-3;
    return camera;
}

render::Lighting daylight()
{
    render::Lighting light;
    light.sunDirection = glm::normalize(glm::vec3(-0.5f, 0.6f, 0.6f));
    light.sunIlluminance = {60000.0f, 57000.0f, 50000.0f};
    light.skyLuminance = {3000.0f, 3600.0f, 4500.0f};
    light.groundAlbedo = 0.25f;
    return light;
}

base::Result<std::vector<render::MediumBlob>> presetMedia(const std::string& name, double time)
{
    const auto scene = sceneOfPreset("library:" + name);
    if (!scene.ok())
        return scene.status();
    auto source = ReferenceSceneSource::create(*scene, {});
    if (!source.ok())
        return source.status();
    auto frame = (*source)->frameAt(base::toTicks(time));
    if (!frame.ok())
        return frame.status();
    return std::move(frame->scene.blobs);
}

std::vector<render::MediumBlob> blobsOf(const BallOfMedia& ball)
{
    std::vector<render::MediumCaster> casters = lightCloud(ball.blobs, 1.0);
    for (render::MediumCaster& caster : casters)
        caster = {caster.center * float(1.0 - ball.radius), float(ball.radius), 1.0f};
    const double crossSection = ball.depth / meanDiameter(casters);
    std::vector<render::MediumBlob> blobs;
    for (const render::MediumCaster& caster : casters) {
        render::MediumBlob blob;
        blob.center = glm::dvec3(caster.center);
        blob.radius = ball.radius;
        blob.crossSection = crossSection;
        blob.albedo = glm::dvec3(ball.albedo);
        blob.anisotropy = ball.anisotropy;
        blobs.push_back(blob);
    }
    return blobs;
}

base::Result<std::unique_ptr<LitPainter>> LitPainter::create(int width, int height)
{
    std::unique_ptr<LitPainter> painter(new LitPainter(width, height));
    auto renderer = BlobListRenderer::create({}, {}, width, height);
    if (!renderer.ok())
        return renderer.status();
    painter->renderer_ = std::move(*renderer);
    if (base::Status status = painter->renderer_->pictures().warmUp(); !status) // pictures are timed
        return status;
    return painter;
}

base::Result<LitPicture> LitPainter::paint(std::span<const render::MediumBlob> blobs, const LitView& view,
                                           const render::SliceSettings& slices)
{
    shown_.assign(blobs.begin(), blobs.end());
    renderer_->show(shown_);
    render::ViewSettings& settings = renderer_->pictures().settings();
    settings.exposureEv100 = view.exposureEv100;
    settings.lighting = view.lighting;
    settings.slices = slices;
    settings.shimmer.strength = 0.0f;
    settings.dazzle.enabled = false;
    const Clock::time_point start = Clock::now();
    if (base::Status status = renderer_->render(cameraOf(view), 0.0); !status)
        return status;
    LitPicture picture = pictureOf(renderer_->pictures().read().color.pixels); // waits for OpenGL
    picture.seconds = secondsSince(start);
    return picture;
}

base::Result<LitPicture> integrated(std::span<const render::MediumBlob> blobs, const LitView& view,
                                    const LitSize& size, const std::function<bool()>& stop)
{
    render::ReferenceSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.exposure = double(render::exposureFromEv100(view.exposureEv100));
    settings.scattering = render::ScatteringMode::Single;
    settings.skyRings = size.skyRings;
    settings.samples = size.rays;
    render::ReferenceRenderer renderer;
    return rendered(renderer, sceneOf(blobs, view), settings, stop);
}

base::Result<LitPicture> traced(std::span<const render::MediumBlob> blobs, const LitView& view,
                                const LitSize& size, const std::function<bool()>& stop)
{
    render::PathPictureSettings settings;
    settings.width = size.width;
    settings.height = size.height;
    settings.samples = size.paths;
    settings.exposure = double(render::exposureFromEv100(view.exposureEv100));
    render::PathRenderer renderer;
    auto picture = rendered(renderer, sceneOf(blobs, view), settings, stop);
    if (picture.ok())
        picture->variance = renderer.standardError() * renderer.standardError();
    return picture;
}

double relativeError(const LitPicture& picture, const LitPicture& truth, std::vector<double>* outRelative)
{
    double squares = 0.0, light = 0.0;
    std::vector<double> differences;
    for (size_t i = 0; i < truth.light.size(); ++i) {
        if (truth.opacity[i] < kCovered)
            continue;
        const glm::dvec3 difference = picture.light[i] - truth.light[i];
        squares += glm::dot(difference, difference);
        light += glm::dot(truth.light[i], truth.light[i]);
        for (int c = 0; c < 3; ++c)
            differences.push_back(difference[c]);
    }
    if (differences.empty())
        return 0.0;
    const double noise = truth.variance * double(3 * truth.light.size()); // all of it is where media are
    const double scale = std::sqrt(std::max(light - noise, 1e-30) / double(differences.size()));
    if (outRelative)
        for (const double difference : differences)
            outRelative->push_back(difference / scale);
    return std::sqrt(std::max(squares - noise, 0.0) / double(differences.size())) / scale;
}

double meanLight(const LitPicture& picture)
{
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& light : picture.light)
        sum += light;
    return (sum.x + sum.y + sum.z) / (3.0 * double(picture.light.size()));
}

} // namespace fx::cli
