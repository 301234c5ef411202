/// @file accuracy_plot.cpp
/// The curve as a drawing that every browser shows.

#include "fxsdk/cli/accuracy_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace fx::cli {
namespace {

constexpr double kWidth = 860, kHeight = 560;                       // [pixel]
constexpr double kLeft = 90, kRight = 220, kTop = 50, kBottom = 60; // [pixel] margins

/// A logarithmic axis over whole decades and their 2 and 5.
struct Axis
{
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    double from = 0; ///< [pixel] of low
    double to = 1;   ///< [pixel] of high

    void include(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen()
    {
        low /= 1.3;
        high *= 1.3;
    }
    double at(double value) const
    {
        return from + (to - from) * std::log(value / low) / std::log(high / low);
    }
    std::vector<double> marks() const
    {
        std::vector<double> marks;
        for (int decade = int(std::floor(std::log10(low))); decade <= int(std::ceil(std::log10(high)));
             ++decade) {
            for (const double step : {1.0, 2.0, 5.0}) {
                const double value = step * std::pow(10.0, decade);
                if (value >= low && value <= high)
                    marks.push_back(value);
            }
        }
        return marks;
    }
};

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return out;
}

std::string textAt(double x, double y, const std::string& anchor, const std::string& text)
{
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y,
                  anchor.c_str());
    return buffer + escaped(text) + "</text>\n";
}

std::string lineAt(double x1, double y1, double x2, double y2)
{
    char buffer[160];
    std::snprintf(buffer, sizeof buffer,
                  "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#ccc\"/>\n", x1, y1, x2,
                  y2);
    return buffer;
}

std::string shortNumber(double value)
{
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", value);
    return buffer;
}

std::string gridOf(const Axis& x, const Axis& y)
{
    std::string svg;
    for (const double mark : x.marks())
        svg += lineAt(x.at(mark), kTop, x.at(mark), kHeight - kBottom) +
               textAt(x.at(mark), kHeight - kBottom + 18, "middle", shortNumber(mark));
    for (const double mark : y.marks())
        svg += lineAt(kLeft, y.at(mark), kWidth - kRight, y.at(mark)) +
               textAt(kLeft - 8, y.at(mark) + 4, "end", shortNumber(mark));
    return svg;
}

} // namespace

std::string curveSvg(const AccuracyCurve& curve, const std::string& machine)
{
    Axis x{.from = kLeft, .to = kWidth - kRight};
    Axis y{.from = kHeight - kBottom, .to = kTop};
    for (size_t k = 0; k < curve.points.size(); ++k) {
        x.include(timeRatio(curve, k).best);
        y.include(std::max(curve.points[k].sample.errorMean, 1e-12));
    }
    x.widen();
    y.widen();
    char buffer[256];
    std::snprintf(buffer, sizeof buffer,
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                  "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" "
                  "fill=\"white\"/>\n",
                  kWidth, kHeight);
    std::string svg =
        buffer + textAt(kLeft, 24, "start", curve.technique + " on " + curve.scene + ": error over time") +
        textAt(kLeft, 40, "start", machine) + gridOf(x, y) +
        textAt(0.5 * (kLeft + kWidth - kRight), kHeight - 16, "middle",
               "time, 1 = " + curve.points.front().setting.name) +
        textAt(kLeft - 70, kTop - 10, "start", "mean error");
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const double px = x.at(timeRatio(curve, k).best);
        const double py = y.at(std::max(point.sample.errorMean, 1e-12));
        std::snprintf(buffer, sizeof buffer, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"5\" fill=\"%s\"/>\n", px,
                      py, isOnFront(curve, k) ? "#c33" : "#999");
        svg += buffer + textAt(px + 8, py + 4, "start", point.setting.name);
    }
    return svg + "</svg>\n";
}

} // namespace fx::cli
