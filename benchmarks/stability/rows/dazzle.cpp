/// @file dazzle.cpp
/// DZ-01 to DZ-04: the dazzle of pictures that are empty, large or broken.

#include "benchmarks/stability/rows/dazzle_pictures.h"
#include "benchmarks/stability/stability_row.h"
#include "rendering/reference/dazzle/dazzle_levels.h"
#include "rendering/reference/dazzle/dazzle_light.h"

#include <algorithm>
#include <numeric>

namespace fx::cli {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<StabilitySweep> tiny(bool isQuick)
{
    const StabilitySweep sweep{
        "one pixel",
        powersOfTen("value", -6, 4.8, 10, isQuick),
        values("pixels", {0, 1}),
        0.0,
        false,
        [](double value, double pixels) {
            const std::vector<float> in(static_cast<size_t>(pixels), static_cast<float>(value));
            const auto out = dazzled(in, int(pixels));
            if (out.size() != in.size())
                return kEndless;
            return pixels > 0 ? std::fabs(double(out[0]) - std::fmin(double(in[0]), 1.0)) : 0.0;
        }};
    return {sweep, controlOf(sweep, "no headroom in plain code", [](double, double) {
                return double(plain<double>({1.0f})[0]); // 0 / 0
            })};
}

std::vector<StabilitySweep> large(bool isQuick)
{
    // rows of 16:9 pictures of this height, all pixels alike
    const auto sumOf = [](double height, double value) {
        const std::vector<float> row(size_t(height) * 16 / 9 * 4, float(value));
        const render::DazzleCounter counter(1.0f);
        render::DazzleSums sums;
        render::addDazzleLight(row, counter, sums);
        return sums.channels[0].overflow;
    };
    const auto wantedOf = [](double height, double value) {
        return render::DazzleCount(size_t(height) * 16 / 9) * render::DazzleCount(height) *
               render::DazzleCount((double(float(value)) - 1.0) * kQuanta);
    };
    const auto apart = [](render::DazzleCount a, render::DazzleCount b) {
        return double(a > b ? a - b : b - a);
    };
    const StabilitySweep sweep{
        "128 bits, quanta missing",
        values("height [pixel]", {1080, 2160, 4320, 8640}),
        isQuick ? values("value", {2, 65504}) : values("value", {2, 16, 256, 4096, 65504}),
        0.0,
        false,
        [=](double height, double value) {
            return apart(sumOf(height, value) * render::DazzleCount(height), wantedOf(height, value));
        }};
    return {sweep, controlOf(sweep, "64 bits", [=](double height, double value) {
                const uint64_t sum = uint64_t(sumOf(height, value)) * uint64_t(height);
                return apart(sum, wantedOf(height, value));
            })};
}

std::vector<StabilitySweep> broken(bool isQuick)
{
    const float bad[] = {std::nanf(""), -kInf, kInf}, instead[] = {0.0f, 0.0f, 65504.0f};
    const auto difference = [=](double place, double kind, bool isPlain) {
        std::vector<float> with = randomPicture(300, 3), without = with;
        with[size_t(place)] = bad[int(kind)];
        without[size_t(place)] = instead[int(kind)];
        if (isPlain)
            return double(plain<double>(with) != plain<double>(without));
        uint32_t replaced = 0;
        const bool isSame = dazzled(with, 20, &replaced) == dazzled(without, 20);
        return isSame && replaced == 3 ? 0.0 : 1.0;
    };
    const StabilitySweep sweep{"other pixels notice",
                               evenSteps("pixel", 0, 295, 59, isQuick),
                               values("nan, -inf, +inf", {0, 1, 2}),
                               0.0,
                               false,
                               [=](double place, double kind) { return difference(place, kind, false); }};
    return {sweep, controlOf(sweep, "plain code",
                             [=](double place, double kind) { return difference(place, kind, true); })};
}

/// Levels missing of those that are to be dealt: all on one level and one pixel above white.
double levelsLost(double level, double pixels, bool isPrinted)
{
    std::vector<uint32_t> levels(static_cast<size_t>(pixels), static_cast<uint32_t>(level));
    levels.push_back(255 + 25);
    const double room = pixels * (255.0 - level);
    const double wanted = std::fmin(room, 25.0) + pixels * level + 255.0;
    double sum = 0;
    if (isPrinted) {
        for (const int64_t v : render::dazzleLevelsAsPrinted(levels))
            sum += double(v);
    } else {
        for (const uint8_t v : render::dazzleLevels(levels, 1.0))
            sum += v;
    }
    return std::fabs(sum - wanted);
}

std::vector<StabilitySweep> histograms(bool isQuick)
{
    const StabilitySweep sweep{
        "levels lost or made",
        evenSteps("level", 0, 255, 255, false),
        isQuick ? values("pixels", {0, 1, 10}) : values("pixels", {0, 1, 2, 7, 10, 100}),
        0.0,
        false,
        [](double level, double n) { return levelsLost(std::floor(level), n, false); }};
    return {sweep, controlOf(sweep, "the published code",
                             [](double level, double n) { return levelsLost(std::floor(level), n, true); })};
}

} // namespace

StabilityRows dazzleStability()
{
    return {
        {"DZ-01", "no pixels and one pixel", "the pixel, at most white", tiny},
        {"DZ-02", "pictures full of 65504 up to 16K", "the product in 128 bits", large},
        {"DZ-03", "a broken pixel harms only itself", "the picture with a number in its place", broken},
        {"DZ-04", "histograms with one level", "what there is to deal", histograms},
    };
}

} // namespace fx::cli
