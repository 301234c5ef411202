/// @file stability_run.h
/// Runs the sweeps of fx stability and reports the results.
#pragma once

#include "benchmarks/stability/stability_row.h"
#include "foundation/result/status.h"

#include <functional>
#include <string>
#include <vector>

namespace fx::cli {

/// The errors of a sweep, one row per value of y.
struct StabilityMap
{
    StabilitySweep sweep;
    std::vector<double> errors;
    double largest = 0; ///< largest error; infinity if an error is NaN
    double atX = 0;
    double atY = 0;

    bool exceedsLimit() const { return !(largest <= sweep.limit); }
    /// Whether the errors are within the limit or, for a control, exceed the limit.
    bool isAsItMust() const { return exceedsLimit() == sweep.isControl; }
};

struct StabilityResult
{
    StabilityRow row;
    std::vector<StabilityMap> maps;

    bool isAsItMust() const;
    /// The sweep with the largest ratio of error to limit.
    const StabilityMap& tightest() const;
};

struct RunWatch
{
    std::function<bool()> stop;
    /// Callback that receives the number of computed points of the row and the number of all points.
    std::function<void(uint64_t done, uint64_t all)> progress;
};

/// Runs a row. @return Interrupted after a signal
base::Result<StabilityResult> runStability(const StabilityRow& row, bool isQuick, const RunWatch& watch);

/// Returns text such as "R-01 ok  1.2e-07 of 4.8e-07 in float at s = 3, n = 8; controls break: naive 1.3".
std::string toText(const StabilityResult& result);

/// One line per sweep, such as "  gauss-8, float: 2.1e-05 of 0.0001 at tau = 3, blobs = 1".
std::string sweepsText(const StabilityResult& result);

/// One line per point: x, y, error. Comment lines describe the file.
std::string mapCsv(const StabilityResult& result, const StabilityMap& map, const std::string& origin);

/// File name without suffix, such as "R-01-float".
std::string fileStem(const StabilityResult& result, const StabilityMap& map);

} // namespace fx::cli
