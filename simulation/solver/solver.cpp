#include "simulation/solver/solver.h"

namespace fx::sim {

bool Solver::proceed(const StepContext& context, base::WorkBudget& work)
{
    const StepCounters before = *context.counters;
    step(context);
    work.spend(workOf(context.counters->since(before)));
    return true;
}

} // namespace fx::sim
