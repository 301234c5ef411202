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
    uint32_t part = 0;     ///< stage of the work on the group
    uint32_t row = 0;      ///< next row of the stage
    uint32_t count = 0;    ///< number of elements found or written so far
    bool isSorted = true;  ///< true: the elements found so far are sorted
    base::Bounds bounds{}; ///< bounds of the rows written so far
    float radius = 0;      ///< [m] largest radius so far
};

/// A solver that counts its own work, so that its steps can be divided. See Solver::budgeted().
class BudgetedSolver
{
public:
    /// Executes Solver::step() within a budget. Returns false if the budget is used up before the end of the
    /// step. The caller must then repeat the call with an equal context, before any other call except the
    /// destructor. The results have the same bits as a single step(). Scratch memory may be freed between the
    /// calls.
    virtual bool proceed(const StepContext& context, base::WorkBudget& work) = 0;

    /// Executes Solver::publish() within a budget. Returns false if the budget is used up before the end of
    /// the publication. The caller must then repeat the call before any other call of the solver, and before
    /// another group is added to `snapshot`. The results have the same bits as publish().
    /// @param ioPlace default-constructed for the first call; for further calls, the value from the previous
    ///         call
    virtual bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                    PublicationPlace& ioPlace, base::WorkBudget& work) const = 0;

protected:
    ~BudgetedSolver() = default;
};

/// Steps any solver within a budget. A solver without BudgetedSolver executes the whole step; one unit is
/// counted for each stepped particle and for each birth.
bool stepWithin(Solver& solver, const StepContext& context, base::WorkBudget& work);

/// Publishes any solver within a budget. A solver without BudgetedSolver publishes everything and uses no
/// budget.
bool publishWithin(Solver& solver, const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                   PublicationPlace& ioPlace, base::WorkBudget& work);

} // namespace fx::sim
