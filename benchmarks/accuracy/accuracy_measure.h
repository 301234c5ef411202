/// @file accuracy_measure.h
/// Runs the settings of a technique in turn, repeatedly, and collects times and errors.
#pragma once

#include "benchmarks/accuracy/accuracy_curve.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace fx::cli {

/// One curve to measure.
struct AccuracyTask
{
    const AccuracyTechniqueEntry* technique;
    std::string scene;
};

/// Lists the tasks of `technique`, or of all techniques for "all". If `scene` is not empty, only the tasks of
/// this scene are listed.
/// @return InvalidArgument for an unknown name; the message suggests the nearest known name
base::Result<std::vector<AccuracyTask>> accuracyTasks(const std::string& technique, const std::string& scene);

struct MeasureRules
{
    AccuracyScale scale;
    uint32_t repetitions = 7;
    /// true: instructions are counted with callgrind if the system cannot count them
    bool useCallgrind = false;
    std::function<bool()> stop;
    std::function<void(uint64_t done, uint64_t all)> progress;
};

base::Result<AccuracyCurve> measureAccuracy(const AccuracyTask& task, const MeasureRules& rules);

/// Runs the timed part of each setting once, for callgrind. @return false if the technique has no timed part
bool countWork(const AccuracyTask& task);

} // namespace fx::cli
