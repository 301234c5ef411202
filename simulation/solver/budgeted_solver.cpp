#include "simulation/solver/budgeted_solver.h"

namespace fx::sim {

bool stepWithin(Solver& solver, const StepContext& context, base::WorkBudget& work)
{
    if (BudgetedSolver* const budgeted = solver.budgeted())
        return budgeted->proceed(context, work);
    const StepCounters before = *context.counters;
    solver.step(context);
    const StepCounters done = context.counters->since(before);
    work.spend(done.particleSteps + done.born);
    return true;
}

bool publishWithin(Solver& solver, const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                   PublicationPlace& ioPlace, base::WorkBudget& work)
{
    if (const BudgetedSolver* const budgeted = solver.budgeted())
        return budgeted->proceedPublication(base, snapshot, ioPlace, work);
    solver.publish(base, snapshot);
    work.spend(0);
    return true;
}

} // namespace fx::sim
