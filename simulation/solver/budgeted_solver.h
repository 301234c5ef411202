/// @file budgeted_solver.h
/// Steps and publications that a budget of work divides into several calls.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/tasks/work_budget.h"
#include "simulation/solver/solver.h"

#include <cstdint>

namespace fx::sim {

/// Progress of the publication of one solver, with a meaning that is private to the solver.
struct PublicationPlace
{
    uint32_t group = 0;    ///< index among its groups
    uint32_t part = 0;     ///< of the way to that group
    uint32_t row = 0;      ///< of that part
    uint32_t count = 0;    ///< elements that are found or written
    bool isSorted = true;  ///< they are in their order
    base::Bounds bounds{}; ///< of the rows written so far
    float radius = 0;      ///< [m] largest one so far
};

/// A solver that counts its work itself. See Solver::budgeted().
class BudgetedSolver
{
public:
    /// Solver::step() within a budget: returns false if the budget is used up before the end of the step.
    /// Then the call must be repeated with an equal context before any other call except the destructor; the
    /// bits are those of one step(). Scratch memory may be freed between the calls.
    virtual bool proceed(const StepContext& context, base::WorkBudget& work) = 0;

    /// Solver::publish() within a budget: returns false if the budget is used up before the end. Then the
    /// call must be repeated before any other call of the solver, and before another group is added to
    /// `snapshot`; the bits are those of publish().
    /// @param ioPlace default for the first call; then unchanged from the previous call
    virtual bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                    PublicationPlace& ioPlace, base::WorkBudget& work) const = 0;

protected:
    ~BudgetedSolver() = default;
};

/// BudgetedSolver::proceed() of any solver: one that is not budgeted takes the whole step, which counts a
/// unit for each particle that is stepped and for each that is born.
bool stepWithin(Solver& solver, const StepContext& context, base::WorkBudget& work);

/// BudgetedSolver::proceedPublication() of any solver: one that is not budgeted publishes everything, which
/// counts nothing.
bool publishWithin(Solver& solver, const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                   PublicationPlace& ioPlace, base::WorkBudget& work);

} // namespace fx::sim
