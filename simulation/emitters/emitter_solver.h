/// @file emitter_solver.h
/// Solver of one emitter of one instance: births, motion, deaths.
#pragma once

#include "simulation/emitters/births/birth_schedule.h"
#include "simulation/emitters/births/moved_space.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/emitters/emitter_detail.h"
#include "simulation/emitters/events/event_scan.h"
#include "simulation/emitters/pools/emitter_pools.h"
#include "simulation/gpu_programs/gpu_emitter.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/particle_store.h"
#include "simulation/ribbons/ribbon_store.h"
#include "simulation/solver/budgeted_solver.h"
#include "simulation/solver/finite_memory_solver.h"
#include "simulation/solver/placed_contact.h"
#include "simulation/solver/seekable_solver.h"

#include <optional>

namespace fx::sim {

/// The kinds of groups that emitters publish; kNoKind for kinds that are not in the schema.
struct EmitterKinds
{
    base::KindId blob;
    base::KindId particle;
    base::KindId ribbon = base::kNoKind;
    base::KindId light = base::kNoKind;
    base::KindId gpuParticle = base::kNoKind;
    base::KindId material = base::kNoKind;
};

/// Steps particles that do not interact. The set of particles, their birth ticks and their rows depend only
/// on the seed and the host's calls, not on the division of time into steps.
class EmitterSolver final : public Solver,
                            public BudgetedSolver,
                            public SeekableSolver,
                            public FiniteMemorySolver,
                            public PooledEmitter
{
public:
    /// Creates a solver.
    /// @param def definition; must outlive the solver
    EmitterSolver(const EmitterDef& def, const EmitterKinds& kinds, std::pmr::memory_resource* memory);
    ~EmitterSolver() override
    {
        if (pool_)
            pool_->forget(member_);
    }

    void step(const StepContext& context) override
    {
        base::WorkBudget unlimited;
        goOn(context, unlimited);
    }
    /// Begins or continues a step within the work budget. Steps of small emitters are not divided.
    bool proceed(const StepContext& context, base::WorkBudget& work) override
    {
        const bool isKept = context.board || !isLinked(); // its data in scratch memory
        if (isDivided_ && isKept)
            return goOn(context, work);
        const StepCounters before = *context.counters;
        step(context);
        work.spend(workOf(context.counters->since(before)));
        return true;
    }
    void standAt(const base::Placement& placement) override
    {
        if (space_ && started_)
            space_->jumpTo(placement);
    }
    bool joinPool(EmitterPools& pools, const PoolRequest& request) override;
    void leavePool() override;
    base::Ticks quietUntil(base::Ticks tick) const override
    {
        return bornWithMany_ && started_ && !pool_ ? std::max(tick, schedule_.quietUntil()) : tick;
    }
    void passTo(base::Ticks tick, StepCounters& counters) override
    {
        leavePool();
        now_ = tick;
        endStep(counters);
    }
    /// Publishes the particles, on the threads of the last step; before the first step, on the calling
    /// thread.
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override
    {
        PublicationPlace whole;
        base::WorkBudget unlimited;
        proceedPublication(base, snapshot, whole, unlimited);
    }
    bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                            PublicationPlace& place, base::WorkBudget& work) const override;
    bool joinPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                         SpawnBatch& spawnBatch) const override;
    bool finished(base::Ticks tick) const override;
    /// Number of living particles; an upper bound while the GPU computes the particles.
    uint32_t elementCount() const override;
    bool hasElements() const override;
    /// True if seek() can reach `tick`. Seeks forwards are possible if motion has a closed form. Seeks
    /// backwards also require that the host has changed no input since local time 0. Without particles and
    /// births, every emitter can seek.
    bool canSeek(const StepContext& context, base::Ticks tick) const override;
    void seek(const StepContext& context, base::Ticks tick) override;
    /// End of the time without visible changes: if there are no particles, the time of the next birth.
    /// Particles of another emitter can cause births only after the end of restsUntil() of that emitter.
    base::Ticks restsUntil(base::Ticks tick) const override;
    void save(StateWriter& writer) const override;
    void restore(StateReader& reader) override;
    /// Time after which no present particle is alive. The time is known if particles do not depend on other
    /// particles, and if no birth is dropped.
    base::Ticks influenceHorizon(const InstanceParameters& parameters) const override;
    void saveWithoutElements(StateWriter& writer) const override { saveState(writer, false); }
    void passOver(const StepContext& context, base::Ticks tick) override;

    BudgetedSolver* budgeted() override { return this; }
    SeekableSolver* seekable() override { return this; }
    FiniteMemorySolver* finiteMemory() override { return this; }
    PooledEmitter* pooledEmitter() override { return this; }

    /// Steps of emitters with at most this number of rows are not divided.
    static constexpr uint32_t kFewRows = 8192;

    const EmitterPool* pool() const override { return pool_; }
    uint32_t member() const override { return member_; }
    ParticleStore& store() override { return store_; }
    const ParticleProgram& program() const override { return program_; }
    uint32_t highWater() const override { return highWater_; }
    uint64_t dropped() const override { return dropped_; }
    void takeBack(base::Ticks now, uint32_t highWater, uint64_t dropped) override;
    void refuse(uint64_t births, StepCounters& counters) override
    {
        counters.dropped += births;
        dropped_ += births;
    }
    void endStep(StepCounters& counters) override
    {
        store_.retire(now_);
        const uint32_t rows = store_.rowsInUse();
        counters.particleSteps += rows;
        highWater_ = std::max(highWater_, rows);
    }

    /// [byte] memory that a solver allocates when it is created.
    static uint64_t bytesOf(const EmitterDef& def, const ParticleProgram& program);

