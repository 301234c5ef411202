#include "rendering/reference/path/path_renderer.h"

#include "foundation/math/bits.h"
#include "rendering/reference/path/blob_path_medium.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace fx::render {

namespace {

constexpr int kEdge = 8; ///< [pixel] of a tile
constexpr uint32_t kMaxSamples = 1u << 24;
constexpr uint64_t kVersion = 3; ///< of the arithmetic
/// Numbers of samples from which pilot paths are counted, so that no path is drawn twice.
constexpr uint32_t kPilotBegin = 1u << 31;

/// What the lighting says about directions without medium or triangle.
class LightingSky final : public PathSky
{
public:
    explicit LightingSky(const Lighting& lighting)
        : above_(lighting.skyLuminance), below_(groundLuminance(lighting))
    {}
    glm::dvec3 luminance(const glm::dvec3& direction) const override
    {
        return direction.y >= 0.0 ? above_ : below_;
    }

private:
    glm::dvec3 above_, below_; ///< [cd/m2]
};

/// [lx] of the sun and the sky.
double illuminanceOf(const Lighting& lighting)
{
    const glm::vec3 light = lighting.sunIlluminance + std::numbers::pi_v<float> * lighting.skyLuminance;
    return double(std::max({light.x, light.y, light.z}));
}

/// Mean, variance of the mean and opacity of a pixel, by [Wel62].
class PixelStatistics
{
public:
    void add(const glm::dvec3& luminance, double opacity)
    {
        ++count_;
        const glm::dvec3 change = luminance - mean_;
        mean_ += change / double(count_);
        squares_ += change * (luminance - mean_);
        opacity_ += (opacity - opacity_) / double(count_);
    }
    uint32_t count() const { return count_; }
    const glm::dvec3& mean() const { return mean_; }
    double opacity() const { return opacity_; }
    /// Of one sample.
    glm::dvec3 variance() const { return count_ > 1 ? squares_ / double(count_ - 1) : glm::dvec3(0.0); }

private:
    uint32_t count_ = 0;
    glm::dvec3 mean_{0.0}, squares_{0.0};
    double opacity_ = 0.0;
};

double sum(const glm::dvec3& v)
{
    return v.x + v.y + v.z;
}

base::Status checkSettings(const PathPictureSettings& s)
{
    const auto refused = [](const char* what) { return base::Status(base::Code::InvalidArgument, what); };
    if (s.samples < 1 || s.samples > kMaxSamples)
        return refused("samples must be 1..16777216");
    if (!base::isFinite(s.error) || s.error < 0.0)
        return refused("the error must be finite and at least 0");
    if (!base::isFinite(s.exposure) || !(s.exposure > 0.0))
        return refused("the exposure must be finite and above 0");
    if (!(s.sunRadius >= 0.0 && s.sunRadius <= 0.5 * std::numbers::pi))
        return refused("the sun's angular radius must be 0..pi/2");
    if (!(s.path.roulette >= 0.0 && s.path.roulette <= 1.0))
        return refused("roulette must be 0..1");
    return {};
}

uint64_t keyOf(const ReferenceScene& scene, const PathPictureSettings& s, base::TaskRunner& tasks)
{
    KeyHash hash;
    hash.addWord(kVersion);
    addScene(hash, scene, tasks);
    for (const double number :
         {double(s.width), double(s.height), s.error, s.exposure, s.sunRadius, s.path.roulette})
        hash.add(number);
    for (const uint64_t word :
         {uint64_t(s.samples), s.seed, uint64_t(s.path.bounces), uint64_t(s.path.flight),
          uint64_t(s.path.shadow), uint64_t(s.path.forcedFlights)})
        hash.addWord(word);
    return hash.value();
}

} // namespace

/// All that tiles share. Coordinates are relative to the eye.
struct PathRenderer::Shared
{
    Shared(const ReferenceScene& scene, const PathPictureSettings& settings, base::TaskRunner& tasks)
        : camera(withUnitAxes(scene.camera)), grid(camera.grid(settings.width, settings.height)),
          medium(scene.blobs, camera.eye, tasks, illuminanceOf(scene.opaque.lighting), scene.details,
                 PixelWidth(camera, settings.height)),
          sky(scene.opaque.lighting),
          sun(glm::normalize(glm::dvec3(scene.opaque.lighting.sunDirection)),
              glm::dvec3(scene.opaque.lighting.sunIlluminance), settings.sunRadius)
    {
        triangles.build(scene.opaque.mesh, camera.eye, tasks);
        OpaqueScene behind = scene.opaque;
        behind.mesh = {};
        background.build(behind, camera.eye, tasks, PixelWidth(camera, settings.height));
        if (scene.opaque.lighting.sunIlluminance != glm::vec3(0.0f))
            lights.push_back(&sun);
        for (const SceneLight& lamp : scene.opaque.lamps)
            lamps.push_back(makePathLight(lamp, camera.eye));
        for (const EffectLight& glow : scene.opaque.particleLights)
            lamps.push_back(std::make_unique<GlowPathLight>(glow.position - camera.eye,
                                                            glm::dvec3(glow.intensity), double(glow.radius)));
        for (const auto& lamp : lamps)
            lights.push_back(lamp.get());
        paths.medium = &medium;
        paths.triangles = &triangles;
        paths.mesh = scene.opaque.mesh;
        paths.eye = camera.eye;
        paths.pixel = PixelWidth(camera, settings.height);
        paths.lights = lights;
        paths.sky = &sky;
    }

