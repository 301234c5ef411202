/// @file budget_check.h
/// Criteria of fx bench budget --check.
#pragma once

#include <string>

namespace fx::cli {

constexpr double kBudgetOver = 0.05;     ///< [1] largest fraction of frames over budget with the controller
constexpr double kBudgetSwitches = 0.03; ///< [1] largest fraction of frames that change a setting

/// Result of one method of choosing quality.
struct BudgetShares
{
    double over = 0;     ///< [1] fraction of frames over budget
    double switches = 0; ///< [1] fraction of frames that change a setting
};
/// Fault of a run as text; empty without a fault. The controller must keep both bounds. Fixed quality and the
/// naive controller must violate a bound.
std::string findBudgetFault(const BudgetShares& controller, const BudgetShares& fixed,
                            const BudgetShares& naive);

} // namespace fx::cli
