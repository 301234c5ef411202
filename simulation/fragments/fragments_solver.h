/// @file fragments_solver.h
/// Solver of the fragments of one instance and their smoke.
#pragma once

#include "simulation/fragments/fragment_store.h"
#include "simulation/fragments/fragments_def.h"
#include "simulation/fragments/trail_smoke.h"
#include "simulation/fragments/trail_store.h"
#include "simulation/solver/budgeted_solver.h"

namespace fx::sim {

/// Steps ballistic fragments that do not interact. The state of fragments and smoke depends only on the seed
/// and the host's calls.
class FragmentsSolver final : public Solver, public BudgetedSolver
{
public:
    /// Creates a solver.
    /// @param def definition; must outlive the solver
    /// @param kind kind of the two groups of the solver: the fragments, then the smoke
    FragmentsSolver(const FragmentsDef& def, base::KindId kind, std::pmr::memory_resource* memory);

    void step(const StepContext& context) override
    {
        base::WorkBudget unlimited;
        proceed(context, unlimited);
    }
    bool proceed(const StepContext& context, base::WorkBudget& work) override;
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        PublicationPlace whole;
        base::WorkBudget unlimited;
        proceedPublication(base, snapshot, whole, unlimited);
    }
    bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                            PublicationPlace& place, base::WorkBudget& work) const override;
    bool finished(base::Ticks tick) const override;
    uint32_t elementCount() const override { return fragments_.count + trail_.count; }
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;
    BudgetedSolver* budgeted() override { return this; }

private:
    /// State of a step that is not finished.
    struct OpenStep
    {
        base::Ticks tick = -1; ///< local time at which the open step begins; -1: no step is open
        /// true: the fragments are at the end of the step, and smoke remains to be emitted
        bool hasFlown = false;
        uint32_t row = 0; ///< next row of smoke to move or to emit
    };
    bool moveAll(const TrailStep& step, base::WorkBudget& work);
    bool leaveAll(const TrailStep& step, base::Ticks begin, base::WorkBudget& work);
    void leaveRows(const TrailStep& step, base::Ticks begin, uint32_t first, uint32_t last);
    void release(const StepContext& context);
    void fly(const TrailStep& step, base::Ticks begin);
    void makeRoom(const StepContext& context);
    void publishFragments(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    void openTrail(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    void writeTrail(uint32_t solver, uint32_t begin, uint32_t end, class BlobWriter& writer) const;

    const FragmentsDef& def_;
    base::KindId kind_;
    base::Ticks start_;
    FragmentStore fragments_;
    TrailStore trail_;
    base::Column<FragmentWay> ways_; ///< paths of the fragments in the open step
    OpenStep open_;
    base::Ticks now_ = 0; ///< local time at which the last step ended
    bool released_ = false;
};

} // namespace fx::sim
