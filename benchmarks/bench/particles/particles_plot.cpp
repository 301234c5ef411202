#include "benchmarks/bench/particles/particles_plot.h"

#include "benchmarks/bench/particles/particle_rows.h"
#include "benchmarks/report/svg_chart.h"
#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/machine.h"
#include "fxsdk/cli/support/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

namespace fx::cli {
namespace {

constexpr double kWidth = 720, kHeight = 700;      // [pixel]
constexpr double kLeft = 70, kRight = 90;          // [pixel]
constexpr double kStepTop = 48, kStepEnd = 410;    // [pixel] times of steps
constexpr double kShareTop = 470, kShareEnd = 650; // [pixel] the same for one particle
constexpr double kPlateau = 1e6;                   ///< particles, from which on nothing stays in the caches
constexpr std::array<uint64_t, 9> kCounts{1000,    3000,      10'000,    30'000,    100'000,
                                          300'000, 1'000'000, 3'000'000, 10'000'000};
constexpr std::array<const char*, 3> kColors{"#1f6fb4", "#2e8b57", "#c0392b"};
constexpr double kLongest = 0.5; ///< [s] of a step; more particles are not tried

struct Line
{
    std::string variant;
    std::vector<double> counts;
    std::vector<double> milliseconds; ///< median of a step
    std::vector<double> nanoseconds;  ///< the same for one particle
};

base::Result<std::vector<Line>> measureLines(uint32_t threads, uint64_t most)
{
    const auto variants = particleVariants();
    const auto counts = std::span(kCounts.begin(), std::ranges::upper_bound(kCounts, most));
    std::vector<Line> lines;
    Progress bar("size", variants.size() * counts.size(), true);
    uint64_t done = 0;
    for (const std::string_view variant : variants) {
        Line line;
        line.variant = variant;
        for (const uint64_t count : counts) {
            BenchSettings settings;
            settings.count = count;
            settings.threads = threads;
            settings.steps = count < 100'000 ? 300 : 20;
            const auto row = benchParticles(settings, variant);
            if (!row)
                return row.status();
            line.counts.push_back(double(count));
            line.milliseconds.push_back(1e-6 * row->medianNanoseconds * double(count));
            line.nanoseconds.push_back(row->medianNanoseconds);
            bar.update(++done);
            if (1e-3 * line.milliseconds.back() * 3.0 > kLongest)
                break;
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

using Values = std::vector<double> Line::*;

/// Axes, marks and curves of one quantity.
std::string panel(const std::vector<Line>& lines, Values values, LogAxis x, LogAxis y)
{
    for (const Line& line : lines)
        for (size_t i = 0; i < line.counts.size(); ++i) {
            x.include(line.counts[i]);
            y.include((line.*values)[i]);
        }
    y.widen(2, 2);
    std::string svg;
    for (const double mark : x.marks())
        svg += svgLine(x.at(mark), y.to, x.at(mark), y.from, "#e4e4e4") +
               svgText(x.at(mark), y.from + 17, "middle", svgFormat("%g", mark));
    for (const double mark : y.marks())
        svg += svgLine(kLeft, y.at(mark), x.to, y.at(mark), "#e4e4e4") +
               svgText(kLeft - 7, y.at(mark) + 4, "end", svgFormat("%g", mark));
    if (const double frame = y.at(1000.0 / 60.0); values == &Line::milliseconds)
        svg += svgLine(kLeft, frame, x.to, frame, "#c77800") +
               svgText(kLeft + 4, frame - 4, "start", "a frame of 60 Hz");
    for (size_t k = 0; k < lines.size(); ++k) {
        const std::vector<double>& counts = lines[k].counts;
        const std::vector<double>& heights = lines[k].*values;
        const char* color = kColors[k % kColors.size()];
        std::string path;
        for (size_t i = 0; i < counts.size(); ++i)
            path += svgFormat("%s%.1f %.1f", i == 0 ? "M" : " L", x.at(counts[i]), y.at(heights[i]));
        svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"2\"/>\n" +
               svgText(x.at(counts.back()) + 6, y.at(heights.back()) + 4, "start", lines[k].variant);
    }
    return svg;
}

std::string drawing(const std::vector<Line>& lines, const std::string& origin)
{
    LogAxis x, step, share;
    x.from = kLeft;
    x.to = kWidth - kRight;
    step.from = kStepEnd;
    step.to = kStepTop;
    step.include(1000.0 / 60.0);
    share.from = kShareEnd;
    share.to = kShareTop;
    return svgFormat("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                     "font-family=\"sans-serif\" "
                     "font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
                     kWidth, kHeight) +
           svgText(12, 16, "start", origin, "font-size=\"11\" fill=\"#555\"") +
           svgText(kLeft, kStepTop - 8, "start", "time of a step and its snapshot [ms]") +
           panel(lines, &Line::milliseconds, x, step) +
           svgText(kLeft, kShareTop - 8, "start", "the same for one particle [ns]") +
           panel(lines, &Line::nanoseconds, x, share) +
           svgText(0.5 * (kLeft + x.to), kHeight - 12, "middle", "particles") + "</svg>\n";
}

/// Exponent of time over number, by least squares of the logarithms over all sizes from `fewest` on. Over
/// all it is above 1 where small numbers of particles stay in the caches and large ones wait for memory.
double exponentOf(const Line& line, double fewest)
{
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t i = 0; i < line.counts.size(); ++i) {
        if (line.counts[i] < fewest)
            continue;
        const double x = std::log(line.counts[i]), y = std::log(line.milliseconds[i]);
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return n > 1 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : 0.0;
}

/// How many particles a step of `milliseconds` holds, by the slope between the two sizes around it.
double affordable(const Line& line, double milliseconds)
{
    for (size_t i = 1; i < line.counts.size(); ++i)
        if (line.milliseconds[i] >= milliseconds) {
            const double t = std::log(milliseconds / line.milliseconds[i - 1]) /
                             std::log(line.milliseconds[i] / line.milliseconds[i - 1]);
            return line.counts[i - 1] * std::pow(line.counts[i] / line.counts[i - 1], t);
        }
    return line.counts.back();
}

void print(const Line& line)
{
    std::printf("%-8s %.0f particles in 1 ms, %.0f in 4 ms; time grows as N^%.3f", line.variant.c_str(),
                affordable(line, 1.0), affordable(line, 4.0), exponentOf(line, 0.0));
    if (line.counts.back() > kPlateau)
        std::printf(", beyond %g as N^%.3f", kPlateau, exponentOf(line, kPlateau));
    std::printf("; ns for one:");
    for (size_t i = 0; i < line.counts.size(); ++i)
        std::printf("%s %g: %.2f", i == 0 ? "" : ",", line.counts[i], line.nanoseconds[i]);
    std::printf("\n");
}

} // namespace

int runBenchPlot(const std::string& file, uint32_t threads, uint64_t most)
{
    const auto failed = [](const base::Status& status) {
        std::fprintf(stderr, "fx bench: %s\n", status.message().c_str());
        return exitCodeOf(status);
    };
    if (!file.ends_with(".svg")) {
        std::fprintf(stderr, "fx bench: --plot: '%s' does not end in .svg, which is what is drawn\n",
                     file.c_str());
        return kUsage;
    }
    if (base::Status status = checkTarget(file); !status)
        return failed(status);
    const auto lines = measureLines(threads, most);
    if (!lines)
        return failed(lines.status());
    const std::string origin =
        "fx bench --plot, " + toText(readMachine()) + ", " + std::to_string(threads) + " threads";
    if (base::Status status = writeFileAtomically(file, drawing(*lines, origin)); !status)
        return failed(status);
    for (const Line& line : *lines)
        print(line);
    std::printf("%s\n", origin.c_str());
    return kSuccess;
}

} // namespace fx::cli
