#include "rendering/reference/render/tile_renderer.h"

#include "foundation/math/bits.h"
#include "foundation/simd/floating_point_scope.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

/// What one ray has seen.
struct TileRenderer::Sample
{
    TraceRay ray;
    double begin = 0.0; ///< [m]
    OpaqueSample opaque;
    glm::dvec3 light{0.0};              ///< [cd/m2] of the medium
    ScatteredLight::Layers scattered{}; ///< [cd/m2] by layer
    glm::dvec3 coverage{0.0};           ///< [1] of fire, smoke, dust
    double transmittance = 1.0;
    double opticalDepth = 0.0;
    double depth = std::numeric_limits<double>::infinity(); ///< [m]
    SeenOutputs::Seen seen;
    std::vector<InstanceShare> shares;
};

ReferenceWork& ReferenceWork::operator+=(const ReferenceWork& other)
{
    rays += other.rays;
    hits += other.hits;
    nonFinite += other.nonFinite;
    return *this;
}

TileRenderer::TileRenderer(const ReferencePicture& picture)
    : picture_(picture), grid_(picture.camera.grid(picture.settings.width * picture.settings.samples,
                                                   picture.settings.height * picture.settings.samples)),
      integrator_(makeBundleIntegrator(picture.settings.integral, picture.settings.isSingle)),
      seenOutputs_(picture.medium, picture.camera.eye, picture.settings.past, picture.settings.width,
                   picture.settings.height),
      detailed_(picture.medium, DetailedRay::Wanted::Light, picture.settings.detailTolerance),
      scattered_(picture.medium, picture.opaque, picture.lights),
      surfaceLight_(picture.medium, picture.opaque, picture.lights)
{
    if (picture.settings.scattering == ScatteringMode::Single)
        illuminance_ = [this](const glm::dvec3& position, const glm::dvec3& normal) {
            return surfaceLight_.at(position, normal);
        };
}

TileRenderer::~TileRenderer() = default;

TileRenderer::Sample& TileRenderer::sampleAt(const PixelBlock& rays, int x, int y)
{
    return samples_[size_t(y - rays.y0) * size_t(rays.x1 - rays.x0) + size_t(x - rays.x0)];
}

bool TileRenderer::render(const PixelBlock& block, std::span<float> out,
                          const std::function<bool()>& shouldStop)
{
    const base::FloatingPointScope floatingPoint;
    const int n = picture_.settings.samples;
    const PixelBlock rays{block.x0 * n, block.y0 * n, block.x1 * n, block.y1 * n};
    samples_.assign(size_t(rays.x1 - rays.x0) * size_t(rays.y1 - rays.y0), Sample{});
    work_.rays += samples_.size();
    renderOpaque(rays);
    if (!picture_.medium.isEmpty() && !renderMedium(rays, shouldStop))
        return false;
    float* pixel = out.data();
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x, pixel += picture_.settings.channels()) {
            writePixel(rays, x, y, pixel);
            if (picture_.settings.outputs)
                writeOutputs(rays, x, y, pixel);
        }
    return true;
}

void TileRenderer::renderOpaque(const PixelBlock& rays)
{
    const int n = picture_.settings.samples;
    const double perX = 1.0 / (picture_.settings.width * n);
    const double perY = 1.0 / (picture_.settings.height * n);
    const auto see = [&](int x, int y, const RayHits& hits) {
        Sample& sample = sampleAt(rays, x, y);
        double lengthPerDepth = 0.0;
        sample.ray = grid_.ray(x + 0.5, y + 0.5, &lengthPerDepth);
        sample.begin = picture_.camera.nearDistance * lengthPerDepth;
        sample.opaque = picture_.opaque.sample(sample.ray, (x + 0.5) * perX, (y + 0.5) * perY, hits,
                                               sample.begin, shadowHits_, illuminance_);
    };
    if (picture_.opaque.hasMesh()) {
        walk_.run(picture_.opaque.tree(), grid_, rays, {picture_.camera.nearDistance}, see);
        return;
    }
    hits_.clear();
    for (int y = rays.y0; y < rays.y1; ++y)
        for (int x = rays.x0; x < rays.x1; ++x)
            see(x, y, hits_);
}

bool TileRenderer::renderMedium(const PixelBlock& rays, const std::function<bool()>& shouldStop)
{
    bool isStopped = false;
    double farthest = 0.0;
    for (const Sample& sample : samples_)
        farthest = std::max(farthest, sample.opaque.distance);
    walk_.visit(picture_.medium.tree(), grid_, rays, farthest, 4,
                [&](const PixelBlock& part, const TileCandidates& candidates) {
                    isStopped = isStopped || (shouldStop && shouldStop());
                    if (isStopped || candidates.size() == 0)
                        return;
                    if (picture_.medium.details().isGiven())
                        renderDetailed(rays, part, candidates);
                    else
                        renderBundle(rays, part, candidates);
                });
    return !isStopped;
}

