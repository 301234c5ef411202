#include "rendering/reference/integral/accuracy_cases.h"

#include "foundation/random/philox.h"
#include "rendering/reference/integral/ray_integrator.h"
#include "rendering/reference/integral/reference_integral.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::render {

namespace {

constexpr uint64_t kSeed = 270;

/// Number k of blob i, 0..1.
double random(uint32_t i, uint32_t k, uint64_t seed = kSeed)
{
    return double(base::toUnitFloat(base::philox({i, k / 4, 0, 0}, seed)[k % 4]));
}

/// Integral of (1 - u^2)^degree over [-1, 1], from degree 2 on.
constexpr double kFullChord[] = {16.0 / 15.0, 32.0 / 35.0, 256.0 / 315.0};

template <class T>
std::vector<BallBlob<T>> randomBlobs(double opticalDepth)
{
    constexpr uint32_t kBlobs = 270;
    constexpr double kRadius = 0.3;
    std::vector<BallBlob<T>> blobs;
    double depth = 0.0;
    for (uint32_t i = 0; blobs.size() < kBlobs; ++i) {
        const double x[3] = {2 * random(i, 0) - 1, 2 * random(i, 1) - 1, 2 * random(i, 2) - 1};
        if (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] > 1.0)
            continue;
        blobs.push_back({{T(x[0]), T(x[1]), T(x[2])},
                         T(kRadius),
                         T(1),
                         {T(random(i, 3)), T(random(i, 4)), T(random(i, 5))}});
        const double chord2 = kRadius * kRadius - x[0] * x[0] - x[1] * x[1];
        if (chord2 > 0.0)
            depth += kFullChord[0] * std::pow(chord2, 2.5) / std::pow(kRadius, 4);
    }
    for (BallBlob<T>& blob : blobs)
        blob.extinction = T(float(opticalDepth / depth)); // the same number in every precision
    return blobs;
}

std::vector<RayBlob<double>> blobsOfRay(const RayPacket<double>& packet, uint32_t lane)
{
    std::vector<RayBlob<double>> blobs;
    for (size_t k = 0; k < packet.shared.size(); ++k) {
        const auto& own = packet.shared[k];
        if (packet.chord2[k * kPacketRays + lane] > 0.0)
            blobs.push_back({packet.center[k * kPacketRays + lane],
                             packet.chord2[k * kPacketRays + lane],
                             own.radius,
                             own.extinction,
                             {own.source[0], own.source[1], own.source[2]},
                             own.id});
    }
    return blobs;
}

} // namespace

template <class T>
uint64_t PacketPicture<T>::hits() const
{
    uint64_t sum = 0;
    for (const RayPacket<T>& packet : packets_)
        sum +=
            uint64_t(std::count_if(packet.chord2.begin(), packet.chord2.end(), [](T h) { return h > T(0); }));
    return sum;
}

template <class T>
void PacketPicture<T>::integrate(PacketIntegrator<T>& integrator, size_t begin, size_t end,
                                 PacketLight<T>* outLights) const
{
    for (size_t i = begin; i < end; ++i)
        integrator.integrate(rays_[i], packets_[i], outLights[i]);
}

template <class T>
PacketPicture<T> ballOfBlobs(double opticalDepth, uint32_t width, uint32_t height, uint32_t every)
{
    const std::vector<BallBlob<T>> blobs = randomBlobs<T>(opticalDepth);
    const double pixel = 2.0 / width; // [m]
    std::vector<PacketRays<T>> rays;
    std::vector<RayPacket<T>> packets;
    uint32_t number = 0;
    for (uint32_t y = 0; y < height; y += 4)
        for (uint32_t x = 0; x < width; x += 4) {
            if (number++ % every != 0)
                continue;
            PacketRays<T>& group = rays.emplace_back();
            for (uint32_t i = 0; i < kPacketRays; ++i) {
                const double place[3] = {(x + i % 4 + 0.5 - width / 2.0) * pixel,
                                         (y + i / 4 + 0.5 - height / 2.0) * pixel, -1.5};
                for (int a = 0; a < 3; ++a) {
                    group.origin[a][i] = T(float(place[a]));
                    group.direction[a][i] = a == 2 ? T(1) : T(0);
                    group.background[a][i] = T(0);
                }
                group.nearest[i] = T(0);
                group.farthest[i] = std::numeric_limits<T>::infinity();
            }
            const double middle[2] = {(x + 2.0 - width / 2.0) * pixel, (y + 2.0 - height / 2.0) * pixel};
            std::vector<uint32_t> near;
            for (uint32_t k = 0; k < blobs.size(); ++k)
                if (std::hypot(double(blobs[k].center[0]) - middle[0],
                               double(blobs[k].center[1]) - middle[1]) < double(blobs[k].radius) + 4 * pixel)
                    near.push_back(k);
            meetBlobs<T>(group, blobs, near, packets.emplace_back());
        }
    return PacketPicture<T>(std::move(rays), std::move(packets));
}

