/// @file accuracy_curve.h
/// The outcome of fx accuracy: error against time, as text, CSV, JSON and SVG.
///
/// Repetitions of all settings are interleaved, A B C A B C, and each is compared with the baseline of its
/// own round, so that other load of the machine affects all of them.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace fx::cli {

/// All repetitions of one setting.
struct AccuracyPoint
{
    AccuracySetting setting;
    AccuracySample sample;            ///< of the first repetition; errors and work are the same in all
    std::vector<double> seconds;      ///< one for each repetition
    std::vector<double> instructions; ///< executed in user space, 0 where the system does not count
};

struct AccuracyCurve
{
    std::string technique;
    std::string scene;
    std::string item; ///< the item of ns_per_item
    ShownError shown = ShownError::P99;
    std::vector<AccuracyPoint> points; ///< the first is the baseline
    std::string instructionsBy;        ///< "perf", "callgrind" or empty
    uint32_t threads = 1;
};

/// The error by which points are compared and drawn.
double shownError(const AccuracyCurve& curve, size_t point);
const char* shownErrorName(const AccuracyCurve& curve);

/// Time of a point in units of the baseline's: fastest over fastest, and the range of the rounds. The median
/// of n rounds lies within that range with probability 1 - 2^(1-n). 0 where no time was taken.
struct TimeRatio
{
    double best;
    double low;
    double high;
};
TimeRatio timeRatio(const AccuracyCurve& curve, size_t point);

/// [ns] of the fastest round.
double nanosecondsPerItem(const AccuracyPoint& point);

/// 1 / (variance x time) of a point in units of the baseline's; 0 without variance.
double efficiencyRatio(const AccuracyCurve& curve, size_t point);

/// Fewest instructions of a point in units of the baseline's; 0 where they are not known.
double instructionRatio(const AccuracyCurve& curve, size_t point);

/// Whether no other point is both as fast (in fastest times) and as exact (in the shown error), and faster by
/// 3 % or more exact: two settings that turn out to do the same work are both on the front.
bool isOnFront(const AccuracyCurve& curve, size_t point);

std::string curveTable(const AccuracyCurve& curve);
/// One table of all curves. @param origin of provenance()
std::string curvesCsv(const std::vector<AccuracyCurve>& curves, const std::string& origin);
/// One object a point, without machine and version.
std::vector<nlohmann::json> curveJson(const AccuracyCurve& curve);
/// Error against time on logarithmic axes, a panel a curve.
std::string curvesSvg(const std::vector<AccuracyCurve>& curves, const std::string& origin);
/// A page that needs no other file: the plots, and the tables under them.
std::string curvesHtml(const std::vector<AccuracyCurve>& curves, const std::string& origin);

} // namespace fx::cli
