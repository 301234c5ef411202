/// @file budget_check.h
/// Criteria of fx bench budget --check.
#pragma once

#include <string>

namespace fx::cli {

constexpr double kBudgetOver = 0.05;     ///< [1] share of frames over budget that the controller may have
constexpr double kBudgetSwitches = 0.03; ///< [1] share of frames that may change a setting

/// Result of one method of choosing quality.
struct BudgetShares
{
    double over = 0;     ///< [1] of the frames
    double switches = 0; ///< [1]
};
/// Fault of a run; empty if the controller keeps both bounds and neither fixed quality nor the naive
/// controller does.
std::string findBudgetFault(const BudgetShares& controller, const BudgetShares& fixed,
                            const BudgetShares& naive);

} // namespace fx::cli