    ReferenceCamera camera;
    RayGrid grid;
    BlobPathMedium medium;
    TriangleScene triangles;
    OpaqueView background;
    LightingSky sky;
    SunLight sun;
    std::vector<std::unique_ptr<PathLight>> lamps;
    std::vector<const PathLight*> lights;
    PathScene paths;
};

/// Pixels of one tile.
class PathRenderer::Tile
{
public:
    Tile(const Shared& shared, const PathPictureSettings& settings)
        : shared_(shared), settings_(settings), integrator_(shared.paths, settings.path)
    {}

    /// Adds paths with the numbers [begin, end) to a pixel.
    void sample(int x, int y, uint32_t begin, uint32_t end, PixelStatistics& io)
    {
        const uint32_t pixel = uint32_t(y) * uint32_t(settings_.width) + uint32_t(x);
        for (uint32_t number = begin; number < end; ++number) {
            PathSampler sampler(settings_.seed, pixel, number);
            const auto [dx, dy] = sampler.pair();
            double lengthPerDepth = 0.0;
            const TraceRay ray = shared_.grid.ray(x + dx, y + dy, &lengthPerDepth);
            PathResult path = integrator_.trace(ray, shared_.camera.nearDistance * lengthPerDepth, sampler);
            if (path.sawBackground) {
                path.luminance +=
                    path.throughput * shared_.background
                                          .sample(ray, (x + dx) / settings_.width,
                                                  (y + dy) / settings_.height, none_, 0.0, scratch_)
                                          .luminance;
            }
            const glm::dvec3 value = path.luminance * settings_.exposure;
            const bool isNumber = base::isFinite(sum(value));
            nonFinite_ += !isNumber;
            io.add(isNumber ? value : glm::dvec3(0.0), shared_.background.isEmpty() ? path.opacity : 1.0);
        }
    }

    uint64_t collisions() const { return integrator_.collisions(); }
    uint64_t nonFinite() const { return nonFinite_; }

private:
    const Shared& shared_;
    const PathPictureSettings& settings_;
    PathIntegrator integrator_;
    RayHits none_, scratch_;
    uint64_t nonFinite_ = 0;
};

PathRenderer::PathRenderer() = default;
PathRenderer::~PathRenderer() = default;

base::Status PathRenderer::build(const ReferenceScene& scene, const PathPictureSettings& settings,
                                 base::TaskRunner& tasks)
{
    if (base::Status status = checkScene(scene, settings.width, settings.height); !status)
        return status;
    if (base::Status status = checkSettings(settings); !status)
        return status;
    tasks_ = &tasks;
    settings_ = settings;
    shared_ = std::make_unique<Shared>(scene, settings, tasks);
    key_ = keyOf(scene, settings, tasks);
    tiles_.start(settings.width, settings.height, kEdge, path_channel::Count);
    paths_ = collisions_ = nonFinite_ = 0;
    return {};
}

bool PathRenderer::renderTile(const PixelBlock& block, std::span<float> out, const RenderCallbacks& callbacks)
{
    Tile tile(*shared_, settings_);
    const auto isStopped = [&] { return callbacks.shouldStop && callbacks.shouldStop(); };
    const uint32_t pixels = uint32_t((block.x1 - block.x0) * (block.y1 - block.y0));
    uint32_t samples = settings_.samples;
    if (settings_.error > 0.0) {
        double variance = 0.0;
        for (int y = block.y0; y < block.y1; ++y)
            for (int x = block.x0; x < block.x1; ++x) {
                if (isStopped())
                    return false;
                PixelStatistics pilot;
                tile.sample(x, y, kPilotBegin, kPilotBegin + kPilotSamples, pilot);
                variance += sum(pilot.variance()) / 3.0;
            }
        const double wanted = variance / pixels / (settings_.error * settings_.error);
        samples = uint32_t(
            std::clamp(std::ceil(wanted), double(std::min(kPilotSamples, samples)), double(samples)));
        paths_ += uint64_t(pixels) * kPilotSamples;
    }
    size_t to = 0;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x) {
            PixelStatistics pixel;
            while (pixel.count() < samples) {
                if (isStopped())
                    return false;
                tile.sample(x, y, pixel.count(), std::min(samples, pixel.count() + 1024), pixel);
            }
            const glm::dvec3 variance = pixel.variance() / double(samples);
            for (const double value : {pixel.mean().x, pixel.mean().y, pixel.mean().z, pixel.opacity(),
                                       variance.x, variance.y, variance.z, double(samples)})
                out[to++] = float(value);
        }
    paths_ += uint64_t(pixels) * samples;
    collisions_ += tile.collisions();
    nonFinite_ += tile.nonFinite();
    return true;
}

base::Status PathRenderer::render(TileJournal* journal, const RenderCallbacks& callbacks)
{
    return tiles_.render(
        *tasks_,
        [&](const PixelBlock& block, std::span<float> out) { return renderTile(block, out, callbacks); },
        journal, callbacks);
}

PathWork PathRenderer::work() const
{
    return {paths_, collisions_, nonFinite_};
}

double PathRenderer::standardError() const
{
    double variance = 0.0;
    size_t count = 0;
    for (uint32_t channel = 0; channel < 3; ++channel)
        for (const float value : tiles_.pixels(path_channel::Variance + channel)) {
            variance += double(value);
            ++count;
        }
    return std::sqrt(variance / double(std::max<size_t>(count, 1)));
}

} // namespace fx::render