/// Ray by ray: fields with detail are no sums of what balls have along the ray.
void TileRenderer::renderDetailed(const PixelBlock& rays, const PixelBlock& part,
                                  const TileCandidates& candidates)
{
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x) {
            Sample& sample = sampleAt(rays, x, y);
            candidates.hits(sample.ray, sample.begin, sample.opaque.distance, hits_);
            work_.hits += hits_.size();
            detailed_.trace(sample.ray, hits_, sample.begin, sample.opaque.distance);
            sample.light = detailed_.light();
            sample.coverage = detailed_.coverage();
            sample.opticalDepth = detailed_.opticalDepth();
            sample.transmittance = std::exp(-sample.opticalDepth);
            sample.depth = detailed_.distance();
            seeOutputs(rays, x, y, &detailed_);
            if (picture_.settings.scattering == ScatteringMode::Single)
                sample.scattered = scattered_.along(sample.ray, hits_, sample.begin, sample.opaque.distance);
            for (size_t layer = 0; layer < sample.scattered.size(); ++layer)
                sample.scattered[layer] += detailed_.scattered(base::MediaLayer(layer));
        }
}

void TileRenderer::renderBundle(const PixelBlock& rays, const PixelBlock& part,
                                const TileCandidates& candidates)
{
    RayBundle bundle;
    std::array<Sample*, kPacketRays> samples;
    std::array<std::array<int, 2>, kPacketRays> places;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x) {
            Sample& sample = sampleAt(rays, x, y);
            samples[bundle.count] = &sample;
            places[bundle.count] = {x, y};
            bundle.ray[bundle.count] = sample.ray;
            bundle.begin[bundle.count] = sample.begin;
            bundle.end[bundle.count++] = sample.opaque.distance;
        }
    const uint64_t hits =
        integrator_->meet(picture_.medium, bundle, {candidates.places(), candidates.size()});
    work_.hits += hits;
    if (hits == 0)
        return;
    BundleLight light;
    BundleLight coverage;
    integrator_->integrate(MediumSource::Light, light);
    if (!picture_.medium.isUniform())
        integrator_->integrate(MediumSource::Coverage, coverage);
    for (uint32_t i = 0; i < bundle.count; ++i) {
        Sample& sample = *samples[i];
        sample.light = light.radiance[i];
        sample.coverage = picture_.medium.isUniform()
                              ? (1.0 - light.transmittance[i]) * picture_.medium.coverage()
                              : coverage.radiance[i];
        sample.transmittance = light.transmittance[i];
        candidates.hits(sample.ray, sample.begin, sample.opaque.distance, hits_);
        const MediumDepth depth =
            seenDepth_.along(picture_.medium, hits_, sample.begin, sample.opaque.distance);
        sample.opticalDepth = depth.opticalDepth; // the integrator stops where nothing is seen any more
        sample.depth = depth.distance;
        seeOutputs(rays, places[i][0], places[i][1], nullptr);
        if (picture_.settings.scattering == ScatteringMode::Single)
            sample.scattered = scattered_.along(sample.ray, hits_, sample.begin, sample.opaque.distance);
    }
    addScattered({samples.data(), bundle.count});
}

/// For the ray whose hits have been found last.
void TileRenderer::seeOutputs(const PixelBlock& rays, int x, int y, DetailedRay* detailed)
{
    const ReferenceSettings& settings = picture_.settings;
    if (!settings.outputs)
        return;
    Sample& sample = sampleAt(rays, x, y);
    const double perPixel = 1.0 / settings.samples;
    const glm::dvec2 window((x + 0.5) * perPixel, settings.height - (y + 0.5) * perPixel);
    sample.seen = seenOutputs_.along(sample.ray, hits_, sample.begin, sample.opaque.distance, detailed,
                                     window, sample.shares);
}

/// Light that has been taken at the centers of blobs.
void TileRenderer::addScattered(std::span<Sample* const> samples)
{
    BundleLight light;
    for (const base::MediaLayer layer :
         {base::MediaLayer::Fire, base::MediaLayer::Smoke, base::MediaLayer::Dust}) {
        if (!picture_.medium.scatters(layer))
            continue;
        integrator_->integrate(MediumSource(size_t(MediumSource::Fire) + size_t(layer)), light);
        for (size_t i = 0; i < samples.size(); ++i)
            samples[i]->scattered[size_t(layer)] += light.radiance[i];
    }
}

