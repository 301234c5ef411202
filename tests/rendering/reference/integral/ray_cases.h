/// @file ray_cases.h
/// Rays through blobs for tests. All numbers are exact in float, so that every precision integrates the same
/// blobs.
#pragma once

#include "foundation/random/philox.h"
#include "quad.h"
#include "rendering/reference/integral/ray_integrator.h"
#include "rendering/reference/integral/reference_integral.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace fx::render {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Random numbers in [0, 1) from a counter.
class Draw
{
public:
    explicit Draw(uint64_t seed) : seed_(seed) {}
    double next() { return double(base::toUnitFloat(base::philox({count_++, 0, 0, 0}, seed_)[0])); }
    double between(double low, double high) { return low + (high - low) * next(); }

private:
    uint64_t seed_;
    uint32_t count_ = 0;
};

/// Optical depth of a blob along its full chord.
inline double fullDepth(const RayBlob<double>& b, uint32_t degree = 2)
{
    const double chord[] = {16.0 / 15.0, 32.0 / 35.0, 256.0 / 315.0};
    return b.extinction * std::pow(b.chord2 / (b.radius * b.radius), degree) * std::sqrt(b.chord2) *
           chord[degree - 2];
}

/// Random overlapping blobs along a ray. The blobs are between 2 and 12 m, have half chords of 0.02 to 2 m,
/// and have the given total optical depth.
inline std::vector<RayBlob<double>> randomRay(uint32_t count, double opticalDepth, uint64_t seed,
                                              uint32_t degree = 2)
{
    Draw draw(seed);
    std::vector<RayBlob<double>> blobs;
    double depth = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        const double half = draw.between(0.02, 2.0), radius = half * draw.between(1.0, 2.0);
        blobs.push_back({float(draw.between(2, 12)),
                         float(half * half),
                         float(radius),
                         float(draw.between(0.2, 1.0)),
                         {float(draw.next()), float(draw.next()), float(draw.next())},
                         i});
        depth += fullDepth(blobs.back(), degree);
    }
    for (RayBlob<double>& blob : blobs)
        blob.extinction = float(blob.extinction * opticalDepth / depth);
    return blobs;
}

template <class T>
std::vector<RayBlob<T>> blobsAs(const std::vector<RayBlob<double>>& blobs)
{
    std::vector<RayBlob<T>> out;
    for (const RayBlob<double>& b : blobs)
        out.push_back(
            {static_cast<T>(b.center),
             static_cast<T>(b.chord2),
             static_cast<T>(b.radius),
             static_cast<T>(b.extinction),
             {static_cast<T>(b.source[0]), static_cast<T>(b.source[1]), static_cast<T>(b.source[2])},
             b.id});
    return out;
}

template <class T>
RayWindow<T> openWindow()
{
    return {T(-100), static_cast<T>(kInfinity), {T(0), T(0), T(0)}};
}

inline IntegralSettings settingsOf(std::string_view scheme, uint32_t degree = 2,
                                   SourceModel model = SourceModel::PerBlob)
{
    IntegralSettings settings;
    settings.scheme = *parseScheme(scheme);
    settings.degree = degree;
    settings.model = model;
    return settings;
}

template <class T>
RayLight<T> integrate(const IntegralSettings& settings, const std::vector<RayBlob<T>>& blobs,
                      const RayWindow<T>& window = openWindow<T>())
{
    return RayIntegrator<T>(settings).integrate(blobs, window);
}

/// Light of a ray by adaptive quadrature in __float128.
inline std::array<double, 3> trueLight(const std::vector<RayBlob<double>>& blobs,
                                       const IntegralSettings& settings = {},
                                       const RayWindow<double>& window = openWindow<double>(),
                                       double tolerance = 1e-20)
{
    const std::vector<RayBlob<Quad>> exact = blobsAs<Quad>(blobs);
    const auto exponential = [](Quad x) { return expq(x); };
    const RayWindow<Quad> own{
        window.nearest, window.farthest, {window.background[0], window.background[1], window.background[2]}};
    ReferenceIntegral<Quad, decltype(exponential)> reference(
        exact, own, settings.degree, settings.model == SourceModel::Product, Quad(tolerance),
        [](Quad x) { return sqrtq(x); }, exponential);
    const std::array<Quad, 3> light = reference.light();
    return {double(light[0]), double(light[1]), double(light[2])};
}

/// Largest relative error of the three channels.
template <class T>
double worstError(const RayLight<T>& light, const std::array<double, 3>& expected)
{
    double worst = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        const double error = std::fabs(double(light.radiance[c]) / expected[c] - 1.0);
        worst = error <= worst ? worst : error; // NaN stays
    }
    return worst;
}

} // namespace fx::render
