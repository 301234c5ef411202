/// @file ray_range.cpp
/// numbers of any size, in any unit, in vectors.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"
#include "rendering/reference/integral/ray_packet.h"

#include <algorithm>

namespace fx::cli {
namespace {

//

SweepBlobs scaled(const SweepBlobs& blobs, double unit)
{
    SweepBlobs out = blobs;
    for (auto& blob : out) {
        blob.center *= unit;
        blob.chord2 *= unit * unit;
        blob.radius *= unit;
        blob.extinction /= unit;
    }
    return out;
}

/// The same picture in another unit of length.
double unitError(double unit, double degree)
{
    const SweepBlobs blobs = sweepBlobs(8, 2.0, 4, false);
    const auto settings = settingsFor("gauss-5", uint32_t(degree));
    auto window = wholeRay<float>();
    const auto home = lightOf<float>(settings, blobs, window);
    window.nearest *= float(unit);
    const auto moved = lightOf<float>(settings, scaled(blobs, unit), window);
    double worst = 0;
    for (size_t c = 0; c < 3; ++c)
        worst = std::fmax(worst, relativeError(double(moved.radiance[c]), double(home.radiance[c])));
    return worst;
}

double unitBits(double exponent, double degree)
{
    const SweepBlobs blobs = sweepBlobs(8, 2.0, 4, false);
    const auto settings = settingsFor("gauss-5", uint32_t(degree));
    const double unit = std::ldexp(1.0, int(exponent));
    auto window = wholeRay<float>();
    const auto home = lightOf<float>(settings, blobs, window);
    window.nearest *= float(unit);
    return differingNumbers(lightOf<float>(settings, scaled(blobs, unit), window), home);
}

/// Divided by the radius to the power of the kernel, as it is written.
double powerError(double unit, double degree)
{
    const float radius = float(unit), chord = 0.5f * radius;
    float power = 1.0f, wanted = 1.0f;
    for (int i = 0; i < int(degree); ++i) {
        power *= chord * chord / 1.0f;
        wanted *= 0.25f;
    }
    float divisor = 1.0f;
    for (int i = 0; i < 2 * int(degree); ++i)
        divisor *= radius;
    return relativeError(double(power / divisor), double(wanted));
}

std::vector<StabilitySweep> unitsOfLength(bool isQuick)
{
    std::vector<double> exponents;
    for (int e = -40; e <= 40; e += isQuick ? 8 : 1)
        exponents.push_back(e);
    const StabilitySweep anyUnit{"gauss-5, float, any unit",
                                 powersOfTen("unit [m]", -12, 12, 10, isQuick),
                                 values("degree", {2, 3, 4}),
                                 4e-6,
                                 false,
                                 unitError};
    const StabilitySweep bits{"numbers that differ in units 2^e",
                              values("e", std::move(exponents)),
                              values("degree", {2, 3, 4}),
                              0.0,
                              false,
                              unitBits};
    return {anyUnit, bits, controlOf(anyUnit, "powers of the radius", powerError)};
}

//

/// Quadrature nodes of a ray through equal blobs in a row, over those of its part that can be seen, less 1.
double uselessWork(double depth, double count, double stopDepth)
{
    SweepBlobs row;
    for (uint32_t i = 0; i < uint32_t(count); ++i)
        row.push_back({double(i), 0.25, 0.5, depth / count * 15.0 / 8.0, {1.0, 1.0, 1.0}, i});
    const double seen = std::ceil(count * std::fmin(1.0, 30.0 / depth)) + 1.0;
    const auto nodesUpTo = [&](double farthest, double stop) {
        render::IntegralSettings settings = settingsFor("gauss-5");
        settings.scheme.stopDepth = stop;
        render::RayIntegrator<float> integrator(settings);
        auto window = wholeRay<float>();
        window.farthest = float(farthest);
        integrator.integrate(blobsIn<float>(row), window);
        return double(integrator.work().nodes);
    };
    return std::fmax(nodesUpTo(count, stopDepth) / nodesUpTo(seen - 0.5, kEndless) - 1.0, 0.0);
}

std::vector<StabilitySweep> workBehind(bool isQuick)
{
    const StabilitySweep sweep{"gauss-5, work that nobody sees",
                               powersOfTen("tau", 0, 5, 10, isQuick),
                               values("blobs", {100, 200, 400, 800}),
                               0.1,
                               false,
                               [](double depth, double count) { return uselessWork(depth, count, 30.0); }};
    return {sweep, controlOf(sweep, "ray that never ends",
                             [](double depth, double count) { return uselessWork(depth, count, kEndless); })};
}

//

std::vector<StabilitySweep> anyExtinction(bool isQuick)
{
    const auto blobsOf = [](double ratio, double count) {
        SweepBlobs blobs = sweepBlobs(uint32_t(count), 1.0, uint64_t(count), true);
        for (auto& blob : blobs)
            blob.extinction = float(blob.extinction * ratio);
        return blobs;
    };
    const StabilitySweep sweep{
        "gauss-5, float",
        powersOfTen("extinction ratio", -20, 20, 5, isQuick),
        values("blobs", {1, 3, 6}),
        1e-3,
        false,
        [blobsOf](double ratio, double count) {
            const SweepBlobs blobs = blobsOf(ratio, count);
            const auto light = lightOf<float>(settingsFor("gauss-5"), blobs);
            const bool isHealthy = light.transmittance >= 0.0f && light.transmittance <= 1.0f;
            return isHealthy ? relativeError(double(light.radiance[0]), -std::expm1(-depthOf(blobs)))
                             : kEndless;
        }};
    return {sweep, controlOf(sweep, "1 - exp(-tau) in float", [blobsOf](double ratio, double count) {
                const double depth = depthOf(blobsOf(ratio, count));
                return relativeError(double(1.0f - std::exp(-float(depth))), -std::expm1(-depth));
            })};
}

//

double packetDifference(double depth, double count)
{
    const SweepBlobs blobs = sweepBlobs(uint32_t(count), depth, uint64_t(count), false);
    render::PacketRays<float> rays{};
    render::RayPacket<float> packet;
    for (uint32_t i = 0; i < render::kPacketRays; ++i) {
        rays.nearest[i] = -100.0f;
        rays.farthest[i] = std::numeric_limits<float>::infinity();
    }
    for (const auto& b : blobsIn<float>(blobs)) {
        const size_t at = packet.add({b.radius, b.extinction, {b.source[0], b.source[1], b.source[2]}, b.id});
        for (uint32_t i = 0; i < render::kPacketRays; ++i) { // each lane a little less of the blob
            packet.center[at * render::kPacketRays + i] = b.center;
            packet.chord2[at * render::kPacketRays + i] = b.chord2 * (1.0f - 0.01f * float(i));
        }
    }
    render::PacketLight<float> light;
    render::PacketIntegrator<float>(settingsFor("gauss-5")).integrate(rays, packet, light);
    double worst = 0;
    for (uint32_t i = 0; i < render::kPacketRays; ++i) {
        auto own = blobsIn<float>(blobs);
        for (auto& blob : own)
            blob.chord2 *= 1.0f - 0.01f * float(i);
        const auto alone =
            render::RayIntegrator<float>(settingsFor("gauss-5")).integrate(own, wholeRay<float>());
        const render::RayLight<float> lane{{light.radiance[0][i], light.radiance[1][i], light.radiance[2][i]},
                                           light.opticalDepth[i],
                                           light.transmittance[i],
                                           light.flags[i]};
        worst = std::fmax(worst, differingNumbers(lane, alone));
    }
    return worst;
}

/// A sum of products with and without fused operations.
double fusedDifference(double depth, double count)
{
    float plain = 0.0f, fused = 0.0f;
    for (const auto& b : blobsIn<float>(sweepBlobs(uint32_t(count), depth, uint64_t(count), false))) {
        plain = plain + b.extinction * b.chord2;
        fused = std::fma(b.extinction, b.chord2, fused);
    }
    return plain != fused ? 1.0 : 0.0;
}

std::vector<StabilitySweep> vectors(bool isQuick)
{
    const StabilityAxis count = values("blobs", {1, 2, 4, 8, 16, 32, 64});
    const StabilitySweep bits{"packet and scalar, numbers that differ",
                              powersOfTen("tau", -3, 3, 8, isQuick),
                              count,
                              0.0,
                              false,
                              packetDifference};
    const auto error = [](double tau, double n) {
        const SweepBlobs b = sweepBlobs(uint32_t(n), tau, uint64_t(n), false);
        const auto s = settingsFor("gauss-5");
        return relativeError(double(lightOf<float>(s, b).radiance[0]), lightOf<double>(s, b).radiance[0]);
    };
    // not at whole caps, where float and double may take different numbers of parts
    const StabilitySweep thin{"gauss-5, float against double",
                              powersOfTen("tau", -2.97, 2.03, 8, isQuick),
                              count,
                              1e-5,
                              false,
                              error};
    const StabilitySweep thick{"gauss-5, float against double, thick",
                               powersOfTen("tau", 2.03, 5, 8, isQuick),
                               count,
                               5e-5,
                               false,
                               error};
    return {bits, thin, thick, controlOf(bits, "sums with fused operations", fusedDifference),
            controlOf(thin, "coefficients added and subtracted", [](double tau, double n) {
                const SweepBlobs b = sweepBlobs(uint32_t(n), tau, uint64_t(n), false);
                return relativeError(incrementalLight(b, 0.0),
                                     lightOf<double>(settingsFor("paper-1"), b).radiance[0]);
            })};
}

} // namespace

StabilityRows rayRangeStability()
{
    return {
        {"R-11", "the unit of length does not matter", "the light in meters", unitsOfLength},
        {"R-12", "what nobody sees is not worked for", "nodes of the visible part", workBehind},
        {"R-14", "any extinction gives a healthy number", "1 - exp(-tau)", anyExtinction},
        {"R-16", "vectors have the bits of scalars", "the scalar integrator", vectors},
    };
}

} // namespace fx::cli
