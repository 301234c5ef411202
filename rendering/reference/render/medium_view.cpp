#include "rendering/reference/render/medium_view.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

namespace fx::render {

namespace {

constexpr uint32_t kPart = 4096;   ///< blobs that one task handles at least
constexpr double kThickest = 1e30; ///< [1] optical depth of a radius
constexpr double kDensest = 1e300; ///< [1/m]

BallBlob<double> ballOf(const MediumBlob& blob, const glm::dvec3& eye)
{
    const glm::dvec3 c = blob.center - eye;
    const double r = blob.radius;
    const double extinction = blob.crossSection / r / r / r * (105.0 / (32.0 * std::numbers::pi));
    // Opaque is enough: what is thicker would leave the range of numbers further on.
    const double most = std::min(kThickest / r, kDensest);
    return {{c.x, c.y, c.z}, r, std::min(extinction, most), {blob.source.x, blob.source.y, blob.source.z}};
}

std::array<double, 3> coverageOf(const MediumBlob& blob)
{
    std::array<double, 3> coverage{};
    coverage[size_t(blob.layer)] = 1.0 - blob.fireShare;
    coverage[size_t(base::MediaLayer::Fire)] += blob.fireShare;
    return coverage;
}

template <class T>
class BundleIntegratorOf final : public BundleIntegrator
{
public:
    explicit BundleIntegratorOf(const IntegralSettings& settings) : integrator_(settings) {}

    uint64_t meet(const MediumView& medium, const RayBundle& rays,
                  std::span<const uint32_t> candidates) override
    {
        medium_ = &medium;
        count_ = rays.count;
        candidates_ = candidates;
        start_ = startOf(medium, rays, candidates);
        const glm::dvec3 anchor = rays.ray[0].origin + rays.ray[0].direction * start_;
        setBlobs(anchor);
        setRays(rays, anchor);
        packet_.clear();
        return meetBlobs<T>(rays_, blobs_, indices_, packet_);
    }

    void integrate(MediumSource source, BundleLight& out) override
    {
        for (auto& shared : packet_.shared) {
            const uint32_t place = candidates_[shared.id];
            const std::array<double, 3> sent = medium_->source(source, place);
            for (size_t c = 0; c < 3; ++c)
                shared.source[c] = T(sent[c]);
        }
        integrator_.integrate(rays_, packet_, light_);
        for (uint32_t i = 0; i < count_; ++i) {
            out.radiance[i] = {double(light_.radiance[0][i]), double(light_.radiance[1][i]),
                               double(light_.radiance[2][i])};
            out.opticalDepth[i] = double(light_.opticalDepth[i]);
            out.transmittance[i] = double(light_.transmittance[i]);
        }
    }

private:
    /// Where ray parameters are counted from: before the first candidate.
    static double startOf(const MediumView& medium, const RayBundle& rays,
                          std::span<const uint32_t> candidates)
    {
        double start = std::numeric_limits<double>::infinity();
        for (const uint32_t place : candidates) {
            const BallBlob<double>& b = medium.blob(place);
            const glm::dvec3 c = glm::dvec3(b.center[0], b.center[1], b.center[2]) - rays.ray[0].origin;
            start = std::min(start, glm::dot(c, rays.ray[0].direction) - b.radius);
        }
        return candidates.empty() ? 0.0 : start;
    }

    void setBlobs(const glm::dvec3& anchor)
    {
        blobs_.clear();
        for (const uint32_t place : candidates_) {
            const BallBlob<double>& b = medium_->blob(place);
            blobs_.push_back(
                {{T(b.center[0] - anchor.x), T(b.center[1] - anchor.y), T(b.center[2] - anchor.z)},
                 T(b.radius),
                 T(b.extinction),
                 {T(b.source[0]), T(b.source[1]), T(b.source[2])}});
        }
        indices_.resize(blobs_.size());
        std::iota(indices_.begin(), indices_.end(), 0u);
    }