namespace {

/// Numbers for what is none, so that a filter does not spread it: no light, opaque medium of no known place.
/// @return how many values were replaced
uint32_t replaceNonFinite(float* io)
{
    namespace channel = reference_channel;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    uint32_t count = 0;
    for (uint32_t c = 0; c < channel::Count; ++c) {
        if (base::isFinite(io[c]) || (c == channel::Depth && io[c] == kInfinity))
            continue;
        const bool isAlpha = c < channel::Depth && c % 4 == 3;
        io[c] = c == channel::Depth          ? kInfinity
                : c == channel::OpticalDepth ? std::numeric_limits<float>::max()
                : isAlpha                    ? 1.0f
                                             : 0.0f;
        ++count;
    }
    return count;
}

} // namespace

/// The mean over the rays of a pixel; depths are weighted by opacity.
void TileRenderer::writePixel(const PixelBlock& rays, int x, int y, float* out)
{
    namespace channel = reference_channel;
    const int n = picture_.settings.samples;
    const double weight = 1.0 / (n * n);
    glm::dvec3 light(0.0), behind(0.0), background(0.0), coverage(0.0);
    ScatteredLight::Layers scattered{};
    double transmittance = 0.0, opticalDepth = 0.0, depth = 0.0, opacity = 0.0;
    for (int j = y * n; j < (y + 1) * n; ++j)
        for (int i = x * n; i < (x + 1) * n; ++i) {
            const Sample& s = samples_[size_t(j - rays.y0) * size_t(rays.x1 - rays.x0) + size_t(i - rays.x0)];
            light += weight * s.light;
            for (size_t layer = 0; layer < scattered.size(); ++layer)
                scattered[layer] += weight * s.scattered[layer];
            behind += weight * s.transmittance * s.opaque.luminance;
            background += weight * s.opaque.luminance;
            coverage += weight * s.coverage;
            transmittance += weight * s.transmittance;
            opticalDepth += weight * s.opticalDepth;
            const double seen = s.coverage.x + s.coverage.y + s.coverage.z;
            if (seen > 0.0 && s.depth < std::numeric_limits<double>::infinity()) {
                depth += seen * s.depth;
                opacity += seen;
            }
        }
    const double exposure = picture_.settings.exposure;
    const glm::dvec3 all = scattered[0] + scattered[1] + scattered[2];
    for (int c = 0; c < 3; ++c) {
        out[channel::Color + uint32_t(c)] = float(exposure * (light[c] + all[c] + behind[c]));
        out[channel::Background + uint32_t(c)] = float(exposure * background[c]);
        out[channel::Fire + uint32_t(c)] = float(exposure * (light[c] + scattered[0][c]));
        out[channel::Smoke + uint32_t(c)] = float(exposure * scattered[1][c]);
        out[channel::Dust + uint32_t(c)] = float(exposure * scattered[2][c]);
        out[channel::Fire + 4 * uint32_t(c) + 3] = float(std::min(coverage[c], 1.0));
    }
    const bool hasBackground = !picture_.opaque.isEmpty();
    out[channel::Color + 3] = hasBackground ? 1.0f : float(1.0 - transmittance);
    out[channel::Background + 3] = hasBackground ? 1.0f : 0.0f;
    out[channel::Depth] = opacity > 0.0 ? float(depth / opacity) : std::numeric_limits<float>::infinity();
    out[channel::OpticalDepth] = float(opticalDepth);
    work_.nonFinite += replaceNonFinite(out);
}

/// Shares and motion are those of all rays of a pixel, the first depth is the mean of those that have one.
void TileRenderer::writeOutputs(const PixelBlock& rays, int x, int y, float* out)
{
    namespace channel = reference_channel;
    const int n = picture_.settings.samples;
    pixelShares_.clear();
    glm::dvec2 motion(0.0);
    double share = 0.0, first = 0.0;
    int begun = 0;
    for (int j = y * n; j < (y + 1) * n; ++j)
        for (int i = x * n; i < (x + 1) * n; ++i) {
            const Sample& s = sampleAt(rays, i, j);
            motion += s.seen.motion;
            share += s.seen.share;
            for (const InstanceShare& one : s.shares)
                addShare(pixelShares_, one.instance, one.share);
            if (s.seen.first < std::numeric_limits<double>::infinity()) {
                first += s.seen.first;
                ++begun;
            }
        }
    const bool isSeen = share >= -std::expm1(-SeenOutputs::kSeenDepth) * n * n;
    const auto most = std::ranges::max_element(pixelShares_, {}, &InstanceShare::share);
    out[channel::InstanceId] = isSeen ? float(most->instance) : 0.0f;
    out[channel::MotionX] = isSeen ? float(motion.x / share) : 0.0f;
    out[channel::MotionY] = isSeen ? float(motion.y / share) : 0.0f;
    out[channel::FirstDepth] = begun > 0 ? float(first / begun) : std::numeric_limits<float>::infinity();
}

} // namespace fx::render
