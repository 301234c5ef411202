/// @file emitter_solver.h
/// One emitter of one instance: births, motion, deaths.
#pragma once

#include "simulation/emitters/birth_schedule.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/look_kernel.h"
#include "simulation/particles/particle_store.h"

namespace fx::sim {

/// The kinds of groups that emitters publish; kNoKind where the schema lacks one.
struct EmitterKinds
{
    base::KindId blob;
    base::KindId particle;
};

/// Steps particles that do not feel each other. The set of particles, their birth ticks and their rows depend
/// only on the seed and on what the host asked for, never on how time is cut into steps.
class EmitterSolver final : public Solver
{
public:
    /// @param def outlives the solver
    EmitterSolver(const EmitterDef& def, const EmitterKinds& kinds, std::pmr::memory_resource* memory);

    void step(const StepContext& context) override;
    /// Spread over the threads of the last step; before it on the calling thread.
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override;
    bool finished(base::Ticks tick) const override;
    uint32_t elementCount() const override { return store_.countAlive(now_); }
    /// Where motion has a closed form; backwards while the host has changed nothing since local time 0.
    bool canSeek(const StepContext& context, base::Ticks tick) const override;
    void seek(const StepContext& context, base::Ticks tick) override;
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;

    uint32_t highWater() const { return highWater_; } ///< the most rows that were in use after a step
    uint64_t dropped() const { return dropped_; }     ///< births that found their row taken

private:
    void begin(const StepContext& context);
    struct Conditions
    {
        glm::vec3 pull{0.0f}; ///< [m/s2] see LookJob
        float intensity = 1.0f;
        bool emitting = true;
        bool operator==(const Conditions&) const = default;
    };
    Conditions conditionsOf(const StepContext& context) const;
    void heedConditions(const StepContext& context);
    void giveBirth(const StepContext& context, base::Ticks from, base::Ticks to);
    void storeBatch(const StepContext& context, std::span<const Birth> births);
    void move(const StepContext& context);
    bool neverDrops(double intensity) const;
    LookJob lookJob() const;
    void publishParticles(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    uint32_t sortLiving() const;
    void publishMedium(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;

    const EmitterDef& def_;
    EmitterKinds kinds_;
    std::shared_ptr<const ParticleProgram> shared_;
    const ParticleProgram& program_;
    BirthSchedule schedule_;
    ParticleStore store_;
    base::Ticks now_ = 0;         ///< end of the last step
    base::Ticks motionBegin_ = 0; ///< see LookJob
    Conditions conditions_;       ///< of the last step
    bool varied_ = false;         ///< they were others before
    bool started_ = false;
    uint32_t highWater_ = 0;
    uint64_t dropped_ = 0;
    base::TaskRunner* tasks_ = nullptr;              ///< of the last step
    mutable std::pmr::vector<uint32_t> rowsByBirth_; ///< room to sort what a medium publishes
};

} // namespace fx::sim