    void setRays(const RayBundle& rays, const glm::dvec3& anchor)
    {
        for (uint32_t i = 0; i < kPacketRays; ++i) {
            const uint32_t k = std::min(i, rays.count - 1);
            const TraceRay& ray = rays.ray[k];
            const glm::dvec3 origin = ray.origin + ray.direction * start_ - anchor;
            for (int axis = 0; axis < 3; ++axis) {
                rays_.origin[axis][i] = T(origin[axis]);
                rays_.direction[axis][i] = T(ray.direction[axis]);
                rays_.background[axis][i] = T(0);
            }
            rays_.nearest[i] = T(rays.begin[k] - start_);
            rays_.farthest[i] = T(rays.end[k] - start_);
        }
    }

    PacketIntegrator<T> integrator_;
    const MediumView* medium_ = nullptr;
    std::span<const uint32_t> candidates_;
    uint32_t count_ = 0;
    double start_ = 0.0; ///< [m] that is taken off all ray parameters
    std::vector<BallBlob<T>> blobs_;
    std::vector<uint32_t> indices_;
    PacketRays<T> rays_{};
    RayPacket<T> packet_;
    PacketLight<T> light_{};
};

} // namespace

void MediumView::build(std::span<const MediumBlob> blobs, const glm::dvec3& eye, base::TaskRunner& tasks,
                       const MediumDetails& details, const PixelWidth& pixel, bool hasTracks)
{
    const auto balls = std::make_unique_for_overwrite<TraceBall[]>(blobs.size());
    const uint32_t parts = uint32_t((blobs.size() + kPart - 1) / kPart);
    std::vector<uint8_t> differs(parts, 0);
    tasks.parallelFor(parts, 1, [&](uint32_t first, uint32_t last) {
        const size_t end = std::min(size_t(last) * kPart, blobs.size());
        for (size_t i = size_t(first) * kPart; i < end; ++i) {
            balls[i] = {blobs[i].center, blobs[i].radius};
            differs[i / kPart] |= uint8_t(coverageOf(blobs[i]) != coverageOf(blobs[0]));
        }
    });
    isUniform_ = std::find(differs.begin(), differs.end(), 1) == differs.end();
    tree_.build({balls.get(), blobs.size()}, eye, tasks);
    details_ = DetailedMedium(details, tree_, eye, pixel);
    count_ = blobs.size();
    blobs_ = std::make_unique_for_overwrite<BallBlob<double>[]>(count_);
    coverage_.resize(isUniform_ ? std::min<size_t>(count_, 1) : count_);
    scattering_ = std::make_unique_for_overwrite<Scattering[]>(count_);
    tracks_.resize(hasTracks ? count_ : 0);
    tasks.parallelFor(tree_.count(), kPart, [&](uint32_t begin, uint32_t end) {
        for (uint32_t place = begin; place < end; ++place) {
            const MediumBlob& blob = blobs[tree_.ballAt(place)];
            blobs_[place] = ballOf(blob, eye);
            if (place < coverage_.size())
                coverage_[place] = coverageOf(blob);
            scattering_[place] = {glm::vec3(blob.albedo), float(blob.anisotropy), blob.layer};
            if (hasTracks)
                tracks_[place] = {blob.velocity, blob.instance};
        }
    });
}

void MediumView::setScattered(std::vector<glm::vec3> light)
{
    scattered_ = std::move(light);
    scatters_ = {};
    for (size_t place = 0; place < scattered_.size(); ++place)
        if (scattered_[place] != glm::vec3(0.0f))
            scatters_[size_t(scattering_[place].layer)] = true;
}

std::array<double, 3> MediumView::source(MediumSource source, uint32_t place) const
{
    const BallBlob<double>& blob = blobs_[place];
    if (source == MediumSource::Light)
        return {blob.source[0], blob.source[1], blob.source[2]};
    if (source == MediumSource::Coverage)
        return coverage(place);
    if (size_t(scattering_[place].layer) != size_t(source) - size_t(MediumSource::Fire))
        return {0.0, 0.0, 0.0};
    const glm::dvec3 light(scattered_[place]);
    return {light.x, light.y, light.z};
}

std::unique_ptr<BundleIntegrator> makeBundleIntegrator(const IntegralSettings& settings, bool isSingle)
{
    if (isSingle)
        return std::make_unique<BundleIntegratorOf<float>>(settings);
    return std::make_unique<BundleIntegratorOf<double>>(settings);
}

} // namespace fx::render
