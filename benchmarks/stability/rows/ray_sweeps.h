/// @file ray_sweeps.h
/// Rays through blobs for the cases about the ray integral. All numbers are exact in float, so that every
/// precision integrates the same blobs.
#pragma once

#include "foundation/random/philox.h"
#include "rendering/reference/integral/ray_integrator.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <vector>

namespace fx::cli {

inline constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Random numbers in [0, 1) from a counter.
class SweepRandom
{
public:
    explicit SweepRandom(uint64_t seed) : seed_(seed) {}
    double next() { return double(base::toUnitFloat(base::philox({count_++, 0, 0, 0}, seed_)[0])); }
    double between(double low, double high) { return low + (high - low) * next(); }

private:
    uint64_t seed_;
    uint32_t count_ = 0;
};

using SweepBlobs = std::vector<render::RayBlob<double>>;

/// [1] Optical depth, summed over chords, for kernels of degree 2.
inline double depthOf(const SweepBlobs& blobs)
{
    double sum = 0;
    for (const auto& blob : blobs) {
        const double q2 = blob.chord2 > 0 ? blob.chord2 / (blob.radius * blob.radius) : 0.0;
        sum += blob.extinction * 16.0 / 15.0 * q2 * q2 * std::sqrt(std::fmax(blob.chord2, 0.0));
    }
    return sum;
}

/// Overlapping blobs with the given total optical depth. @param isFurnace true: all blobs emit 1
inline SweepBlobs sweepBlobs(uint32_t count, double depth, uint64_t seed, bool isFurnace)
{
    SweepRandom random(seed);
    SweepBlobs blobs;
    for (uint32_t i = 0; i < count; ++i) {
        const double half = random.between(0.1, 2.0), radius = half * random.between(1.0, 2.0);
        blobs.push_back({float(2.0 + 10.0 * random.next() / count),
                         float(half * half),
                         float(radius),
                         float(random.between(0.2, 1.0)),
                         {1.0, 1.0, 1.0},
                         i});
        if (!isFurnace)
            for (double& channel : blobs.back().source)
                channel = float(random.next());
    }
    const double scale = depth / depthOf(blobs);
    for (auto& blob : blobs)
        blob.extinction = float(blob.extinction * scale);
    return blobs;
}

template <class T>
std::vector<render::RayBlob<T>> blobsIn(const SweepBlobs& blobs)
{
    std::vector<render::RayBlob<T>> out;
    for (const auto& b : blobs)
        out.push_back({T(b.center),
                       T(b.chord2),
                       T(b.radius),
                       T(b.extinction),
                       {T(b.source[0]), T(b.source[1]), T(b.source[2])},
                       b.id});
    return out;
}

inline render::IntegralSettings settingsFor(std::string_view scheme, uint32_t degree = 2)
{
    render::IntegralSettings settings;
    settings.scheme = *render::parseScheme(scheme);
    settings.degree = degree;
    return settings;
}

template <class T>
render::RayWindow<T> wholeRay()
{
    return {T(-100), std::numeric_limits<T>::infinity(), {T(0), T(0), T(0)}};
}

template <class T>
render::RayLight<T> lightOf(const render::IntegralSettings& settings, const SweepBlobs& blobs,
                            const render::RayWindow<T>& window = wholeRay<T>())
{
    return render::RayIntegrator<T>(settings).integrate(blobsIn<T>(blobs), window);
}

/// |got / wanted - 1|; 0 if both are zero.
inline double relativeError(double got, double wanted)
{
    return got == wanted ? 0.0 : std::fabs(got / wanted - 1.0);
}

/// Number of values among radiance, optical depth and transmittance that differ in any bit.
template <class T>
double differingNumbers(const render::RayLight<T>& a, const render::RayLight<T>& b)
{
    const T left[] = {a.radiance[0], a.radiance[1], a.radiance[2], a.opticalDepth, a.transmittance};
    const T right[] = {b.radiance[0], b.radiance[1], b.radiance[2], b.opticalDepth, b.transmittance};
    int count = a.flags != b.flags ? 1 : 0;
    for (size_t i = 0; i < 5; ++i)
        count += std::memcmp(&left[i], &right[i], sizeof(T)) != 0 ? 1 : 0;
    return count;
}

/// Naive implementation: sums of float polynomial coefficients about the ray's origin. The coefficients of a
/// blob are added where the blob begins and subtracted where it ends. Computes the red channel only.
/// @param origin [m] distance that is added to all positions
double incrementalLight(const SweepBlobs& blobs, double origin);

} // namespace fx::cli
