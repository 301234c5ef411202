/// @file bench_budget.h
/// fx bench budget: real frames whose load jumps, under a budget, with the controller and without.
#pragma once

#include "fxsdk/cli/quality_stage.h"
#include "fxsdk/quality/quality_ladder.h"

#include <optional>
#include <string>

namespace fx::cli {

struct BenchBudgetArguments
{
    std::string size = "256x144"; ///< [pixel]
    std::string clock = "auto";   ///< gpu, wall, processor or auto
    std::string calibration;      ///< file of fx calibrate; empty: the built-in one
    double budget = 0;            ///< [ms] 0: 1.5 times a frame of the least load at full quality
    int frames = 120;             ///< of each section of equal load
    bool json = false;
    bool check = false; ///< fail when the controller misses its bounds, or when the load is no trial
};

/// Prints one line for each way to choose quality: the controller, fixed quality, and a naive controller.
/// All draw the same moments, in turn. @return exit code
int runBenchBudget(const BenchBudgetArguments& arguments);

} // namespace fx::cli
