/// @file emitter_solver.h
/// One emitter of one instance: births, motion, deaths.
#pragma once

#include "simulation/emitters/birth_schedule.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/emitters/emitter_motion.h"
#include "simulation/emitters/emitter_store.h"

namespace fx::sim {

/// Steps particles that do not feel each other. The set of particles and their birth ticks depend only on the
/// seed and on what the host asked for, never on how time is cut into steps.
class EmitterSolver final : public Solver
{
public:
    /// @param def outlives the solver
    /// @param kind of the groups it publishes
    EmitterSolver(const EmitterDef& def, base::KindId kind, std::pmr::memory_resource* memory);

    void step(const StepContext& context) override;
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override;
    bool finished(base::Ticks tick) const override;
    uint32_t elementCount() const override { return store_.count; }
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;

private:
    void giveBirth(const EmitterStep& step, std::span<Birth> births);
    void move(const EmitterStep& step, const EmitterScratch& scratch, uint32_t begin, uint32_t end);

    const EmitterDef& def_;
    base::KindId kind_;
    BirthSchedule schedule_;
    EmitterStore store_;
    base::Ticks now_ = 0; ///< end of the last step
    bool started_ = false;
};

} // namespace fx::sim
