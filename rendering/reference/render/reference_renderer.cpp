#include "rendering/reference/render/reference_renderer.h"

#include "rendering/reference/render/blob_light.h"

namespace fx::render {

namespace {

constexpr int kMaxSamples = 16;

uint64_t keyOf(const ReferenceScene& scene, const ReferenceSettings& s, base::TaskRunner& tasks)
{
    KeyHash hash;
    addScene(hash, scene, tasks);
    for (const double number :
         {double(s.width), double(s.height), double(s.samples), s.exposure, double(s.isSingle),
          double(s.scattering), double(s.skyRings), double(s.integral.model), double(s.integral.degree),
          double(s.integral.scheme.method), double(s.integral.scheme.count), s.integral.scheme.cap,
          s.integral.scheme.step, s.integral.scheme.tolerance, s.integral.scheme.stopDepth})
        hash.add(number);
    if (scene.details.isGiven())
        hash.add(s.detailTolerance);
    if (!s.outputs)
        return hash.value();
    for (const MediumBlob& blob : scene.blobs) {
        hash.addWord(blob.instance);
        hash.add(blob.velocity);
    }
    const ReferenceCamera& camera = s.past.camera;
    for (const glm::dvec3& vector : {camera.eye, camera.right, camera.up, camera.forward})
        hash.add(vector);
    for (const double number : {s.past.seconds, camera.halfHeight, double(camera.orthographic)})
        hash.add(number);
    return hash.value();
}

} // namespace

base::Status ReferenceRenderer::build(const ReferenceScene& scene, const ReferenceSettings& settings,
                                      base::TaskRunner& tasks)
{
    if (base::Status status = checkScene(scene, settings.width, settings.height); !status)
        return status;
    if (settings.samples < 1 || settings.samples > kMaxSamples)
        return {base::Code::InvalidArgument, "samples must be 1..16"};
    if (settings.skyRings < 1 || settings.skyRings > SceneLights::kMaxSkyRings)
        return {base::Code::InvalidArgument, "rings of the sky must be 1..64"};
    if (!(settings.detailTolerance >= 1e-6 && settings.detailTolerance <= 0.1))
        return {base::Code::InvalidArgument, "the tolerance of detail must be 1e-6..0.1"};
    picture_.camera = withUnitAxes(scene.camera);
    tasks_ = &tasks;
    key_ = keyOf(scene, settings, tasks);
    picture_.settings = settings;
    picture_.settings.past.camera = withUnitAxes(settings.past.camera);
    picture_.medium.build(scene.blobs, scene.camera.eye, tasks, scene.details,
                          PixelWidth(picture_.camera, settings.height), settings.outputs);
    picture_.opaque.build(scene.opaque, scene.camera.eye, tasks,
                          PixelWidth(picture_.camera, settings.height));
    picture_.lights.build(scene.opaque, scene.camera.eye, settings.skyRings);
    const bool atCenters = settings.scattering == ScatteringMode::Centers;
    picture_.medium.setScattered(
        atCenters ? lightAtCenters(picture_.medium, picture_.opaque, picture_.lights, tasks)
                  : std::vector<glm::vec3>());
    tiles_.start(settings.width, settings.height, settings.samples == 1 ? 16 : 8, settings.channels());
    idle_.clear();
    work_ = {};
    return {};
}

std::unique_ptr<TileRenderer> ReferenceRenderer::borrow()
{
    const std::lock_guard lock(mutex_);
    if (idle_.empty())
        return std::make_unique<TileRenderer>(picture_);
    std::unique_ptr<TileRenderer> renderer = std::move(idle_.back());
    idle_.pop_back();
    return renderer;
}

void ReferenceRenderer::giveBack(std::unique_ptr<TileRenderer> renderer)
{
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(renderer));
}

base::Status ReferenceRenderer::render(TileJournal* journal, const RenderCallbacks& callbacks)
{
    const auto renderTile = [&](const PixelBlock& block, std::span<float> out) {
        std::unique_ptr<TileRenderer> renderer = borrow();
        const bool isWhole = renderer->render(block, out, callbacks.shouldStop);
        giveBack(std::move(renderer));
        return isWhole;
    };
    base::Status status = tiles_.render(*tasks_, renderTile, journal, callbacks);
    for (const auto& renderer : idle_)
        work_ += renderer->work();
    idle_.clear();
    return status;
}

} // namespace fx::render
