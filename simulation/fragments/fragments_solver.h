/// @file fragments_solver.h
/// The fragments of one instance and their smoke.
#pragma once

#include "simulation/fragments/fragment_store.h"
#include "simulation/fragments/fragments_def.h"
#include "simulation/fragments/trail_smoke.h"
#include "simulation/fragments/trail_store.h"

namespace fx::sim {

/// Steps ballistic fragments that do not feel each other. What is released, and which blob of smoke is left
/// where, depends only on the seed and on what the host asked for.
class FragmentsSolver final : public Solver
{
public:
    /// @param def outlives the solver
    /// @param kind of the groups it publishes: first the fragments, then their smoke
    FragmentsSolver(const FragmentsDef& def, base::KindId kind, std::pmr::memory_resource* memory);

    void step(const StepContext& context) override;
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override;
    bool finished(base::Ticks tick) const override;
    uint32_t elementCount() const override { return fragments_.count + trail_.count; }
    uint64_t workOf(const StepCounters& done) const override;
    uint64_t shownWork() const override { return uint64_t(fragment_work::kShown * double(elementCount())); }
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;

private:
    void release(const StepContext& context);
    void fly(const TrailStep& step, base::Ticks begin, std::span<FragmentWay> ways);
    void makeRoom(const StepContext& context, std::span<FragmentWay> ways);
    void publishFragments(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    void publishTrail(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;

    const FragmentsDef& def_;
    base::KindId kind_;
    base::Ticks start_;
    FragmentStore fragments_;
    TrailStore trail_;
    base::Ticks now_ = 0; ///< end of the last step
    bool released_ = false;
};

} // namespace fx::sim
