/// @file accuracy_measure.h
/// Runs the settings of a technique in turn, again and again, and collects what they cost.
#pragma once

#include "benchmarks/accuracy/accuracy_curve.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace fx::cli {

/// One curve to be measured.
struct AccuracyTask
{
    const AccuracyTechniqueEntry* technique;
    std::string scene;
};

/// What `technique`, or "all", and `scene`, or nothing, name.
/// @return InvalidArgument with the nearest known name
base::Result<std::vector<AccuracyTask>> accuracyTasks(const std::string& technique, const std::string& scene);

struct MeasureRules
{
    AccuracyScale scale;
    uint32_t repetitions = 7;
    bool useCallgrind = false; ///< where the system itself does not count
    std::function<bool()> stop;
    std::function<void(uint64_t done, uint64_t all)> progress;
};

base::Result<AccuracyCurve> measureAccuracy(const AccuracyTask& task, const MeasureRules& rules);

/// For callgrind, which looks on: the timed part of each setting once. @return false when there is none
bool countWork(const AccuracyTask& task);

} // namespace fx::cli
