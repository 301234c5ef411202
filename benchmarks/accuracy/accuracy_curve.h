/// @file accuracy_curve.h
/// The results of fx accuracy: error against time, as text, CSV, JSON and SVG.
///
/// Repetitions of all settings are interleaved, A B C A B C. Each repetition is compared with the baseline of
/// the same round. Load by other programs therefore affects all settings equally.
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
    std::vector<double> seconds; ///< [s] time of the timed part, one value per repetition
    /// Numbers of instructions executed in user space: one per repetition, or a single number if callgrind
    /// counts; 0 if the system cannot count instructions.
    std::vector<double> instructions;
};

struct AccuracyCurve
{
    std::string technique;
    std::string scene;
    std::string item; ///< name of the items of the column ns_per_item, such as "pixel"
    ShownError shown = ShownError::P99;
    std::vector<AccuracyPoint> points; ///< measured settings; the first one is the baseline
    std::string instructionsBy;        ///< "perf", "callgrind" or empty
    uint32_t threads = 1;
};

/// The error by which points are compared and drawn.
double shownError(const AccuracyCurve& curve, size_t point);
const char* shownErrorName(const AccuracyCurve& curve);

/// Time of a point relative to the baseline: ratio of the fastest times, and the range of the ratios of all
/// rounds. The true median of the ratio lies within the range of n rounds with probability 1 - 2^(1-n). The
/// ratios are 0 if no time was measured.
struct TimeRatio
{
    double best;
    double low;
    double high;
};
TimeRatio timeRatio(const AccuracyCurve& curve, size_t point);

/// [ns] Time per item in the fastest round.
double nanosecondsPerItem(const AccuracyPoint& point);

/// Efficiency 1 / (variance x time) of a point, divided by the efficiency of the baseline; 0 without
/// variance.
double efficiencyRatio(const AccuracyCurve& curve, size_t point);

/// Smallest number of instructions of a point over all repetitions, divided by the smallest number of the
/// baseline; 0 if unknown.
double instructionRatio(const AccuracyCurve& curve, size_t point);

/// Whether a point is on the Pareto front, that is, not dominated by another point. Point A dominates point B
/// under two conditions. A has neither a longer fastest time nor a larger shown error than B. In addition, A
/// has a smaller error, or a time that is shorter by more than 3 %. The 3 % are the noise of measured times:
/// two settings that do the same work are both on the front.
bool isOnFront(const AccuracyCurve& curve, size_t point);

std::string curveTable(const AccuracyCurve& curve);
/// Formats all curves as one table.
/// @param origin result of provenance()
std::string curvesCsv(const std::vector<AccuracyCurve>& curves, const std::string& origin);
/// One JSON object per point, without machine and version.
std::vector<nlohmann::json> curveJson(const AccuracyCurve& curve);
/// Plot of error against time on logarithmic axes, with one panel per curve.
std::string curvesSvg(const std::vector<AccuracyCurve>& curves, const std::string& origin);
/// A self-contained HTML page with the plots, and the tables below them.
std::string curvesHtml(const std::vector<AccuracyCurve>& curves, const std::string& origin);

} // namespace fx::cli
