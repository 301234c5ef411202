#include "benchmarks/stability/stability_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fx::cli {
namespace {

using Color = std::array<float, 3>;

constexpr int kLeft = 78, kTop = 40, kWidth = 540, kHeight = 270, kScaleLeft = kLeft + kWidth + 24,
              kScaleWidth = 16, kPictureWidth = kScaleLeft + kScaleWidth + 78,
              kPictureHeight = kTop + kHeight + 52;
constexpr double kBelow = 6.0, kAbove = 2.0; ///< [decades] of the color scale on both sides of the limit

/// What has the color of the limit. Exact maps have none: theirs is two decades below the largest error.
double scaleLimit(const StabilityMap& map)
{
    if (map.sweep.limit > 0.0)
        return map.sweep.limit;
    return std::isfinite(map.largest) && map.largest > 0.0 ? 0.01 * map.largest : 1.0;
}

/// 0 at the lower end of the scale, 1 at the upper. What exceeds the limit never has a color below it.
double level(double error, const StabilityMap& map)
{
    const double decades = error > 0.0 ? std::log10(error / scaleLimit(map)) : -kBelow;
    const double least = error > map.sweep.limit ? kBelow + 1e-6 : 0.0;
    return std::clamp(decades + kBelow, least, kBelow + kAbove) / (kBelow + kAbove);
}

Color mix(const Color& a, const Color& b, double t)
{
    Color color;
    for (size_t c = 0; c < 3; ++c)
        color[c] = float(a[c] + (b[c] - a[c]) * t);
    return color;
}

/// Blue to yellow within the limit, orange to dark red beyond it.
Color colorOf(double level)
{
    static constexpr double kLimit = kBelow / (kBelow + kAbove);
    static const Color kBlue{0.13f, 0.16f, 0.42f}, kGreen{0.18f, 0.55f, 0.55f}, kYellow{0.95f, 0.93f, 0.45f},
        kOrange{0.95f, 0.45f, 0.1f}, kRed{0.55f, 0.0f, 0.1f};
    if (level <= kLimit / 2)
        return mix(kBlue, kGreen, level / (kLimit / 2));
    if (level <= kLimit)
        return mix(kGreen, kYellow, level / (kLimit / 2) - 1.0);
    return mix(kOrange, kRed, (level - kLimit) / (1.0 - kLimit));
}

void fill(image::Image& picture, int left, int top, int width, int height, const Color& color)
{
    for (int y = std::max(top, 0); y < std::min(top + height, picture.height); ++y)
        for (int x = std::max(left, 0); x < std::min(left + width, picture.width); ++x)
            std::copy(color.begin(), color.end(), picture.at(x, y));
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", std::abs(value) < 1e-12 && value != 0.0 ? value : value + 0.0);
    return text;
}

constexpr Color kInk{0.1f, 0.1f, 0.1f};

void drawFrame(image::Image& picture, int left, int top, int width, int height)
{
    fill(picture, left - 1, top - 1, width + 2, 1, kInk);
    fill(picture, left - 1, top + height, width + 2, 1, kInk);
    fill(picture, left - 1, top - 1, 1, height + 2, kInk);
    fill(picture, left + width, top - 1, 1, height + 2, kInk);
}

/// Places of the numbers of an axis: at most `most`, the ends among them.
std::vector<size_t> labelled(size_t count, size_t most)
{
    std::vector<size_t> places;
    const size_t steps = std::min(count, most) - 1;
    for (size_t i = 0; i <= steps; ++i)
        places.push_back(steps == 0 ? 0 : i * (count - 1) / steps);
    return places;
}

void drawAxes(image::Image& picture, const StabilitySweep& sweep)
{
    const size_t columns = sweep.x.values.size(), rows = sweep.y.values.size();
    for (const size_t i : labelled(columns, 9)) {
        const int at = kLeft + int((double(i) + 0.5) * kWidth / double(columns));
        const std::string text = number(sweep.x.values[i]);
        fill(picture, at, kTop + kHeight, 1, 5, kInk);
        drawText(picture, at - 3 * int(text.size()), kTop + kHeight + 9, text);
    }
    for (const size_t i : labelled(rows, 9)) {
        const int at = kTop + kHeight - int((double(i) + 0.5) * kHeight / double(rows));
        const std::string text = number(sweep.y.values[i]);
        fill(picture, kLeft - 5, at, 5, 1, kInk);
        drawText(picture, kLeft - 9 - 6 * int(text.size()), at - 3, text);
    }
    drawText(picture, kLeft + kWidth / 2 - 3 * int(sweep.x.name.size()), kTop + kHeight + 28, sweep.x.name);
    drawText(picture, 6, kTop + kHeight / 2 + 3 * int(sweep.y.name.size()), sweep.y.name, true);
    drawFrame(picture, kLeft, kTop, kWidth, kHeight);
}

void drawScale(image::Image& picture, const StabilityMap& map)
{
    const double limit = scaleLimit(map);
    for (int y = 0; y < kHeight; ++y)
        fill(picture, kScaleLeft, kTop + kHeight - 1 - y, kScaleWidth, 1, colorOf((y + 0.5) / kHeight));
    for (int decade = int(-kBelow); decade <= int(kAbove); ++decade) {
        const int at = kTop + kHeight - 1 - int((decade + kBelow) * (kHeight - 1) / (kBelow + kAbove));
        fill(picture, kScaleLeft + kScaleWidth, at, 4, 1, kInk);
        drawText(picture, kScaleLeft + kScaleWidth + 7, at - 3, number(limit * std::pow(10.0, decade)));
        if (decade == 0 && map.sweep.limit > 0.0) {
            fill(picture, kScaleLeft - 4, at, kScaleWidth + 8, 2, kInk);
            drawText(picture, kScaleLeft + kScaleWidth + 7, at + 7, "= limit");
        }
    }
    drawFrame(picture, kScaleLeft, kTop, kScaleWidth, kHeight);
    drawText(picture, kScaleLeft - 6, kTop - 12, "error");
}

} // namespace

image::Image mapPicture(const StabilityResult& result, const StabilityMap& map)
{
    image::Image picture{kPictureWidth, kPictureHeight, 3, {}};
    picture.pixels.assign(size_t(kPictureWidth) * kPictureHeight * 3, 1.0f);
    const size_t columns = map.sweep.x.values.size(), rows = map.sweep.y.values.size();
    for (size_t row = 0; row < rows; ++row)
        for (size_t column = 0; column < columns; ++column) {
            const int left = int(column * kWidth / columns), right = int((column + 1) * kWidth / columns);
            const int low = int(row * kHeight / rows), high = int((row + 1) * kHeight / rows);
            const Color color = colorOf(level(map.errors[row * columns + column], map));
            fill(picture, kLeft + left, kTop + kHeight - high, right - left, high - low, color);
        }
    drawText(picture, kLeft, 8, std::string(result.row.id) + ": " + map.sweep.name);
    drawText(picture, kLeft, 22,
             "largest " + number(map.largest) + " at " + map.sweep.x.name + " = " + number(map.atX) + ", " +
                 map.sweep.y.name + " = " + number(map.atY) +
                 (map.sweep.isControl ? ", a control" : ", limit " + number(map.sweep.limit)));
    drawAxes(picture, map.sweep);
    drawScale(picture, map);
    return picture;
}

} // namespace fx::cli
