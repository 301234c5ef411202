#include "benchmarks/scenes/detail_scene.h"

#include "benchmarks/scenes/lit_media.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/trace/ray_query.h"

#include <array>

namespace fx::cli {

namespace {

constexpr double kDepthTolerance = 2e-3; ///< [1] of transmittances
constexpr double kSlope = 0.29;          ///< tangent of half the field of view
constexpr std::array<DetailSubject, 3> kSubjects{
    {{"explosion-0.6", "explosion", 0.6, 3.9, 4.3, 0.1, 1.25},
     {"explosion-1.5", "explosion", 1.5, 7.2, 5.4, 1.25, 4.7},
     {"smoke-column", "smoke-column", 4.0, 5.0, 6.0, 1.0, 12.5}}};

} // namespace

std::span<const DetailSubject> detailSubjects()
{
    return kSubjects;
}

base::Result<std::unique_ptr<DetailScene>> DetailScene::create(const DetailSubject& subject, double time)
{
    std::unique_ptr<DetailScene> scene(new DetailScene(subject));
    auto file = sceneOfPreset(std::string("library:") + subject.preset);
    if (!file.ok())
        return file.status();
    scene->file_ = std::move(*file);
    auto effects = EffectScene::create(scene->file_, {});
    if (!effects.ok())
        return effects.status();
    scene->effects_ = std::move(*effects);
    if (base::Status status = scene->show(time); !status)
        return status;
    return scene;
}

base::Status DetailScene::show(double time)
{
    if (base::Status status = effects_->showMoment(base::toTicks(time)); !status)
        return status;
    const auto moment = effects_->moment();
    if (!moment.ok())
        return moment.status();
    moment_ = *moment;
    return {};
}

render::ReferenceCamera DetailScene::camera(bool isParallel) const
{
    const glm::dvec3 eye(0.0, subject_.height - 0.12 * subject_.half, 1.02 * subject_.half / kSlope);
    auto camera =
        render::ReferenceCamera::lookAt(eye, {0.0, subject_.height, 0.0}, glm::dvec3(0.0, 1.0, 0.0));
    camera.orthographic = isParallel;
    camera.halfHeight = isParallel ? subject_.half : kSlope;
    camera.nearDistance = 1e-3;
    return camera;
}

render::ReferenceScene DetailScene::reference(int octaves) const
{
    render::MediumList medium = render::mediumOf(moment_.snapshots, moment_.interpolation);
    render::ReferenceScene scene;
    scene.blobs = std::move(medium.blobs);
    if (octaves > 0) {
        scene.details = std::move(medium.details);
        scene.details.octaves = octaves;
    }
    scene.opaque.isEmpty = true;
    scene.opaque.lighting = daylight();
    scene.camera = camera();
    return scene;
}

render::ViewSettings detailViewSettings()
{
    render::ViewSettings settings;
    settings.lighting = daylight();
    settings.exposureEv100 = 14.5f;
    settings.shimmer.strength = 0.0f;
    settings.dazzle.enabled = false;
    settings.toneMap = false;
    settings.composition = render::Composition::Volume;
    return settings;
}

std::vector<float> integratedDepth(const render::ReferenceScene& scene, int side, int pixels)
{
    constexpr double kFar = 1e30; // [m]
    const std::unique_ptr<base::TaskRunner> tasks = base::makeTbbRunner();
    render::MediumView medium;
    medium.build(scene.blobs, scene.camera.eye, *tasks, scene.details,
                 render::PixelWidth(scene.camera, pixels));
    const render::RayGrid grid = scene.camera.grid(side, side);
    std::vector<float> depths(size_t(side) * size_t(side));
    tasks->parallelFor(uint32_t(side), 1, [&](uint32_t first, uint32_t last) {
        render::DetailedRay integral(medium, render::DetailedRay::Wanted::Depth, kDepthTolerance);
        render::RayHits hits;
        for (uint32_t y = first; y < last; ++y)
            for (int x = 0; x < side; ++x) {
                const render::TraceRay ray = grid.ray(x + 0.5, y + 0.5);
                render::findHits(medium.tree(), ray, 0.0, kFar, hits);
                integral.trace(ray, hits, 0.0, kFar);
                depths[size_t(y) * size_t(side) + size_t(x)] = float(integral.opticalDepth());
            }
    });
    return depths;
}

} // namespace fx::cli
