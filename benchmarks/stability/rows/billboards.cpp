/// @file billboards.cpp
/// B-01 to B-08: one blob, one ray, by the formulas that the GPU programs are compiled from.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <numbers>

namespace fx::cli {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr double kUnitDepth = std::numbers::pi / 3.5; ///< [m2] cross section of optical depth 1 at radius 1

/// [1] of optical depth 1 through the center
double kernelDepth(double h, double tc, double t0, double t1)
{
    return double(formula::fxKernelOpticalDepth(float(kUnitDepth), 1.0f, float(h), float(tc), float(t0),
                                                t1 < kEndless ? float(t1) : kFar));
}

double exactDepth(double h, double tc, double t0, double t1)
{
    return formula64::fxKernelOpticalDepth(kUnitDepth, 1.0, h, tc, t0, t1);
}

std::vector<StabilitySweep> nearPlane(bool isQuick)
{
    const auto light = [](double place, double h, bool isCard) {
        const double near = 0.05; // a card is clipped once its middle is before the near plane
        const double depth = isCard ? (-place > near ? kernelDepth(h, 0.0, -1.0, 1.0) : 0.0)
                                    : kernelDepth(h, -place, near, kEndless);
        return -std::expm1(-depth);
    };
    const StabilitySweep sweep{
        "step over 0.01 radius",
        evenSteps("camera [radius]", -1.5, 1.5, 1000, false),
        evenSteps("impact [radius]", 0.0, 1.0, 20, isQuick),
        0.01,
        false,
        [light](double at, double h) { return std::fabs(light(at + 0.01, h, false) - light(at, h, false)); }};
    return {sweep, controlOf(sweep, "a card that the near plane clips", [light](double at, double h) {
                return std::fabs(light(at + 0.01, h, true) - light(at, h, true));
            })};
}

std::vector<StabilitySweep> scenePlane(bool isQuick)
{
    const auto cutAt = [](double offset, double tilt) {
        const double angle = tilt * std::numbers::pi / 180.0;
        return 5.0 + offset / std::cos(angle) + 0.3 * std::tan(angle);
    };
    const StabilitySweep sweep{"part before the plane, and the sum of both",
                               evenSteps("plane [radius]", -2.0, 2.0, 400, isQuick),
                               evenSteps("tilt [deg]", 0.0, 80.0, 16, isQuick),
                               1e-5,
                               false,
                               [cutAt](double offset, double tilt) {
                                   const double cut = cutAt(offset, tilt);
                                   const double front = kernelDepth(0.3, 5.0, 0.0, cut);
                                   const double back = kernelDepth(0.3, 5.0, cut, kEndless);
                                   return std::fmax(
                                       std::fabs(front - exactDepth(0.3, 5.0, 0.0, double(float(cut)))),
                                       std::fabs(front + back - exactDepth(0.3, 5.0, 0.0, kEndless)));
                               }};
    return {sweep,
            controlOf(sweep, "a card that is seen whole or not at all", [cutAt](double offset, double tilt) {
                const double cut = cutAt(offset, tilt);
                const double card = cut > 5.0 ? kernelDepth(0.3, 0.0, -1.0, 1.0) : 0.0;
                return std::fabs(card - exactDepth(0.3, 5.0, 0.0, cut));
            })};
}

std::vector<StabilitySweep> radii(bool isQuick)
{
    const StabilitySweep sweep{
        "kernel of any radius",
        powersOfTen("radius [m]", -18, 6, 10, isQuick),
        evenSteps("impact [radius]", 0.0, 0.95, 19, isQuick),
        1e-5,
        false,
        [](double radius, double share) {
            const float r = float(radius), h = float(share) * r, sigma = float(kUnitDepth) * r * r;
            const double got = double(formula::fxKernelOpticalDepth(sigma, r, h, 3.0f * r, 0.0f, kFar));
            return std::fabs(got - exactDepth(double(float(share)), 3.0, 0.0, kEndless));
        }};
    return {sweep, controlOf(sweep, "powers of the radius", [](double radius, double share) {
                const float r = float(radius), h = float(share) * r, w2 = r * r - h * h;
                const float got = 3.5f / 3.14159265f * float(kUnitDepth) * r * r * w2 * w2 * std::sqrt(w2) /
                                  (r * r * r * r * r * r * r);
                return std::fabs(double(got) - exactDepth(double(float(share)), 3.0, 0.0, kEndless));
            })};
}

/// Error of a path in units of what the formula promises, 2^-20 (distance + radius).
double pathError(double path, double wanted, double distance, double radius)
{
    return std::fabs(path - wanted) / std::ldexp(distance + radius, -20);
}

double spherePath(double radius, double distance, float end)
{
    return double(formula::fxSpherePath(float(radius), 0.0f, float(distance), 0.1f, end));
}

std::vector<StabilitySweep> depthBuffers(bool isQuick)
{
    const StabilityAxis distance = powersOfTen("distance [m]", 0.5, 6, 20, isQuick);
    const StabilityAxis radius = powersOfTen("radius [m]", -1, 2, 5, isQuick);
    const auto error = [](double d, double r, float end) { // a wall through the center
        const double front = std::fmax(d - r, 0.1);
        return pathError(spherePath(r, d, end), std::fmax(d - front, 0.0), d, r);
    };
    const StabilitySweep wall{
        "reversed depth, a wall through the ball", distance, radius, 1.0, false, [error](double d, double r) {
            return error(d, r, 0.1f / float(0.1 / d));
        }};
    const StabilitySweep sky{
        "reversed depth 0 is the sky", distance, radius, 1.0, false, [](double d, double r) {
            const float end = 0.1f / 0.0f;
            return pathError(spherePath(r, d, end), d + r - std::fmax(d - r, 0.1), d, r);
        }};
    return {wall, sky,
            controlOf(wall, "standard depth of 24 bits",
                      [error](double d, double r) {
                          const double near = 0.1, far = 2e6, stored = far * (d - near) / (d * (far - near));
                          const double rounded = std::round(stored * 16777215.0) / 16777215.0;
                          return error(d, r, float(far * near / (far - rounded * (far - near))));
                      }),
            controlOf(sky, "share of the way to the sky", [](double d, double r) {
                const float end = 0.1f / 0.0f;
                return pathError(double((end - float(d - r)) / end) * 2.0 * r, 2.0 * r, d, r);
            })};
}

/// A ray from an eye at `distance` through the point at `offset` beside a ball of radius 1, as the fragment
/// program has it. T is float or double.
template <class T>
double seenDepth(double distance, double offset)
{
    const T length = std::sqrt(T(distance) * T(distance) + T(offset) * T(offset));
    const T d[2] = {T(offset) / length, T(distance) / length};
    const T tc = T(distance) * d[1], x = tc * d[0], z = tc * d[1] - T(distance);
    const T h = std::sqrt(x * x + z * z);
    return std::is_same_v<T, float> ? kernelDepth(double(h), double(tc), 0.0, kEndless)
                                    : exactDepth(double(h), double(tc), 0.0, kEndless);
}

std::vector<StabilitySweep> orthographic(bool isQuick)
{
    const StabilityAxis impact = evenSteps("impact [radius]", 0.0, 0.95, 19, isQuick);
    const auto distanceOf = [](double angle) { return 2.0 / std::tan(angle * std::numbers::pi / 360.0); };
    const StabilitySweep limit{"parallel rays are the limit of narrow views",
                               powersOfTen("angle of view [deg]", -4, 0, 10, isQuick),
                               impact,
                               1e-3,
                               false,
                               [=](double angle, double b) {
                                   return std::fabs(kernelDepth(b, 5.0, 0.0, kEndless) -
                                                    seenDepth<double>(distanceOf(angle), b));
                               }};
    const StabilitySweep wide{"perspective, float",
                              powersOfTen("angle of view [deg]", -1, 2.23, 10, isQuick),
                              impact,
                              1e-3,
                              false,
                              [=](double angle, double b) {
                                  return std::fabs(seenDepth<float>(distanceOf(angle), b) -
                                                   seenDepth<double>(distanceOf(angle), b));
                              }};
    return {
        limit, wide,
        controlOf(limit, "rays of an eye 10 radii away",
                  [=](double angle, double b) {
                      return std::fabs(seenDepth<double>(10.0, b) - seenDepth<double>(distanceOf(angle), b));
                  }),
        controlOf(wide, "rays taken parallel to the axis", [=](double angle, double b) {
            return std::fabs(kernelDepth(b, 5.0, 0.0, kEndless) - seenDepth<double>(distanceOf(angle), b));
        })};
}

std::vector<StabilitySweep> rims(bool isQuick)
{
    const auto worstOf = [](double gap, double radius, auto path) {
        double worst = 0;
        for (const double sign : {-1.0, 1.0}) {
            const float r = float(radius), h = float(radius * (1.0 + sign * gap));
            const double wanted =
                formula64::fxSpherePath(double(r), double(h), 4.0 * double(r), 0.0, kEndless);
            const double error = pathError(path(r, h), wanted, 4.0 * radius, radius);
            worst = std::isnan(error) ? kEndless : std::fmax(worst, error);
        }
        return worst;
    };
    const StabilitySweep sweep{"chords at the rim",
                               powersOfTen("gap / radius", -7, -1, 20, isQuick),
                               powersOfTen("radius [m]", -3, 3, 4, isQuick),
                               1.0,
                               false,
                               [worstOf](double gap, double radius) {
                                   return worstOf(gap, radius, [](float r, float h) {
                                       return double(formula::fxSpherePath(r, h, 4.0f * r, 0.0f, kFar));
                                   });
                               }};
    return {sweep, controlOf(sweep, "root of r^2 - h^2", [worstOf](double gap, double radius) {
                return worstOf(gap, radius,
                               [](float r, float h) { return double(2.0f * std::sqrt(r * r - h * h)); });
            })};
}

} // namespace

StabilityRows billboardsStability()
{
    return {
        {"B-01", "no jump when the near plane enters a ball", "the light one step before", nearPlane},
        {"B-02", "a plane cuts a ball exactly", "the same formula in double", scenePlane},
        {"B-03", "balls of any size", "a ball of radius 1 in double", radii},
        {"B-04", "depth buffers and the sky", "the chord in double", depthBuffers},
        {"B-05", "parallel rays are the limit of perspective", "perspective in double", orthographic},
        {"B-06", "a grazed rim is not a root of a negative number", "the chord in double", rims},
    };
}

} // namespace fx::cli
