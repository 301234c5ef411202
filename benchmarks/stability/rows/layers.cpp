/// @file layers.cpp
/// L-01 to L-05: layers over one another, as shaders/frame/composite.frag.glsl puts them.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"

#include <algorithm>

namespace fx::cli {
namespace {

/// One channel and its opacity. The channel is premultiplied unless said otherwise.
template <class T>
struct Layer
{
    T color, alpha;
};

template <class T>
Layer<T> over(const Layer<T>& m, const Layer<T>& b)
{
    return {m.color + (T(1) - m.alpha) * b.color, m.alpha + (T(1) - m.alpha) * b.alpha};
}

/// The nearest half float, infinity beyond 65504.
float half(float x)
{
    if (std::fabs(x) >= 65520.0f)
        return std::copysign(std::numeric_limits<float>::infinity(), x);
    int exponent = 0;
    std::frexp(x, &exponent);
    const int lowest = std::max(exponent - 11, -24);
    return std::ldexp(std::nearbyint(std::ldexp(x, -lowest)), lowest);
}

/// Layers of one opacity from back to front, as a share of the brightest, which is 1. @param store what
/// becomes of a number that is kept
double stackError(double count, double alpha, float (*store)(float), float (*atEnd)(float))
{
    SweepRandom random{uint64_t(count)};
    Layer<float> sum{0.25f, 0.0f};
    Layer<double> exact{0.25, 0.0};
    for (int i = 0; i < int(count); ++i) {
        const float a = float(alpha), c = float(random.between(0.2, 1.0)) * a;
        sum = over({c, a}, sum);
        sum = {store(sum.color), store(sum.alpha)};
        exact = over({double(c), double(a)}, exact);
    }
    return std::fmax(std::fabs(double(atEnd(sum.color)) - exact.color),
                     std::fabs(double(atEnd(sum.alpha)) - exact.alpha));
}

std::vector<StabilitySweep> precisions(bool isQuick)
{
    const auto same = [](float x) { return x; };
    const StabilityAxis count = values("layers", {1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024});
    const StabilityAxis few = values("layers", {1, 2, 4, 8, 16});
    const StabilityAxis alpha = powersOfTen("alpha", -4, -0.05, 10, isQuick);
    const auto error = [](float (*store)(float), float (*atEnd)(float)) {
        return [store, atEnd](double n, double a) { return stackError(n, a, store, atEnd); };
    };
    const StabilitySweep inFloat{"float", count, alpha, 1e-5, false, error(same, same)};
    const StabilitySweep stored{"float, stored as half", count, alpha, 2e-3, false, error(same, half)};
    return {inFloat, stored, StabilitySweep{"half, 16 layers", few, alpha, 2e-3, false, error(half, half)},
            controlOf(stored, "half all along", error(half, half))};
}

std::vector<StabilitySweep> borders(bool isQuick)
{
    const StabilitySweep sweep{
        "premultiplied",
        evenSteps("place between two texels", 0.0, 1.0, 100, isQuick),
        evenSteps("alpha", 0.0, 1.0, 50, isQuick),
        std::ldexp(4.0, -24),
        false,
        [](double place, double alpha) {
            const float f = float(place), a = float(alpha), behind = 0.5f;
            const Layer<float> edge{a * (1.0f - f), a * (1.0f - f)}; // a white texel beside an empty one
            const double wanted = double(a) * (1.0 - double(f)) + (1.0 - double(a) * (1.0 - double(f))) * 0.5;
            return std::fabs(double(over(edge, {behind, 1.0f}).color) - wanted);
        }};
    return {sweep,
            controlOf(sweep, "straight alpha, an empty texel is black", [](double place, double alpha) {
                const double a = alpha * (1.0 - place), color = 1.0 - place;
                return std::fabs(color * a + (1.0 - a) * 0.5 - (a + (1.0 - a) * 0.5));
            })};
}

std::vector<StabilitySweep> blocks(bool isQuick)
{
    const auto layerOf = [](double alpha, SweepRandom& random) {
        const float a = float(alpha * random.between(0.5, 1.0));
        return Layer<float>{float(random.next()) * a, a};
    };
    const StabilitySweep sweep{"(a over b) over c, in roundings",
                               evenSteps("alpha", 0.0, 1.0, 50, isQuick),
                               evenSteps("set", 0, 200, 200, isQuick),
                               4.0,
                               false,
                               [layerOf](double alpha, double seed) {
                                   SweepRandom random{uint64_t(seed)};
                                   const auto a = layerOf(alpha, random), b = layerOf(alpha, random),
                                              c = layerOf(alpha, random);
                                   const auto left = over(over(a, b), c), right = over(a, over(b, c));
                                   return std::fmax(std::fabs(double(left.color) - double(right.color)),
                                                    std::fabs(double(left.alpha) - double(right.alpha))) *
                                          16777216.0;
                               }};
    return {sweep, controlOf(sweep, "straight alpha mixed twice", [layerOf](double alpha, double seed) {
                SweepRandom random{uint64_t(seed)};
                const auto a = layerOf(alpha, random), b = layerOf(alpha, random), c = layerOf(alpha, random);
                const auto mix = [](const Layer<float>& m, const Layer<float>& n) {
                    return Layer<float>{m.color * m.alpha + n.color * (1.0f - m.alpha),
                                        std::max(m.alpha, n.alpha)};
                };
                return std::fabs(double(mix(mix(a, b), c).color) - double(mix(a, mix(b, c)).color)) *
                       16777216.0;
            })};
}

std::vector<StabilitySweep> extremes(bool isQuick)
{
    const StabilitySweep sweep{
        "pure emission and opaque layers",
        powersOfTen("color", -6, 4, 5, isQuick),
        powersOfTen("behind", -6, 4, 5, isQuick),
        0.0,
        false,
        [](double color, double behind) {
            const float c = float(color), b = float(behind);
            return std::fabs(double(over<float>({c, 0.0f}, {b, 1.0f}).color) - double(c + b)) +
                   std::fabs(double(over<float>({c, 1.0f}, {b, 1.0f}).color) - double(c));
        }};
    return {sweep, controlOf(sweep, "straight alpha loses emission", [](double color, double behind) {
                const float got = float(color) * 0.0f + float(behind) * 1.0f;
                return std::fabs(double(got) - double(float(color) + float(behind)));
            })};
}

/// Fire that shines and smoke that does not, at a distance of `gap` radii.
SweepBlobs fireAndSmoke(double depth, double gap, bool isSwapped)
{
    const double extinction = depth * 15.0 / 32.0;
    const uint32_t fire = isSwapped ? 1 : 0;
    return {{5.0, 1.0, 1.0, extinction, {1.0, 0.6, 0.2}, fire},
            {5.0 + gap, 1.0, 1.0, extinction, {0.05, 0.05, 0.05}, 1 - fire}};
}

std::vector<StabilitySweep> interpenetration(bool isQuick)
{
    const auto light = [](const char* scheme, const SweepBlobs& blobs) {
        return lightOf<double>(settingsFor(scheme), blobs).radiance[0];
    };
    const StabilitySweep joint{"one joint integral",
                               powersOfTen("tau", -2, 2, 10, isQuick),
                               evenSteps("distance [radius]", -2.0, 2.0, 40, isQuick),
                               0.02,
                               false,
                               [light](double depth, double gap) {
                                   const SweepBlobs blobs = fireAndSmoke(depth, gap, false);
                                   return relativeError(light("gauss-5", blobs),
                                                        light("gauss-8-cap-0.1", blobs));
                               }};
    StabilitySweep swapped = joint;
    swapped.name = "numbered the other way";
    swapped.limit = 1e-14;
    swapped.error = [light](double depth, double gap) {
        return relativeError(light("gauss-5", fireAndSmoke(depth, gap, true)),
                             light("gauss-5", fireAndSmoke(depth, gap, false)));
    };
    return {joint, swapped,
            controlOf(joint, "two layers sorted by their centers", [light](double depth, double gap) {
                const SweepBlobs blobs = fireAndSmoke(depth, gap, false);
                const double alpha = -std::expm1(-depth / 2.0);
                const Layer<double> fire{alpha, alpha}, smoke{0.05 * alpha, alpha};
                const double sum = gap > 0 ? over(fire, smoke).color : over(smoke, fire).color;
                return relativeError(sum, light("gauss-8-cap-0.1", blobs));
            })};
}

} // namespace

StabilityRows layersStability()
{
    return {
        {"L-01", "sums of layers keep their digits", "the same in double", precisions},
        {"L-02", "filtering goes with composition", "composition of filtered light", borders},
        {"L-03", "layers may be grouped", "the other grouping", blocks},
        {"L-04", "emission without opacity, and opacity of 1", "exact sums", extremes},
        {"L-05", "fire within smoke is one integral", "gauss-8-cap-0.1", interpenetration},
    };
}

} // namespace fx::cli
