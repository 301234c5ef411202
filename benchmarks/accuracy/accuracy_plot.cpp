/// @file accuracy_plot.cpp
/// The curves as a drawing that every browser shows: a panel a curve, error over time on logarithmic axes.

#include "benchmarks/accuracy/accuracy_curve.h"
#include "benchmarks/report/label_places.h"
#include "benchmarks/report/svg_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace fx::cli {
namespace {

constexpr double kPanelWidth = 640, kPanelHeight = 460;            // [pixel]
constexpr double kLeft = 76, kRight = 24, kTop = 44, kBottom = 52; // [pixel] margins of a panel
constexpr double kHead = 40;                                       // [pixel] above all panels
constexpr const char* kColors[] = {"#1f6fb4", "#c0392b", "#2e8b57", "#8e5ea2",
                                   "#c77800", "#444444", "#008b8b"};

constexpr const char* kFrontStroke = "#f2b8a0\" stroke-width=\"5\" stroke-linecap=\"round";

/// "paper" of "paper-4": settings of one family are joined by a line.
std::string familyOf(const std::string& name)
{
    return name.substr(0, name.find_first_of("-0123456789 "));
}

/// One curve with its axes; places are relative to the panel.
class Panel
{
public:
    explicit Panel(const AccuracyCurve& curve) : curve_(curve)
    {
        x_.from = kLeft;
        x_.to = kPanelWidth - kRight;
        y_.from = kPanelHeight - kBottom;
        y_.to = kTop;
        for (size_t k = 0; k < curve.points.size(); ++k) {
            x_.include(timeRatio(curve, k).best);
            if (shownError(curve, k) > 0 && shownError(curve, k) < 1e6)
                y_.include(shownError(curve, k));
        }
        if (!(y_.high > 0))
            y_.low = y_.high = 1;
        x_.widen(1.25, std::pow(x_.high / x_.low, 0.12) * 1.3); // room for labels
        y_.widen(3, 3);
        for (const AccuracyPoint& point : curve.points)
            colors_.try_emplace(familyOf(point.setting.name), kColors[colors_.size() % std::size(kColors)]);
    }

    std::string svg() const { return grid() + front() + families() + points(); }

private:
    double px(size_t k) const { return x_.at(timeRatio(curve_, k).best); }
    /// Errors of 0 and beyond the axis lie on its ends.
    double py(size_t k) const
    {
        return y_.at(std::clamp(shownError(curve_, k), y_.low * 1.5, y_.high / 1.5));
    }

    std::string grid() const
    {
        std::string svg = svgText(kLeft, 20, "start", curve_.technique + ": " + curve_.scene,
                                  "font-size=\"15\" font-weight=\"bold\"");
        for (const double mark : x_.marks())
            svg += svgLine(x_.at(mark), kTop, x_.at(mark), y_.from, "#e4e4e4") +
                   svgText(x_.at(mark), y_.from + 17, "middle", svgFormat("%g", mark));
        for (const double mark : y_.marks())
            svg += svgLine(kLeft, y_.at(mark), x_.to, y_.at(mark), "#e4e4e4") +
                   svgText(kLeft - 7, y_.at(mark) + 4, "end", svgFormat("%g", mark));
        svg += svgFormat(
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#999\"/>\n",
            kLeft, kTop, x_.to - kLeft, y_.from - kTop);
        return svg +
               svgText(0.5 * (kLeft + x_.to), kPanelHeight - 14, "middle",
                       "time, 1 = " + curve_.points.front().setting.name) +
               svgText(kLeft, kTop - 7, "start", shownErrorName(curve_));
    }

    /// Steps along the settings that no other beats.
    std::string front() const
    {
        std::vector<size_t> best;
        for (size_t k = 0; k < curve_.points.size(); ++k)
            if (isOnFront(curve_, k))
                best.push_back(k);
        std::sort(best.begin(), best.end(), [&](size_t a, size_t b) { return px(a) < px(b); });
        std::string svg;
        for (size_t i = 1; i < best.size(); ++i) {
            const double x = px(best[i]), before = py(best[i - 1]), after = py(best[i]);
            svg += svgLine(px(best[i - 1]), before, x, before, kFrontStroke) +
                   svgLine(x, before, x, after, kFrontStroke);
        }
        return svg;
    }

    std::string families() const
    {
        std::string svg;
        for (const auto& [family, color] : colors_) {
            std::string path;
            for (size_t k = 0; k < curve_.points.size(); ++k)
                if (familyOf(curve_.points[k].setting.name) == family)
                    path += svgFormat("%s%.1f %.1f", path.empty() ? "M" : " L", px(k), py(k));
            svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + color +
                   "\" stroke-opacity=\"0.5\" stroke-width=\"1\"/>\n";
        }
        return svg;
    }

    std::string points() const
    {
        LabelPlaces places(kLeft + 2, kTop + 2, x_.to - 2, y_.from - 2);
        for (size_t k = 0; k < curve_.points.size(); ++k)
            places.avoid(px(k), py(k));
        std::string svg;
        for (size_t k = 0; k < curve_.points.size(); ++k) {
            const AccuracySetting& setting = curve_.points[k].setting;
            const char* color = colors_.at(familyOf(setting.name));
            const bool isBest = isOnFront(curve_, k);
            svg += svgFormat("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"%s\" stroke=\"%s\" "
                             "stroke-width=\"1.5\"/>\n",
                             px(k), py(k), isBest ? color : "white", color);
            std::string label = setting.name;
            if (!setting.tier.empty())
                label += " (" + setting.tier + ")";
            if (!(shownError(curve_, k) > 0))
                label += ": exact";
            const LabelPlaces::Place place = places.place(px(k), py(k), label);
            svg +=
                svgText(place.x, place.y, "start", label,
                        setting.tier.empty() ? "font-size=\"11\"" : "font-size=\"11\" font-weight=\"bold\"");
        }
        return svg;
    }

    const AccuracyCurve& curve_;
    LogAxis x_, y_;
    std::map<std::string, const char*> colors_;
};

} // namespace

std::string curvesSvg(const std::vector<AccuracyCurve>& curves, const std::string& origin)
{
    const size_t columns = curves.size() > 1 ? 2 : 1;
    const size_t rows = (curves.size() + columns - 1) / columns;
    const double width = kPanelWidth * double(columns);
    const double height = kHead + kPanelHeight * double(rows);
    std::string svg = svgFormat("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                                "viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" font-size=\"12\">\n"
                                "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                                width, height, width, height);
    svg += svgText(12, 16, "start", origin, "font-size=\"11\" fill=\"#555\"") +
           svgText(12, 32, "start",
                   "filled, on the broad line: no other setting is both as fast and as exact (Pareto front)",
                   "font-size=\"11\" fill=\"#555\"");
    for (size_t i = 0; i < curves.size(); ++i)
        svg += svgFormat("<g transform=\"translate(%.0f,%.0f)\">\n", kPanelWidth * double(i % columns),
                         kHead + kPanelHeight * double(i / columns)) +
               Panel(curves[i]).svg() + "</g>\n";
    return svg + "</svg>\n";
}

} // namespace fx::cli