std::vector<std::array<double, 3>> referenceLight(const PacketPicture<double>& picture,
                                                  const IntegralSettings& settings)
{
    using Real = long double;
    const auto exponential = [](Real x) { return std::exp(x); };
    std::vector<std::array<double, 3>> lights;
    for (size_t i = 0; i < picture.packets(); ++i)
        for (uint32_t lane = 0; lane < kPacketRays; ++lane) {
            std::vector<RayBlob<Real>> blobs;
            for (const RayBlob<double>& b : blobsOfRay(picture.packet(i), lane))
                blobs.push_back({b.center,
                                 b.chord2,
                                 b.radius,
                                 b.extinction,
                                 {b.source[0], b.source[1], b.source[2]},
                                 b.id});
            const PacketRays<double>& rays = picture.rays(i);
            const RayWindow<Real> window{
                rays.nearest[lane],
                rays.farthest[lane],
                {rays.background[0][lane], rays.background[1][lane], rays.background[2][lane]}};
            ReferenceIntegral<Real, decltype(exponential)> reference(
                blobs, window, settings.degree, settings.model == SourceModel::Product, Real(1e-15),
                [](Real x) { return std::sqrt(x); }, exponential);
            const std::array<Real, 3> light = reference.light();
            lights.push_back({double(light[0]), double(light[1]), double(light[2])});
        }
    return lights;
}

template <class T>
IntegralError integralError(const PacketPicture<T>& picture, const IntegralSettings& settings,
                            const std::vector<std::array<double, 3>>& reference)
{
    PacketIntegrator<T> integrator(settings);
    integrator.countWork(true);
    std::vector<PacketLight<T>> lights(picture.packets());
    picture.integrate(integrator, 0, picture.packets(), lights.data());
    double brightest = 0.0;
    for (const std::array<double, 3>& light : reference)
        brightest = std::max({brightest, light[0], light[1], light[2]});
    std::vector<double> errors;
    for (size_t i = 0; i < reference.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            if (reference[i][c] > 1e-6 * brightest) {
                const double got = double(lights[i / kPacketRays].radiance[c][i % kPacketRays]);
                errors.push_back(std::fabs(got / reference[i][c] - 1.0));
            }
    IntegralError result;
    result.work = integrator.work();
    result.values = errors.size();
    if (errors.empty())
        return result;
    std::sort(errors.begin(), errors.end());
    result.median = errors[errors.size() / 2];
    result.p99 = errors[std::min(errors.size() - 1, errors.size() * 99 / 100)];
    result.largest = errors.back();
    return result;
}

template <class T>
FurnaceError furnaceError(const IntegralSettings& settings)
{
    FurnaceError worst;
    RayIntegrator<T> integrator(settings);
    for (const uint32_t count : {1u, 2u, 4u, 8u, 16u, 32u, 64u})
        for (int step = -75; step <= 125; ++step) {
            const double depth = std::pow(10.0, step / 25.0);
            const uint64_t seed = uint64_t(count) * 1000 + uint64_t(step + 75);
            std::vector<RayBlob<T>> blobs;
            double sum = 0.0;
            for (uint32_t i = 0; i < count; ++i) {
                const double half = 0.1 + 1.9 * random(i, 0, seed),
                             radius = half * (1.0 + random(i, 1, seed));
                blobs.push_back({T(2 + 10 * random(i, 2, seed) / count),
                                 T(half * half),
                                 T(radius),
                                 T(0.2 + 0.8 * random(i, 3, seed)),
                                 {T(1), T(1), T(1)},
                                 i});
            }
            const auto total = [&] { // of the rounded numbers
                sum = 0.0;
                for (const RayBlob<T>& b : blobs) {
                    const double q2 = double(b.chord2) / (double(b.radius) * double(b.radius));
                    sum += double(b.extinction) * kFullChord[settings.degree - 2] *
                           std::pow(q2, settings.degree) * std::sqrt(double(b.chord2));
                }
                return sum;
            };
            const double scale = depth / total();
            for (RayBlob<T>& blob : blobs)
                blob.extinction = T(double(blob.extinction) * scale);
            const RayLight<T> light =
                integrator.integrate(blobs, {T(-10), std::numeric_limits<T>::infinity(), {T(0), T(0), T(0)}});
            const double expected = -std::expm1(-total());
            for (const T channel : light.radiance) {
                const double off = double(channel) / expected - 1.0;
                worst.excess = std::max(worst.excess, off);
                if (!(std::fabs(off) <= worst.largest))
                    worst = {std::fabs(off), worst.excess, depth, count};
            }
        }
    return worst;
}

template class PacketPicture<float>;
template class PacketPicture<double>;
template PacketPicture<float> ballOfBlobs(double, uint32_t, uint32_t, uint32_t);
template PacketPicture<double> ballOfBlobs(double, uint32_t, uint32_t, uint32_t);
template IntegralError integralError(const PacketPicture<float>&, const IntegralSettings&,
                                     const std::vector<std::array<double, 3>>&);
template IntegralError integralError(const PacketPicture<double>&, const IntegralSettings&,
                                     const std::vector<std::array<double, 3>>&);
template FurnaceError furnaceError<float>(const IntegralSettings&);
template FurnaceError furnaceError<double>(const IntegralSettings&);

} // namespace fx::render
