/// @file calibrate_levels.h
/// Measures the scalability levels on this machine: every setting of a technique, on frames of several
/// presets.
#pragma once

#include "benchmarks/accuracy/accuracy_curve.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/quality/scalability_levels.h"

#include <functional>
#include <optional>
#include <vector>

namespace fx::cli {

struct CalibrateRules
{
    int width = 320, height = 180; ///< [pixel]
    uint32_t repetitions = 7;
    std::string technique;           ///< empty: all techniques
    std::optional<StageClock> clock; ///< clock for the times of frames; empty: the best clock of the machine
    std::function<bool()> stop;
    std::function<void(uint64_t done, uint64_t all)> progress;
};

/// All measured settings of one technique, and the levels selected from them.
struct MeasuredLevels
{
    AccuracyCurve curve; ///< the first point is the best setting
    quality::ScalabilityLevels levels;
};

struct MeasuredCalibration
{
    std::vector<MeasuredLevels> techniqueLevels;
    StageClock clock;
    std::string renderer; ///< name of the renderer as the driver reports it
};

base::Result<MeasuredCalibration> measureLevels(const CalibrateRules& rules);

/// Selects scalability levels from the front of a curve, from the baseline downwards. Each level is at least
/// a tenth cheaper than the next higher level and has a larger error. There are at most quality::kMaxSteps
/// levels.
quality::ScalabilityLevels scalabilityLevelsOf(const AccuracyCurve& curve,
                                               const std::vector<quality::Knobs>& knobs);

} // namespace fx::cli
