#include "benchmarks/report/svg_chart.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {

std::string escapedMarkup(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return out;
}

void LogAxis::include(double value)
{
    low = std::min(low, value);
    high = std::max(high, value);
}

void LogAxis::widen(double below, double above)
{
    low /= below;
    high *= above;
}

double LogAxis::at(double value) const
{
    return from + (to - from) * std::log(value / low) / std::log(high / low);
}

std::vector<double> LogAxis::marks() const
{
    const double decades = std::log10(high / low);
    std::vector<double> marks;
    for (int decade = int(std::floor(std::log10(low))); decade <= int(std::ceil(std::log10(high))); ++decade)
        for (const double step : {1.0, 2.0, 5.0}) {
            const double value = step * std::pow(10.0, decade);
            const bool isUsed = decades < 3.0 || (step == 1.0 && (decades < 9.0 || decade % 2 == 0));
            if (value >= low && value <= high && isUsed)
                marks.push_back(value);
        }
    return marks;
}

std::string svgText(double x, double y, const char* anchor, const std::string& text, const char* more)
{
    return svgFormat("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor, more) +
           escapedMarkup(text) + "</text>\n";
}

std::string svgLine(double x1, double y1, double x2, double y2, const char* stroke)
{
    return svgFormat("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\"/>\n", x1, y1, x2,
                     y2, stroke);
}

} // namespace fx::cli
