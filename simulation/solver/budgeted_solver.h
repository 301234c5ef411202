/// @file budgeted_solver.h
/// Interface of solvers whose steps and publications are divided into several calls by a work budget.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/tasks/work_budget.h"
#include "simulation/solver/solver.h"

#include <cstdint>

namespace fx::sim {

/// Progress of the publication of one solver. The meaning of the members is private to the solver.
struct PublicationPlace
{
    uint32_t group = 0;    ///< index among the groups of the solver
    uint32_t part = 0;     ///< stage of the work on that group
    uint32_t row = 0;      ///< next row of that stage
    uint32_t count = 0;    ///< number of elements found or written so far
    bool isSorted = true;  ///< whether these elements are sorted
    base::Bounds bounds{}; ///< bounds of the rows written so far
    float radius = 0;      ///< [m] largest radius so far
};

/// A solver that counts its work itself, so that its steps can be divided. See Solver::budgeted().
class BudgetedSolver
{
public:
    /// Solver::step() within a budget. Returns false if the budget is used up before the end of the step.
    /// Then the call must be repeated with an equal context before any other call except the destructor. The
    /// results have the bits of a single step(). Scratch memory may be freed between the calls.
    virtual bool proceed(const StepContext& context, base::WorkBudget& work) = 0;

    /// Solver::publish() within a budget. Returns false if the budget is used up before the end. Then the
    /// call must be repeated before any other call of the solver, and before another group is added to
    /// `snapshot`. The results have the bits of publish().
    /// @param ioPlace default for the first call; then unchanged from the previous call
    virtual bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                    PublicationPlace& ioPlace, base::WorkBudget& work) const = 0;

protected:
    ~BudgetedSolver() = default;
};

/// BudgetedSolver::proceed() for any solver. A solver that is not budgeted takes the whole step, which counts
/// one unit for each particle that is stepped and for each birth.
bool stepWithin(Solver& solver, const StepContext& context, base::WorkBudget& work);

/// BudgetedSolver::proceedPublication() for any solver. A solver that is not budgeted publishes everything,
/// at no cost.
bool publishWithin(Solver& solver, const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                   PublicationPlace& ioPlace, base::WorkBudget& work);

} // namespace fx::sim
