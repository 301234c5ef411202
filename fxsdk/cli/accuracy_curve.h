/// @file accuracy_curve.h
/// The outcome of fx accuracy: error against time, as text, CSV, JSON and SVG.
///
/// Repetitions of all settings are interleaved, A B C A B C, and each is compared with the baseline of its
/// own round, so that what else the machine does falls on all of them.
#pragma once

#include "fxsdk/cli/accuracy_technique.h"

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
    std::vector<AccuracyPoint> points; ///< the first is the baseline
};

/// Time of a point in units of the baseline's: fastest over fastest, and the range of the rounds. The median
/// of n rounds lies within that range with probability 1 - 2^(1-n).
struct TimeRatio
{
    double best;
    double low;
    double high;
};
TimeRatio timeRatio(const AccuracyCurve& curve, size_t point);

/// Whether no other point is both as fast (in fastest times) and as exact (in mean errors).
bool isOnFront(const AccuracyCurve& curve, size_t point);

std::string curveTable(const AccuracyCurve& curve);
std::string curveCsv(const AccuracyCurve& curve, const std::string& machine);
/// One object a point, without machine and version.
std::vector<nlohmann::json> curveJson(const AccuracyCurve& curve);
/// Error against time on logarithmic axes.
std::string curveSvg(const AccuracyCurve& curve, const std::string& machine);

} // namespace fx::cli
