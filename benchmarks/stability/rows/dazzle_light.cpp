/// @file dazzle_light.cpp
/// DZ-05 to DZ-09: the light of the dazzle, over time and in all.

#include "rendering/reference/dazzle/dazzle_light.h"
#include "benchmarks/stability/rows/dazzle_pictures.h"
#include "benchmarks/stability/stability_row.h"

#include <algorithm>
#include <numeric>

namespace fx::cli {
namespace {

std::vector<StabilitySweep> adaptation(bool isQuick)
{
    const auto error = [](double tau, double parts, auto keep) {
        double product = 1;
        for (int i = 0; i < int(parts); ++i)
            product *= keep(1.0 / parts, tau);
        return std::fabs(product - std::exp(-1.0 / tau)) / std::numeric_limits<double>::epsilon();
    };
    const StabilitySweep sweep{
        "one second in parts, in roundings of 1",
        powersOfTen("time constant [s]", -1, 2, 20, isQuick),
        values("parts", {1, 2, 24, 60}),
        30.0, // half a rounding for each of 60 factors and 60 products below 1
        false,
        [=](double tau, double parts) { return error(tau, parts, render::dazzleKeep); }};
    return {sweep, controlOf(sweep, "steps of 1 - dt / tau", [=](double tau, double parts) {
                return error(tau, parts, [](double dt, double t) { return 1.0 - dt / t; });
            })};
}

/// Quanta of light that are missing.
double quantaLost(double width, double height, bool isPlain)
{
    const size_t pixels = size_t(width) * size_t(height);
    const std::vector<float> in = randomPicture(pixels, uint64_t(width * 100 + height));
    const auto count = [](double sum, float v) { return sum + std::floor(double(v) * kQuanta); };
    const double before = std::accumulate(in.begin(), in.end(), 0.0, count);
    double after = 0;
    if (isPlain) {
        for (const double v : plain<double>(in))
            after += std::round(std::fmin(v, 1.0) * kQuanta);
    } else {
        const auto out = dazzled(in, int(width));
        after = std::accumulate(out.begin(), out.end(), 0.0, count);
    }
    return std::fabs(after - std::fmin(before, double(pixels) * kQuanta));
}

std::vector<StabilitySweep> smallPictures(bool isQuick)
{
    std::vector<double> sizes;
    for (int i = 1; i <= 40; i += isQuick ? 5 : 1)
        sizes.push_back(i);
    const StabilitySweep sweep{
        "quanta lost", values("width", sizes), values("height", sizes), 0.0, false, [](double w, double h) {
            return quantaLost(w, h, false);
        }};
    return {sweep, controlOf(sweep, "shares rounded one by one",
                             [](double w, double h) { return quantaLost(w, h, true); })};
}

std::vector<StabilitySweep> belowWhite(bool isQuick)
{
    const auto changed = [](double scale, double seed, bool isByQuanta) {
        std::vector<float> in = randomPicture(500, uint64_t(seed));
        for (float& v : in)
            v = std::min(v, 1.0f) * float(scale);
        std::vector<float> out = dazzled(in, 25);
        if (isByQuanta)
            for (size_t i = 0; i < in.size(); ++i)
                out[i] = float(std::floor(double(in[i]) * kQuanta) / kQuanta);
        double count = 0;
        for (size_t i = 0; i < in.size(); ++i)
            count += out[i] != in[i] ? 1 : 0;
        return count;
    };
    const StabilitySweep sweep{"pixels that change",
                               powersOfTen("brightest", -12, -1e-3, 5, isQuick),
                               evenSteps("picture", 0, 10, 10, isQuick),
                               0.0,
                               false,
                               [=](double scale, double seed) { return changed(scale, seed, false); }};
    return {sweep, controlOf(sweep, "all pixels by way of quanta",
                             [=](double scale, double seed) { return changed(scale, seed, true); })};
}

std::vector<StabilitySweep> negative(bool isQuick)
{
    const StabilitySweep sweep{"difference to black",
                               powersOfTen("- value", -6, 4, 5, isQuick),
                               evenSteps("pixel", 0, 63, 63, isQuick),
                               0.0,
                               false,
                               [](double value, double place) {
                                   std::vector<float> in = randomPicture(64, 5), black = in;
                                   in[size_t(place)] = -float(value);
                                   black[size_t(place)] = 0.0f;
                                   return dazzled(in, 8) == dazzled(black, 8) ? 0.0 : 1.0;
                               }};
    return {sweep, controlOf(sweep, "plain code", [](double value, double place) {
                std::vector<float> in = randomPicture(64, 5), black = in;
                in[size_t(place)] = -float(value);
                black[size_t(place)] = 0.0f;
                return plain<double>(in) == plain<double>(black) ? 0.0 : 1.0;
            })};
}

std::vector<StabilitySweep> orders(bool isQuick)
{
    const auto difference = [](double megapixels, double saturated, bool isFloat) {
        const size_t pixels = size_t(megapixels * 1e6);
        std::vector<float> rgba(pixels * 4);
        for (size_t i = 0; i < pixels; ++i) {
            const float v = i < size_t(saturated) ? 65504.0f : 0.4f + 0.3f * float(i % 7) / 7.0f;
            std::fill_n(rgba.begin() + ptrdiff_t(4 * i), 4, v);
        }
        const render::DazzleCounter counter(1.0f);
        render::DazzleSums forward, backward;
        float up = 0.0f;
        double exact = 0;
        for (size_t i = 0; i < pixels; ++i) {
            up += rgba[4 * i];
            exact += double(rgba[4 * i]);
        }
        if (isFloat)
            return relativeError(double(up), exact);
        render::addDazzleLight(rgba, counter, forward);
        std::reverse(rgba.begin(), rgba.end());
        render::addDazzleLight(rgba, counter, backward);
        return forward.channels[0].overflow == backward.channels[0].overflow &&
                       forward.channels[0].headroom == backward.channels[0].headroom
                   ? 0.0
                   : 1.0;
    };
    const StabilitySweep sweep{"sum differs backwards",
                               isQuick ? values("megapixels", {0.1, 1}) : values("megapixels", {0.1, 1, 8.3}),
                               values("saturated pixels", {0, 30, 300, 3000}),
                               0.0,
                               false,
                               [=](double m, double s) { return difference(m, s, false); }};
    return {sweep, controlOf(sweep, "float sum in sequence",
                             [=](double m, double s) { return difference(m, s, true); })};
}

} // namespace

StabilityRows dazzleLightStability()
{
    return {
        {"DZ-05", "adaptation goes by time, not by frames", "exp(-1 / tau)", adaptation},
        {"DZ-06", "small pictures keep their light", "quanta before", smallPictures},
        {"DZ-07", "below white nothing changes", "the picture before", belowWhite},
        {"DZ-08", "negative pixels are black", "the picture with black", negative},
        {"DZ-09", "sums do not depend on the order", "the sum backwards; double", orders},
    };
}

} // namespace fx::cli
