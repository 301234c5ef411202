/// @file emitter_solver.h
/// One emitter of one instance: births, motion, deaths.
#pragma once

#include "simulation/emitters/birth_schedule.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/emitters/event_scan.h"
#include "simulation/emitters/gpu_emitter.h"
#include "simulation/emitters/ribbon_store.h"
#include "simulation/particles/look_kernel.h"
#include "simulation/particles/particle_store.h"

#include <optional>

namespace fx::sim {

/// The kinds of groups that emitters publish; kNoKind where the schema lacks one.
struct EmitterKinds
{
    base::KindId blob;
    base::KindId particle;
    base::KindId ribbon = base::kNoKind;
    base::KindId light = base::kNoKind;
    base::KindId gpuParticle = base::kNoKind;
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
    /// Exact but while the GPU computes the particles; then an upper bound.
    uint32_t elementCount() const override;
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
    void move(const StepContext& context, uint64_t firstIndex = 0, EventRoom* room = nullptr);
    // where the GPU may compute
    void offerToGpu(uint64_t droppedBefore, bool isWanted);
    void stepOnGpu(const StepContext& context);
    void leaveGpu();
    void listenAgain();
    void saveFromGpu(StateWriter& writer) const;
    // where there are events
    struct Origin
    {
        glm::vec3 position{0.0f}; ///< [m] added to where the birth's own shape puts it
        glm::vec3 velocity{0.0f}; ///< [m/s] likewise
        bool fed = false;         ///< an event gave birth to it
    };
    bool isLinked() const { return def_.fed || !def_.events.empty(); }
    void stepWithEvents(const StepContext& context);
    void giveLinkedBirth(const StepContext& context, EventList& out);
    std::span<Birth> scheduledBirths(const StepContext& context);
    void storeLinked(const StepContext& context, std::span<const Birth> births,
                     std::span<const Origin> origins, EventList& out);
    void answerEvents(const StepContext& context, std::span<const EventList> lists, const EventList& more);
    void hearHost(const StepContext& context, EventList& out);
    EventScan scanOf(const StepContext& context) const;
    bool neverDrops(double intensity) const;
    LookJob lookJob() const;
    void publishParticles(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    void publishTrails(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    void publishLights(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;
    struct Light
    {
        glm::vec3 position{0.0f};
        glm::vec3 intensity{0.0f}; ///< [cd]
        uint32_t row = 0;
        float sum = 0; ///< what decides which are kept
    };
    Light lightOf(uint32_t row, uint32_t i, const MotionTile& motion) const;
    uint32_t findLights() const;
    uint32_t sortLiving() const;
    void publishMedium(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const;

    const EmitterDef& def_;
    EmitterKinds kinds_;
    std::shared_ptr<const ParticleProgram> shared_;
    const ParticleProgram& program_;
    BirthSchedule schedule_;
    ParticleStore store_;
    EventInterest interest_;
    std::optional<RibbonStore> trails_;
    std::optional<GpuEmitter> gpu_;          ///< where the GPU could compute the particles
    BirthKey key_{};                         ///< of the last step
    mutable std::pmr::vector<Light> lights_; ///< room for those that are published
    uint64_t hostEvents_ = 0;                ///< so many have been answered
    base::Ticks now_ = 0;                    ///< end of the last step
    base::Ticks motionBegin_ = 0;            ///< see LookJob
    Conditions conditions_;                  ///< of the last step
    bool varied_ = false;                    ///< they were others before
    bool started_ = false;
    uint32_t highWater_ = 0;
    uint64_t dropped_ = 0;
    base::TaskRunner* tasks_ = nullptr;              ///< of the last step
    mutable std::pmr::vector<uint32_t> rowsByBirth_; ///< room to sort what a medium publishes
};

} // namespace fx::sim
