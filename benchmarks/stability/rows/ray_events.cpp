/// @file ray_events.cpp
/// B-07, B-08: where rays begin and end, the order of what lies on them, and broken
/// numbers.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"

#include <algorithm>

namespace fx::cli {
namespace {

//

/// A blob of radius 1 around 5 that the camera looks through from `place`, past its center by `impact`.
double lightFrom(double place, double impact, bool forgetsWhatBeganBefore)
{
    const double chord2 = 1.0 - impact * impact;
    auto window = wholeRay<double>();
    window.nearest = 5.0 + place;
    SweepBlobs blobs;
    if (!forgetsWhatBeganBefore || -std::sqrt(chord2) >= place)
        blobs.push_back({5.0, chord2, 1.0, 0.8, {1.0, 1.0, 1.0}, 0});
    return lightOf<double>(settingsFor("gauss-5"), blobs, window).radiance[0];
}

/// 1 - e^-tau of what lies before the camera.
double closedForm(double place, double impact)
{
    const double half = std::sqrt(1.0 - impact * impact), u = std::clamp(place / half, -1.0, 1.0);
    const auto primitive = [](double v) { return v - 2.0 / 3.0 * v * v * v + 0.2 * std::pow(v, 5); };
    return -std::expm1(-0.8 * std::pow(half, 5) * (primitive(1.0) - primitive(u)));
}

std::vector<StabilitySweep> cameraInside(bool isQuick)
{
    const StabilityAxis place = evenSteps("camera [radius]", -1.25, 1.25, 1000, isQuick);
    const StabilityAxis impact = evenSteps("impact [radius]", 0.0, 0.9995, 20, isQuick);
    const auto jump = [](bool isForgetful) {
        return [isForgetful](double at, double b) {
            // where the blob begins is a place of its own on the way
            const double half = std::sqrt(1.0 - b * b), near = std::fabs(at + half) < 2e-3 ? -half : at;
            return std::fabs(lightFrom(near + 5e-7, b, isForgetful) - lightFrom(near - 5e-7, b, isForgetful));
        };
    };
    const StabilitySweep steps{"gauss-5, step over 1e-6 radius", place, impact, 1e-5, false, jump(false)};
    const StabilitySweep exact{"gauss-5, error", place, impact, 1e-3, false, [](double at, double b) {
                                   return std::fabs(lightFrom(at, b, false) - closedForm(at, b));
                               }};
    return {steps, exact, controlOf(steps, "blobs that began behind the camera are forgotten", jump(true))};
}

//

double cutError(const char* scheme, double cut, double depth)
{
    const SweepBlobs blobs = sweepBlobs(12, depth, 21, false);
    auto front = wholeRay<double>(), back = wholeRay<double>();
    front.farthest = back.nearest = cut;
    const auto settings = settingsFor(scheme);
    const auto whole = lightOf<double>(settings, blobs), a = lightOf<double>(settings, blobs, front),
               b = lightOf<double>(settings, blobs, back);
    double worst = 0;
    for (size_t c = 0; c < 3; ++c)
        worst = std::fmax(worst,
                          relativeError(a.radiance[c] + a.transmittance * b.radiance[c], whole.radiance[c]));
    return worst;
}

/// Even places, and where blobs begin and end with the numbers next to it.
StabilityAxis cuts(bool isQuick)
{
    StabilityAxis axis = evenSteps("cut [m]", 0.0, 12.0, 1000, isQuick);
    for (const auto& blob : sweepBlobs(12, 1.0, 21, false))
        for (const double t : {blob.center - std::sqrt(blob.chord2), blob.center + std::sqrt(blob.chord2)})
            for (const double at : {std::nextafter(t, -kEndless), t, std::nextafter(t, kEndless)})
                axis.values.push_back(at);
    std::sort(axis.values.begin(), axis.values.end());
    return axis;
}

std::vector<StabilitySweep> depthCuts(bool isQuick)
{
    const StabilityAxis depth = powersOfTen("tau", -2, 2, 2, isQuick);
    const auto sweep = [&](const char* scheme, double limit) {
        return StabilitySweep{std::string(scheme) + ", sum of pieces",
                              cuts(isQuick),
                              depth,
                              limit,
                              false,
                              [scheme](double cut, double tau) { return cutError(scheme, cut, tau); }};
    };
    const StabilitySweep usual = sweep("gauss-5", 2e-3), high = sweep("gauss-8", 1e-5);
    return {usual, high, controlOf(usual, "paper-1, sum of pieces", [](double cut, double tau) {
                return cutError("paper-1", cut, tau);
            })};
}

//

const char* const kSchemes[] = {"gauss-5", "gauss-8", "paper-4", "adaptive-0.001", "march-0.1", "positive-4"};

/// Orders of six blobs, two of them in one place, whose light has other bits than that of the first order.
double permutedLight(double seed, double scheme)
{
    auto blobs = blobsIn<float>(sweepBlobs(6, 3.0, uint64_t(seed), false));
    blobs[1].center = blobs[4].center;
    blobs[1].chord2 = blobs[4].chord2;
    render::RayIntegrator<float> integrator(settingsFor(kSchemes[int(scheme)]));
    const auto first = integrator.integrate(blobs, wholeRay<float>());
    const auto byId = [](const auto& a, const auto& b) { return a.id < b.id; };
    double count = 0;
    while (std::next_permutation(blobs.begin(), blobs.end(), byId))
        count += differingNumbers(integrator.integrate(blobs, wholeRay<float>()), first) > 0 ? 1 : 0;
    return count;
}

/// The same for a sum in the order of the input.
double permutedSum(double seed, double)
{
    auto blobs = blobsIn<float>(sweepBlobs(6, 3.0, uint64_t(seed), false));
    const auto sum = [&] {
        float total = 0.0f;
        for (const auto& blob : blobs)
            total += blob.extinction * blob.chord2;
        return total;
    };
    const float first = sum();
    const auto byId = [](const auto& a, const auto& b) { return a.id < b.id; };
    double count = 0;
    while (std::next_permutation(blobs.begin(), blobs.end(), byId))
        count += sum() != first ? 1 : 0;
    return count;
}

std::vector<StabilitySweep> orders(bool isQuick)
{
    const StabilitySweep sweep{"orders with other bits",
                               evenSteps("set of blobs", 0, 100, 100, isQuick),
                               values("scheme", {0, 1, 2, 3, 4, 5}),
                               0.0,
                               false,
                               permutedLight};
    return {sweep, controlOf(sweep, "sums in the order of the input", permutedSum)};
}

// B-07, B-08

/// 0 when a ray with a broken number is refused and dark.
double brokenNumber(double field, double kind)
{
    const double bad[] = {std::nan(""), kEndless, -kEndless};
    auto blobs = blobsIn<float>(sweepBlobs(5, 1.0, 3, false));
    float* const fields[] = {&blobs[2].center,     &blobs[2].chord2,    &blobs[2].radius,
                             &blobs[2].extinction, &blobs[2].source[0], &blobs[2].source[2]};
    *fields[int(field)] = float(bad[int(kind)]);
    const auto light =
        render::RayIntegrator<float>(settingsFor("gauss-5")).integrate(blobs, wholeRay<float>());
    return light.flags == render::kRayInvalid && light.radiance[0] == 0.0f && light.transmittance == 0.0f
               ? 0.0
               : kEndless;
}

std::vector<StabilitySweep> brokenInput(bool)
{
    const StabilitySweep sweep{
        "integrator", values("field", {0, 1, 2, 3, 4, 5}), values("nan, +inf, -inf", {0, 1, 2}), 0.0, false,
        brokenNumber};
    return {sweep, controlOf(sweep, "sum without a look at its input", [](double, double kind) {
                const double bad[] = {std::nan(""), kEndless, -kEndless};
                return std::isfinite(1.0 + bad[int(kind)]) ? 0.0 : kEndless;
            })};
}

/// Orders of blobs at one depth in which the result has other bits.
double sameDepth(double set, double count, bool isDrawn)
{
    SweepBlobs blobs = sweepBlobs(uint32_t(count), 2.0, uint64_t(set), false);
    for (auto& blob : blobs)
        blob.center = 5.0;
    auto list = blobsIn<float>(blobs);
    render::RayIntegrator<float> integrator(settingsFor("gauss-5"));
    const auto drawn = [&] {
        float sum = 0.0f;
        for (const auto& blob : list)
            sum = 0.3f * blob.source[0] + 0.7f * sum;
        return sum;
    };
    const auto first = integrator.integrate(list, wholeRay<float>());
    const float firstDrawn = drawn();
    double different = 0;
    SweepRandom random(uint64_t(set) + 99);
    for (int i = 0; i < 100; ++i) {
        for (size_t k = list.size(); k > 1; --k)
            std::swap(list[k - 1], list[size_t(random.next() * double(k))]);
        different += isDrawn
                         ? double(drawn() != firstDrawn)
                         : double(differingNumbers(integrator.integrate(list, wholeRay<float>()), first) > 0);
    }
    return different;
}

std::vector<StabilitySweep> sameDepths(bool isQuick)
{
    const StabilitySweep sweep{"integral, orders with other bits",
                               evenSteps("set", 0, 20, 20, isQuick),
                               values("blobs", {2, 4, 16, 64}),
                               0.0,
                               false,
                               [](double set, double count) { return sameDepth(set, count, false); }};
    return {sweep, controlOf(sweep, "drawn in the order of the list",
                             [](double set, double count) { return sameDepth(set, count, true); })};
}

} // namespace

StabilityRows rayEventsStability()
{
    return {
        {"R-07", "a camera may be inside of blobs", "1 - exp(-tau) before the camera", cameraInside},
        {"R-10", "a ray cut anywhere is the sum of its pieces", "the whole ray", depthCuts},
        {"R-13", "the order of blobs does not matter", "the first order", orders},
        {"B-07", "broken numbers are refused", "a dark ray that says so", brokenInput},
        {"B-08", "blobs at one depth do not flicker", "the first order", sameDepths},
    };
}

} // namespace fx::cli
