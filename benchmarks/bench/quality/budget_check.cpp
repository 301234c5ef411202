#include "benchmarks/bench/quality/budget_check.h"

#include <cstdio>

namespace fx::cli {

std::string findBudgetFault(const BudgetShares& controller, const BudgetShares& fixed,
                            const BudgetShares& naive)
{
    const auto keeps = [](const BudgetShares& shares) {
        return shares.over <= kBudgetOver && shares.switches <= kBudgetSwitches;
    };
    char text[200];
    if (!keeps(controller)) {
        std::snprintf(text, sizeof text,
                      "the controller is over budget in %.2f %% of the frames and changes settings in %.2f "
                      "%%; allowed are %g and %g",
                      100.0 * controller.over, 100.0 * controller.switches, 100.0 * kBudgetOver,
                      100.0 * kBudgetSwitches);
        return text;
    }
    if (keeps(fixed))
        return "fixed quality keeps the budget, too: the load is no trial; give a smaller --budget";
    if (keeps(naive))
        return "the naive controller keeps both bounds, too: the load is no trial";
    return {};
}

} // namespace fx::cli
