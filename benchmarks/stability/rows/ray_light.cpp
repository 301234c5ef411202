/// @file ray_light.cpp
/// how exact the light along a ray is.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"

#include <algorithm>

namespace fx::cli {
namespace {

using Error = std::function<double(double, double)>;

//

double coincidentError(double chord, double count)
{
    SweepBlobs many, one{{2.0, chord * chord, 1.0, 3.0, {0.5, 0.25, 1.0}, 0}};
    for (uint32_t i = 0; i < uint32_t(count); ++i)
        many.push_back({2.0, chord * chord, 1.0, 3.0 / count, {0.5, 0.25, 1.0}, i});
    const auto a = lightOf<double>(settingsFor("gauss-5"), many),
               b = lightOf<double>(settingsFor("gauss-5"), one);
    return std::fmax(relativeError(a.radiance[0], b.radiance[0]),
                     relativeError(a.opticalDepth, b.opticalDepth));
}

/// The mean density of the interval, from a depth and a length of which both may be nothing.
double dividedError(double chord, double)
{
    const double length = (2.0 + chord) - (2.0 - chord);
    return relativeError(3.2 * chord / length, 1.6);
}

std::vector<StabilitySweep> emptyIntervals(bool isQuick)
{
    const StabilitySweep sweep{"coincident blobs against one",
                               powersOfTen("half chord / radius", -30, -1e-9, 8, isQuick),
                               values("blobs", {1, 2, 3, 7, 16, 64}),
                               1e-13,
                               false,
                               coincidentError};
    return {sweep, controlOf(sweep, "divided by the length", dividedError)};
}

//

/// Largest error of several rays whose light has to be 1 - e^-tau. @param isExcess light that was created
/// alone
template <class T>
Error furnace(const char* scheme, bool isExcess, uint32_t rays)
{
    return [settings = settingsFor(scheme), isExcess, rays](double depth, double count) {
        double worst = 0;
        for (uint64_t seed = 0; seed < rays; ++seed) {
            const SweepBlobs blobs = sweepBlobs(uint32_t(count), depth, seed * 1000 + uint64_t(count), true);
            const double light = double(lightOf<T>(settings, blobs).radiance[0]);
            const double error = light / -std::expm1(-depthOf(blobs)) - 1.0;
            worst = std::fmax(worst, isExcess ? error : std::fabs(error));
            if (std::isnan(error))
                return error;
        }
        return worst;
    };
}

Error earlyEnd(uint32_t rays)
{
    return [rays](double depth, double count) {
        render::IntegralSettings going = settingsFor("gauss-5");
        going.scheme.stopDepth = kEndless;
        double worst = 0;
        for (uint64_t seed = 0; seed < rays; ++seed) {
            const SweepBlobs blobs = sweepBlobs(uint32_t(count), depth, seed * 1000 + uint64_t(count), true);
            worst = std::fmax(worst, relativeError(lightOf<double>(settingsFor("gauss-5"), blobs).radiance[0],
                                                   lightOf<double>(going, blobs).radiance[0]));
        }
        return worst;
    };
}

std::vector<StabilitySweep> furnaces(bool isQuick)
{
    const StabilityAxis depth = powersOfTen("tau", -3, 5, 25, isQuick);
    const StabilityAxis count = values("blobs", {1, 2, 4, 8, 16, 32, 64});
    const uint32_t rays = isQuick ? 1 : 32;
    const auto sweep = [&](const char* name, double limit, Error error) {
        return StabilitySweep{name, depth, count, limit, false, std::move(error)};
    };
    const StabilitySweep high = sweep("gauss-8, double", 2e-5, furnace<double>("gauss-8", false, rays));
    const StabilitySweep created =
        sweep("gauss-5, float, light created", 2e-4, furnace<float>("gauss-5", true, rays));
    const StabilitySweep usual = sweep("gauss-5, float", 1e-3, furnace<float>("gauss-5", false, rays));
    return {
        usual,
        sweep("gauss-5, double", 1e-3, furnace<double>("gauss-5", false, rays)),
        sweep("gauss-5-cap-0.5, double", 3e-4, furnace<double>("gauss-5-cap-0.5", false, rays)),
        sweep("gauss-8, float", 1e-4, furnace<float>("gauss-8", false, rays)),
        high,
        sweep("positive-8, double", 1e-6, furnace<double>("positive-8", false, rays)),
        created,
        sweep("gauss-5, early end", 1e-12, earlyEnd(rays)),
        controlOf(created, "gauss-5-cap-inf, light created", furnace<float>("gauss-5-cap-inf", true, rays)),
        controlOf(usual, "paper-1", furnace<float>("paper-1", false, rays))};
}

//

/// One blob that emits 1, seen at a share of its radius from its center.
double singleBlobError(const char* scheme, double depth, double share, uint32_t degree = 2)
{
    const double chord2 = 1.0 - share * share, full[] = {16.0 / 15.0, 32.0 / 35.0, 256.0 / 315.0};
    const double extinction = depth / (full[degree - 2] * std::pow(chord2, degree) * std::sqrt(chord2));
    const SweepBlobs blobs{{2.0 + share, chord2, 1.0, extinction, {1.0, 1.0, 1.0}, 0}};
    const auto light = lightOf<double>(settingsFor(scheme, degree), blobs);
    return relativeError(light.radiance[0], -std::expm1(-depth));
}

/// Slope of the error over depths 0.01 to 1 in logarithms, against 2.
Error slopeError(const char* scheme)
{
    return [scheme](double share, double degree) {
        double sx = 0, sy = 0, sxx = 0, sxy = 0;
        const int count = 21;
        for (int i = 0; i < count; ++i) {
            const double x = -2.0 + 2.0 * i / (count - 1);
            const double y = std::log10(singleBlobError(scheme, std::pow(10.0, x), share, uint32_t(degree)));
            sx += x, sy += y, sxx += x * x, sxy += x * y;
        }
        return std::fabs((count * sxy - sx * sy) / (count * sxx - sx * sx) - 2.0);
    };
}

std::vector<StabilitySweep> linearModel(bool isQuick)
{
    const StabilitySweep law{"paper-1, error / tau^2",
                             powersOfTen("tau", -2, std::log10(3.0), 30, isQuick),
                             evenSteps("impact / radius", 0.0, 0.9, 18, isQuick),
                             1.0 / 41.0, // 1/42 where it is thin, 0.018 at 1
                             false,
                             [](double depth, double share) {
                                 return singleBlobError("paper-1", depth, share) / (depth * depth);
                             }};
    const StabilitySweep slope{"paper-1, slope - 2",
                               evenSteps("impact / radius", 0.0, 0.9, 36, isQuick),
                               values("degree", {2, 3, 4}),
                               0.1,
                               false,
                               slopeError("paper-1")};
    return {law, slope, controlOf(slope, "march-0.03, slope - 2", slopeError("march-0.03"))};
}

// At a depth of just the cap float and double may take different numbers of parts.

Error manyBlobs(uint32_t rays, bool isIncremental)
{
    return [rays, isIncremental](double count, double depth) {
        double worst = 0;
        for (uint64_t seed = 0; seed < rays; ++seed) {
            const SweepBlobs blobs =
                sweepBlobs(uint32_t(count), depth, seed * 10000 + uint64_t(count), false);
            const double linear =
                lightOf<double>(settingsFor("paper-1"), blobs).radiance[0]; // what it aims at
            const double usual = lightOf<double>(settingsFor("gauss-5"), blobs).radiance[0];
            const double got = isIncremental
                                   ? incrementalLight(blobs, 0.0)
                                   : double(lightOf<float>(settingsFor("gauss-5"), blobs).radiance[0]);
            worst = std::fmax(worst, relativeError(got, isIncremental ? linear : usual));
        }
        return worst;
    };
}

std::vector<StabilitySweep> manyBlobsSweeps(bool isQuick)
{
    std::vector<double> counts;
    for (double n = 1; n <= (isQuick ? 256 : 4096); n *= 2)
        counts.push_back(n);
    const StabilitySweep sweep{"gauss-5, float against double",
                               values("blobs", std::move(counts)),
                               values("tau", {0.1, 0.3, 0.9}),
                               1e-5,
                               false,
                               manyBlobs(isQuick ? 1 : 16, false)};
    return {sweep, controlOf(sweep, "coefficients added and subtracted", manyBlobs(1, true))};
}

} // namespace

StabilityRows rayLightStability()
{
    return {
        {"R-02", "intervals without a length add nothing", "one blob instead of many", emptyIntervals},
        {"R-03", "blobs that emit 1 are 1 - exp(-tau) bright", "1 - exp(-tau)", furnaces},
        {"R-04", "linear attenuation errs with the square of tau", "1 - exp(-tau)", linearModel},
        {"R-05", "thousands of blobs are as exact as one", "the same scheme in double", manyBlobsSweeps},
    };
}

} // namespace fx::cli