private:
    /// [unit of base::WorkBudget] Work of a step that is not divided.
    uint64_t workOf(const StepCounters& done) const
    {
        return uint64_t(emitter_work::kBirth * double(done.born - done.dropped) +
                        emitter_work::kEvent * double(done.events) + stepWork_ * double(done.particleSteps)) +
               1;
    }
    EmitterSolver(const EmitterDef& def, const EmitterKinds& kinds,
                  std::shared_ptr<const ParticleProgram> program, std::pmr::memory_resource* memory);
    /// Stages of a step that is divided.
    enum class StepPart : uint8_t
    {
        Old, ///< moves existing particles and collects their events
        Births,
        Young,  ///< moves the new particles
        Move,   ///< moves all particles, without events
        Answer, ///< processes events that cause births in other emitters
        Follow, ///< updates trails
    };
    struct Linked;
    struct OpenStep
    {
        base::Ticks tick = -1;   ///< local time at which the open step begins; -1: no step is open
        base::Ticks reached = 0; ///< local time before which all births are done
        StepPart part = StepPart::Old;
        bool isWanted =
            false; ///< true: the GPU should compute the particles if possible, see StepContext::gpuParticles
        uint32_t row = 0;     ///< next row to be processed by the stage
        uint64_t left = 0;    ///< number of births that may still be stored
        uint64_t asked = 0;   ///< attempted births
        uint64_t refused = 0; ///< number of births whose row was occupied
        uint64_t droppedBefore = 0;
        Linked* linked = nullptr; ///< data of emitters with events, in scratch memory
        uint64_t board = 0;       ///< number of the EventBoard of the step that allocated `linked`
    };
    bool isOpen(const StepContext& context) const;
    void begin(const StepContext& context);
    bool goOn(const StepContext& context, base::WorkBudget& work);
    bool goOnHere(const StepContext& context, base::WorkBudget& work);
    void openStep(const StepContext& context);
    void closeStep(const StepContext& context);
    bool stepAlone(const StepContext& context, base::WorkBudget& work);
    bool joins(const StepContext& context) const;
    bool isPoolable() const;
    /// Copies the state from the pool, which may be ahead of the copy in this object.
    void catchUpWithPool() const
    {
        if (pool_)
            pool_->write(member_);
    }
    struct Conditions
    {
        glm::vec3 pull{0.0f}; ///< [m/s2] see AppearanceJob
        float intensity = 1.0f;
        bool emitting = true;
        bool operator==(const Conditions&) const = default;
    };
    Conditions conditionsOf(const StepContext& context) const;
    void applyConditions(const StepContext& context);
    /// True if there are no particles, and no births up to `tick`.
    bool restsThrough(const StepContext& context, base::Ticks tick) const;
    void seekHere(const StepContext& context, base::Ticks tick);
    base::Ticks lifetimeOf(double intensity) const;
    void saveState(StateWriter& writer, bool withRows) const;
    std::span<Birth> birthRoom(const StepContext& context) const;
    void noteRefusals();
    void forgetRefusals()
    {
        refusedInRow_ = 0;
        fullUntil_ = 0;
    }
    void openBirths(base::Ticks from);
    bool giveBirth(const StepContext& context, base::Ticks to, std::span<Birth> room, base::WorkBudget& work);
    void storeBatch(const StepContext& context, std::span<const Birth> births);
    bool move(const StepContext& context, base::WorkBudget& work, uint64_t firstIndex = 0,
              EventRoom* room = nullptr);
    // if the GPU may compute the particles
    void offerToGpu(uint64_t droppedBefore, bool isWanted);
    void stepOnGpu(const StepContext& context);
    bool mayDieSooner() const;
    void leaveGpu();
    void listenAgain();
    void saveFromGpu(StateWriter& writer) const;
    // for emitters with events
    struct Origin
    {
        glm::vec3 position{0.0f}; ///< [m] offset that is added to the position from the birth shape
        glm::vec3 velocity{0.0f}; ///< [m/s] velocity of the origin
        glm::vec3 tint{1.0f};     ///< [1] factor on the color
        bool fed = false;         ///< true: an event of a particle caused the birth
        bool byClock = true;
    };
    // for particles that stay in world space
    template <class F>
    auto inHome(const StepContext& context, F&& body) const
    {
        StepContext home = context;
        std::optional<Collider> collider;
        std::optional<PlacedContact> contact;
        toHome(home, collider);
        if (home.contactHook) {
            const auto& asked = *static_cast<const PlacedContact*>(home.contactHook->user);
            home.contactHook = &contact.emplace(asked.host(), space_->home(), asked.faults()).hook();
        }
        return body(home);
    }
    void toHome(StepContext& context, std::optional<Collider>& collider) const;
    void carryBirths(const StepContext& context, std::span<const Birth> births);
    void carryBirth(const StepContext& context, const Birth& birth, uint32_t row, bool byClock);
    bool isLinked() const { return def_.fed || !def_.events.empty(); }
    bool stepWithEvents(const StepContext& context, base::WorkBudget& work);
    void openLinked(const StepContext& context);
    bool scanOld(const StepContext& context, base::WorkBudget& work);
    bool giveLinkedBirth(const StepContext& context, base::WorkBudget& work);
    size_t nextBatch(std::span<Birth> births, std::span<Origin> origins);
    std::span<Birth> scheduledBirths(const StepContext& context);
    void storeLinked(const StepContext& context, std::span<const Birth> births,
                     std::span<const Origin> origins, EventList& out);
    bool answerEvents(const StepContext& context, base::WorkBudget& work);
    void answerList(const StepContext& context, const EventList& list);
    void hearHost(const StepContext& context, EventList& out);
    EventScan scanOf(const StepContext& context) const;
    bool neverDrops(double intensity) const;
    AppearanceJob appearanceJob() const;
    void fill(AppearanceJob& job) const
    {
        job.program = &program_;
        job.store = &store_;
        job.rows = store_.window();
        job.now = now_;
        job.motionBegin = motionBegin_;
        job.pull = conditions_.pull;
    }
    bool publishGroup(const base::GroupInfo& base, base::FrameSnapshot& snapshot, PublicationPlace& place,
                      base::WorkBudget& work) const;
    bool publishParticles(const base::GroupInfo& base, base::FrameSnapshot& snapshot, PublicationPlace& place,
                          base::WorkBudget& work) const;
    bool publishTrails(const base::GroupInfo& base, base::FrameSnapshot& snapshot, PublicationPlace& place,
                       base::WorkBudget& work) const;
    bool publishLights(const base::GroupInfo& base, base::FrameSnapshot& snapshot, PublicationPlace& place,
                       base::WorkBudget& work) const;
    struct Light
    {
        glm::vec3 position{0.0f};
        glm::vec3 intensity{0.0f}; ///< [cd]
        uint32_t row = 0;
        float sum = 0; ///< sum by which the lights to publish are selected
    };
    Light lightOf(uint32_t row, uint32_t i, const MotionTile& motion) const;
    bool findLights(PublicationPlace& place, base::WorkBudget& work) const;
    bool sortLiving(PublicationPlace& place, base::WorkBudget& work) const;
    void collectLiving(PublicationPlace& place, base::WorkBudget& work) const;
    bool publishMedium(const base::GroupInfo& base, base::FrameSnapshot& snapshot, PublicationPlace& place,
                       base::WorkBudget& work) const;
    bool hasMaterial() const { return detail_ && kinds_.material != base::kNoKind; }
    void writeMaterial(uint32_t begin, uint32_t end, const base::SnapshotGroup& blobs,
                       base::SnapshotGroup& material) const;
    void writeMedium(uint32_t solver, uint32_t begin, uint32_t end, class BlobWriter& writer) const;

    // Members that every step and publication of a small emitter uses, adjacent for the cache.
    const EmitterDef& def_;
    const ParticleProgram& program_;
    base::Ticks now_ = 0;         ///< local time at which the last step ended
    base::Ticks motionBegin_ = 0; ///< see AppearanceJob
    Conditions conditions_;       ///< conditions of the last step
    uint32_t highWater_ = 0;
    bool varied_ = false; ///< true: conditions have changed since the start
    bool started_ = false;
    bool bornWithMany_;      ///< see SpawnBatch
    bool publishesWithMany_; ///< see SpawnBatch
    bool poolable_;
    uint32_t member_ = 0;         ///< number in the pool
    EmitterPool* pool_ = nullptr; ///< pool that computes this emitter; the members below may then be outdated
    EmitterKinds kinds_;
    ParticleStore store_;
    BirthSchedule schedule_;
    std::shared_ptr<const ParticleProgram> shared_;
    EventInterest interest_;
    std::optional<RibbonStore> trails_;
    std::optional<EmitterDetail> detail_; ///< present if the medium has detail of the field
    /// present if the world position of particles does not change with the placement of the instance
    std::optional<MovedSpace> space_;
    std::optional<GpuEmitter> gpu_;          ///< present if the GPU can compute the particles
    BirthKey key_{};                         ///< random key of the last step
    mutable std::pmr::vector<Light> lights_; ///< scratch for the published lights
    uint64_t hostEvents_ = 0;                ///< number of processed host events
    uint64_t dropped_ = 0;
    base::TaskRunner* tasks_ = nullptr;              ///< task runner of the last step
    mutable std::pmr::vector<uint32_t> rowsByBirth_; ///< scratch to sort the published rows of a medium
    OpenStep open_;
    bool isDivided_;            ///< true: steps are divided, see proceed()
    uint64_t refusedInRow_ = 0; ///< number of consecutive births whose row was occupied
    base::Ticks fullUntil_ = 0; ///< local time up to which all rows are certainly occupied
    double stepWork_;           ///< [unit of base::WorkBudget] work of a particle in a sub-step
};

} // namespace fx::sim
