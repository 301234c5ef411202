/// @file accuracy_curve.h
/// The results of fx accuracy: error against time, as text, CSV, JSON and SVG.
///
/// Repetitions of all settings are interleaved, A B C A B C. Each is compared with the baseline of its own
/// round, so that other load of the machine affects all settings equally.
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
    AccuracySample sample; ///< result of the first repetition; errors and work are equal in all repetitions
    std::vector<double> seconds; ///< [s] one value per repetition
    /// Instructions executed in user space; 0 if the system cannot count them
    std::vector<double> instructions;
};

struct AccuracyCurve
{
    std::string technique;
    std::string scene;
    std::string item; ///< the item that ns_per_item counts
    ShownError shown = ShownError::P99;
    std::vector<AccuracyPoint> points; ///< the first is the baseline
    std::string instructionsBy;        ///< "perf", "callgrind" or empty
    uint32_t threads = 1;
};

/// The error by which points are compared and drawn.
double shownError(const AccuracyCurve& curve, size_t point);
const char* shownErrorName(const AccuracyCurve& curve);

/// Time of a point relative to the baseline: ratio of the fastest times, and the range of the ratios of all
/// rounds. The median of n rounds is within that range with probability 1 - 2^(1-n). 0 if no time was
/// measured.
struct TimeRatio
{
    double best;
    double low;
    double high;
};
TimeRatio timeRatio(const AccuracyCurve& curve, size_t point);

/// [ns] Time per item in the fastest round.
double nanosecondsPerItem(const AccuracyPoint& point);

/// 1 / (variance x time) of a point relative to the baseline; 0 without variance.
double efficiencyRatio(const AccuracyCurve& curve, size_t point);

/// Smallest number of instructions of a point relative to the baseline; 0 if unknown.
double instructionRatio(const AccuracyCurve& curve, size_t point);

/// Whether a point is on the Pareto front of fastest time and shown error. A point is dominated if another
/// one is at least as fast and as exact, and faster by 3 % or more exact. Two settings that do the same work
/// are therefore both on the front.
bool isOnFront(const AccuracyCurve& curve, size_t point);

std::string curveTable(const AccuracyCurve& curve);
/// One table of all curves. @param origin result of provenance()
std::string curvesCsv(const std::vector<AccuracyCurve>& curves, const std::string& origin);
/// One object per point, without machine and version.
std::vector<nlohmann::json> curveJson(const AccuracyCurve& curve);
/// Error against time on logarithmic axes, with one panel per curve.
std::string curvesSvg(const std::vector<AccuracyCurve>& curves, const std::string& origin);
/// A self-contained page with the plots, and the tables below them.
std::string curvesHtml(const std::vector<AccuracyCurve>& curves, const std::string& origin);

} // namespace fx::cli
