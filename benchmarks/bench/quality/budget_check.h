/// @file budget_check.h
/// Criteria of fx bench budget --check.
#pragma once

#include <string>

namespace fx::cli {

constexpr double kBudgetOver = 0.05;     ///< [1] largest share of frames over budget for the controller
constexpr double kBudgetSwitches = 0.03; ///< [1] largest share of frames that change a setting

/// Result of one method of choosing quality.
struct BudgetShares
{
    double over = 0;     ///< [1] share of frames over budget
    double switches = 0; ///< [1]
};
/// Fault of a run as text; empty if the controller keeps both bounds, and neither fixed quality nor the naive
/// controller keeps them.
std::string findBudgetFault(const BudgetShares& controller, const BudgetShares& fixed,
                            const BudgetShares& naive);

} // namespace fx::cli
