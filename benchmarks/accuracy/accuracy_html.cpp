/// @file accuracy_html.cpp
/// The report as one page: what was measured, on what, the plots and every number.

#include "benchmarks/accuracy/accuracy_curve.h"
#include "benchmarks/report/label_places.h"
#include "benchmarks/report/svg_chart.h"

#include <cstdio>

namespace fx::cli {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>fx accuracy</title>
<style>
body { font-family: sans-serif; max-width: 1300px; margin: 2em auto; padding: 0 1em; color: #222; }
svg { max-width: 100%; height: auto; }
table { border-collapse: collapse; margin: 1em 0 2em; font-size: 90%; }
th, td { padding: 0.2em 0.8em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child { text-align: left; }
tr.front { background: #fdf0ea; }
p.note { color: #555; }
</style></head><body>
<h1>What exactness costs in time</h1>
)";

std::string cell(const char* pattern, double value)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, pattern, value);
    return std::string("<td>") + buffer + "</td>";
}

std::string tableOf(const AccuracyCurve& curve)
{
    std::string html =
        "<h2>" + escapedMarkup(curve.technique + ": " + curve.scene) +
        "</h2>\n<table><tr><th>setting</th><th>tier</th><th>p50</th><th>p99</th><th>largest</th>"
        "<th>mean</th><th>bias</th><th>time</th><th>range of rounds</th><th>instructions</th><th>ns / " +
        escapedMarkup(curve.item) + "</th></tr>\n";
    for (size_t k = 0; k < curve.points.size(); ++k) {
        const AccuracyPoint& point = curve.points[k];
        const AccuracySample& s = point.sample;
        const TimeRatio ratio = timeRatio(curve, k);
        html += isOnFront(curve, k) ? "<tr class=\"front\">" : "<tr>";
        html += "<td>" + escapedMarkup(point.setting.name) + "</td><td>" + point.setting.tier + "</td>" +
                cell("%.3g", s.errorP50) + cell("%.3g", s.errorP99) + cell("%.3g", s.errorMax) +
                cell("%.3g", s.errorMean) + cell("%.2g", s.bias) + cell("%.3f", ratio.best) + "<td>";
        char range[64];
        std::snprintf(range, sizeof range, "%.2f .. %.2f</td>", ratio.low, ratio.high);
        html += range;
        html += instructionRatio(curve, k) > 0 ? cell("%.3f", instructionRatio(curve, k)) : "<td>-</td>";
        html += cell("%.1f", nanosecondsPerItem(point)) + "</tr>\n";
    }
    return html + "</table>\n";
}

} // namespace

std::string curvesHtml(const std::vector<AccuracyCurve>& curves, const std::string& origin)
{
    std::string html = kHead;
    html +=
        "<p>" + escapedMarkup(origin) +
        "</p>\n<p class=\"note\">Errors are relative to the reference. Time and "
        "instructions are in units of the first setting of each table; all settings of a table ran in turn, "
        "again and again, in one process. Shaded rows are on the Pareto front: no other setting is both as "
        "fast and as exact.";
    if (!curves.empty() && curves.front().instructionsBy == "callgrind")
        html += " Instructions are those of a simulated processor with AVX2.";
    html += "</p>\n" + curvesSvg(curves, origin);
    for (const AccuracyCurve& curve : curves)
        html += tableOf(curve);
    return html + "</body></html>\n";
}

} // namespace fx::cli
