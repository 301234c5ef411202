/// @file svg_chart.h
/// Drawing functions of charts with logarithmic axes, as SVG text.
#pragma once

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace fx::cli {

/// A logarithmic axis. The axis has marks at every power of ten or at every second power of ten. If the axis
/// covers few powers of ten, it also has marks at 2 and 5 times each power of ten.
struct LogAxis
{
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    double from = 0; ///< [pixel] position of `low`
    double to = 1;   ///< [pixel] position of `high`

    void include(double value);
    void widen(double below, double above);
    double at(double value) const; ///< [pixel]
    std::vector<double> marks() const;
};

/// Escapes `<`, `>` and `&` for XML and HTML.
std::string escapedMarkup(const std::string& text);

template <class... Numbers>
std::string svgFormat(const char* pattern, Numbers... numbers)
{
    char buffer[400];
    std::snprintf(buffer, sizeof buffer, pattern, numbers...);
    return buffer;
}

/// Creates a text element.
/// @param anchor "start", "middle" or "end"
std::string svgText(double x, double y, const char* anchor, const std::string& text, const char* more = "");
std::string svgLine(double x1, double y1, double x2, double y2, const char* stroke);

} // namespace fx::cli
