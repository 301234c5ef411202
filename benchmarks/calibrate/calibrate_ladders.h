/// @file calibrate_ladders.h
/// Measures the ladders of quality on this machine: every setting of a technique on frames of several
/// presets.
#pragma once

#include "benchmarks/accuracy/accuracy_curve.h"
#include "benchmarks/scenes/quality_stage.h"
#include "fxsdk/quality/quality_ladder.h"

#include <functional>
#include <optional>
#include <vector>

namespace fx::cli {

struct CalibrateRules
{
    int width = 320, height = 180; ///< [pixel]
    uint32_t repetitions = 7;
    std::optional<StageClock> clock; ///< nothing: the best of the machine
    std::function<bool()> stop;
    std::function<void(uint64_t done, uint64_t all)> progress;
};

/// The measured settings of one technique and those of them that are worth having.
struct MeasuredLadder
{
    AccuracyCurve curve; ///< the first point is the best setting
    quality::Ladder ladder;
};

struct MeasuredCalibration
{
    std::vector<MeasuredLadder> ladders;
    StageClock clock;
    std::string renderer; ///< as the driver names itself
};

base::Result<MeasuredCalibration> measureLadders(const CalibrateRules& rules);

/// The front of a curve as a ladder: from the baseline downwards, each step at least a tenth cheaper than the
/// one above it and more wrong, at most quality::kMostSteps.
quality::Ladder ladderOf(const AccuracyCurve& curve, const std::vector<quality::Knobs>& knobs);

} // namespace fx::cli
