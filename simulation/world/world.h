/// @file world.h
/// Stores all existing instances and steps the instances in a given list.
///
/// Instances with equal results are simulated once. Results are equal if effect, seed, start, quality,
/// intensity, emission, and gravity and wind in local space are equal. If the instances collide with the
/// host's geometry, their placements must also be equal. Each instance is published at its own placement.
/// Sharing never changes results, because the state is copied before one of the instances is changed.
///
/// A simulation is paused while all of its instances are hidden. A paused simulation has no cost until
/// catchUp() advances it to the present. Pending changes are applied at the time at which the host made them.
///
/// Threads: one thread at a time (the scene thread). The work of a step is distributed to the threads of the
/// task runner.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/arena.h"
#include "simulation/emitters/events/event_board.h"
#include "simulation/emitters/pools/emitter_pools.h"
#include "simulation/emitters/pools/spawn_batch.h"
#include "simulation/solver/effect_def.h"
#include "simulation/world/cue_record.h"
#include "simulation/world/simulation_pool.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

namespace fx::sim {

/// Initial values of an instance.
struct InstanceStart
{
    uint64_t instance = 0; ///< identity, unique while the instance exists
    uint64_t seed = 0;
    base::Ticks startTick = 0; ///< scene time of local tick 0
    base::Placement placement;
    InstanceParameters parameters;
    QualityLevel quality = QualityLevel::Medium; ///< never changes
    uint32_t rate = kNormalRate;                 ///< initial rate of the clock, see InstanceClock
    /// Clock of the instance, if the host has changed its time. Without a value, `startTick` and `rate`
    /// define the clock.
    std::optional<InstanceClock> clock{};
};

/// Conditions shared by all instances of a world.
struct Environment
{
    glm::vec3 gravity{0.0f, -9.80665f, 0.0f}; ///< [m/s2] gravity in world space
    bool hasGround = true; ///< true: presets may have a ground; false: no effect has a ground
    std::shared_ptr<const DistanceField> field{}; ///< geometry of the host; null: no geometry
};

/// Index of an instance inside the world, valid until the instance is removed.
using Slot = uint32_t;

class World
{
public:
    /// Creates an empty world.
    /// @param share false: every instance has its own simulation
    World(const base::SnapshotSchema* schema, base::TaskRunner* tasks, std::pmr::memory_resource* memory,
          const Environment& environment = {}, bool share = true);

    /// Adds an instance and creates all solvers of `effect`. Strong guarantee.
    /// @param hidden true: the instance starts hidden, and its solvers are created when it becomes visible
    Slot add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start, bool hidden = false);
    void remove(Slot slot);
    /// Removes an instance at the end of its life, and moves its solvers to the free list.
    void recycle(Slot slot);

    /// Keeps the memory of `count` simulations of an effect, see SimulationPool::reserve(). Strong guarantee.
    /// @return number of sets of solvers that were created
    uint32_t reserve(const std::shared_ptr<const EffectDef>& effect, QualityLevel level, uint32_t count);
    /// Lowers the count of a reservation. Never fails.
    void shrinkReservation(const EffectDef& effect, QualityLevel level, uint32_t count) noexcept
    {
        simulations_.shrinkReservation(effect, level, count);
    }
    /// Reserves memory for all lists, so that swap(other) keeps the room of the reservations of this world.
    void reserveSwap(World& other);
    const SimulationPool& reservations() const { return simulations_; } ///< for queries of reservations
    /// Plays a reserved simulation that nobody sees, within a small budget, so that the scratch memory of
    /// steps has the size that the effect needs. Changes no result. Must not be called while a step is open.
    void rehearse(const std::shared_ptr<const EffectDef>& effect, QualityLevel level);

    // ---- hidden instances; step() and publish() must not get hidden slots ----
    void hide(Slot slot);
    void show(Slot slot); ///< makes a hidden instance visible, after catchUp() has returned true
    bool isHidden(Slot slot) const { return instances_[slot].hidden; }
    /// True if the state of the instance lags behind the present.
    bool lags(Slot slot) const;
    base::Ticks simulated(Slot slot) const
    {
        const SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
        return simulation.pooled ? pools_.now() : simulation.simulated;
    }
    /// True if the simulation has many pending changes. The caller should then call catchUp() to apply the
    /// changes.
    bool hasManyChanges(Slot slot) const;
    /// Advances a hidden instance towards the present by `policy`. If there is a prewarm, it is simulated
    /// first. Strong guarantee for each step.
    /// @param ioBudget [1] number of particle steps that are allowed. The cost of a step is its number of
    ///         particles plus one. The last step may exceed the budget
    /// @param work additional limit of the call. The limit may interrupt a step; the next call then continues
    ///         the step
    /// @return true if the instance is at the present, or finished
    bool catchUp(Slot slot, CatchUp policy, base::Ticks stepTicks, uint64_t& ioBudget, StepCounters& counters,
                 base::WorkBudget& work);
    bool catchUp(Slot slot, CatchUp policy, base::Ticks stepTicks, uint64_t& ioBudget, StepCounters& counters)
    {
        base::WorkBudget unlimited;
        return catchUp(slot, policy, stepTicks, ioBudget, counters, unlimited);
    }
    /// Advances a hidden instance to the present in one step of any length. If a previous call exceeded the
    /// work budget, continues its step.
    void stepCoarsely(Slot slot, base::Ticks stepTicks, StepCounters& counters, base::WorkBudget& work);
    /// Simulates the prewarm of an instance before its first step.
    /// @return true if the prewarm is complete. If it is not, the instance must be hidden, and catchUp()
    ///         continues the prewarm
    bool arrive(Slot slot, base::Ticks stepTicks, StepCounters& counters, base::WorkBudget& work)
    {
        return arrive(instances_[slot].simulation, now_, stepTicks, work, counters);
    }
    /// Ends a step that catchUp() has left incomplete.
    void closeStep(Slot slot) { closeSimulation(instances_[slot].simulation); }
    /// True if a prewarm, or a seek of seekTo(), is incomplete.
    bool isArriving(Slot slot) const { return simulations_.at(instances_[slot].simulation).arriving; }
    /// [tick] Part of an incomplete prewarm or seek that is not simulated yet, in local time.
    base::Ticks missing(Slot slot) const
    {
        const SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
        return simulation.arriving ? simulation.target - simulation.reached : 0;
    }
    /// Moves the solvers of a paused simulation to the free list and saves its state as bytes.
    /// @param mayForget true: particles that will be dead when the instance catches up are not saved
    /// @return scene time at which another call would free more memory; the largest number: never
    base::Ticks release(Slot slot, bool mayForget);
    /// Skips time of a lagging simulation if its past has no influence on the present. The simulation is
    /// moved to a step shortly before the present. A following catchUp() gives the same bits as without
    /// skipping.
    void passOver(Slot slot, base::Ticks stepTicks);
    /// Restores the solvers of a hidden instance.
    void materialize(Slot slot) { simulations_.materialize(instances_[slot].simulation); }
    /// Frees solvers that were moved to the free list before `tick`.
    void trimFreeList(base::Ticks tick) { simulations_.trimFreeList(tick); }
    /// number of sets of solvers in the free list
    size_t freeSolvers() const { return simulations_.freeSolvers(); }
    /// Scene time, at least the present, up to which steps do not change the visible state of the instance.
    /// World skips these steps.
    base::Ticks restsUntil(Slot slot) const;
    /// Number of instances that pools compute, see EmitterPool.
    uint32_t pooled() const { return pools_.members(); }
    /// Number of resting instances that the last step() skipped.
    uint32_t resting() const { return resting_; }
    /// Allows or forbids skipping the steps of resting instances.
    /// @param allow false: every step is executed
    void allowRest(bool allow) { mayRest_ = allow; }
    /// Allows or forbids the use of pools by emitters, beginning with the next step. The results do not
    /// depend on pools.
    /// @param allow false: no pools
    void allowPools(bool allow) { mayPool_ = allow; }
    /// Enables or disables GPU particles, beginning with the next step. See StepContext::gpuParticles.
    void setGpuParticles(bool onGpu) { gpuParticles_ = onGpu; }
    /// Advances resting instances to the present, for saving and hashing.
    void endRests();
    /// Sets the present time after restore(). All instances must have reached this time.
    void setNow(base::Ticks now);

    const Environment& environment() const { return environment_; }
    /// Replaces the geometry of the host, beginning with the next step; null: no geometry. Strong guarantee.
    /// Allocates memory if instances at different positions share a simulation.
    void setField(std::shared_ptr<const DistanceField> field);

    /// Sets the contact callback of the host, beginning with the next step. If its member `meet` is null,
    /// there are no contacts. Strong guarantee. Allocates memory if instances at different positions share a
    /// simulation.
    void setContact(const HostContact& contact);
    const HostContact& contact() const { return contact_; }
    /// Returns the number of invalid results of the contact callback since the last call.
    uint64_t takeContactFaults() { return contactFaults_ == 0 ? 0 : contactFaults_.exchange(0); }

    // Strong guarantee. The functions may allocate memory if the instance shares a simulation.
    void setPlacement(Slot slot, const base::Placement& placement);
    void setParameters(Slot slot, const InstanceParameters& parameters);
    /// Changes the playback rate of an instance at the present time. May allocate memory if the instance
    /// shares a simulation.
    void setRate(Slot slot, uint32_t rate);
    /// Moves an instance to local time `to`. The result equals a simulation from the first step in steps of
    /// `stepTicks` under the present conditions. Host events are not replayed. Strong guarantee.
    /// @return true if `to` is reached; if not, see arrive()
    bool seekTo(Slot slot, base::Ticks to, base::Ticks stepTicks, StepCounters& counters,
                base::WorkBudget& work);
    bool seekTo(Slot slot, base::Ticks to, base::Ticks stepTicks, StepCounters& counters)
    {
        base::WorkBudget unlimited;
        return seekTo(slot, to, stepTicks, counters, unlimited);
    }
    base::Ticks localTime(Slot slot) const { return clockOf(slot).toLocal(now_); }
    /// The present clock of an instance, including a change that is still pending. See InstanceClock.
    InstanceClock clockOf(Slot slot) const;
    /// Posts a host event to an instance. The event takes effect in the next step after the instance has
    /// reached the present. Strong guarantee; may allocate.
    void postEvent(Slot slot, const HostEvent& event);
    /// True if the instance has finished. Causes are: the effect's duration is over, all solvers have
    /// finished, or the instance does not emit and has no particles.
    bool finished(Slot slot, base::Ticks sceneTick) const;
    uint32_t elementCount(Slot slot) const;
    bool hasElements(Slot slot) const; ///< true if elementCount() is above 0
    const EffectDef& effect(Slot slot) const;
    /// number of simulations, at most one per instance
    uint32_t simulations() const { return simulations_.count(); }

    /// Steps each slot of `active` from scene time `tick` to `tick + stepTicks`, in the order of the list. An
    /// instance that starts within the step is stepped from its start tick. An instance that starts later is
    /// not stepped.
    StepCounters step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks);
    /// Begins a step in parts, with the same bits as step(). Call beginStep() once, then proceed() until it
    /// returns true. While a step is open, only functions that change or query an instance may be called.
    /// Changes of instances are deferred to the end of the step, see makeChanges().
    void beginStep(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks);
    /// Continues the open step. Returns true when the step is complete. After an exception, no step is open.
    /// @param work budget. At least one sub-step of a solver or of a gas is computed, even if it exceeds the
    ///         budget
    /// @param counters receives the counts when the step is complete
    bool proceed(base::WorkBudget& work, StepCounters& counters);
    /// True if a step or its publication is open.
    bool isStepping() const { return hand_.isOpen || publication_.isOpen; }
    bool isPublishing() const { return publication_.isOpen; }
    /// Applies deferred changes. If an exception is thrown, the remaining changes stay deferred.
    void makeChanges();
    bool hasChanges() const { return !waiting_.empty() || !leaving_.empty(); }

    /// Records events of particles for the host from the next step on.
    /// @param capacity    maximum number of events that one step keeps
    /// @param named   true: events of rules with a cue are recorded
    /// @param unnamed true: events of rules without a cue are recorded
    void recordCues(uint32_t capacity, bool named, bool unnamed)
    {
        cues_.emplace(memory_, capacity, named, unnamed);
    }
    /// Reads the events that the last step has recorded. Must be called once, after the step is complete.
    /// Calls f(place, event) for the kept events of each slot of `active` in the order of the list, with
    /// vectors in world space. Events that replays, prewarms and seeks pass are not recorded.
    /// @return number of events of the slots, including those that were not kept
    template <class F>
    uint64_t readCues(std::span<const Slot> active, F&& f)
    {
        uint64_t count = 0;
        if (!cues_ || !cues_->hasAny())
            return count;
        cues_->sort();
        for (uint32_t place = 0; place < active.size(); ++place) {
            const Instance& instance = instances_[active[place]];
            const SharedSimulation& simulation = simulations_.at(instance.simulation);
            if (simulation.cuesIn != stepNumber_)
                continue;
            count += simulation.cues;
            for (const CueEvent& event : cues_->of(simulation.cueOrder))
                f(place, event.isInWorld ? event : inWorld(event, instance.start.placement));
        }
        cues_->clear();
        return count;
    }

    /// Executes a step without instances. The time advances to `now`.
    void passTime(base::Ticks now)
    {
        if (!pools_.empty())
            endPools();
        now_ = now;
        resting_ = 0;
    }

    /// Writes the groups of each slot of `active`, in the order of the list.
    void publish(std::span<const Slot> active, base::FrameSnapshot& snapshot);
    /// Begins a publication in parts, with the same bits as publish(). Call beginPublication() once, then
    /// proceedPublication() until it returns true. Until then, the rules of an open step apply, and no other
    /// code may write to `snapshot`.
    void beginPublication(std::span<const Slot> active, base::FrameSnapshot& snapshot);
    /// Continues the publication. Returns true when the publication is complete. An exception ends the
    /// publication.
    bool proceedPublication(base::WorkBudget& work);
    void dropPublication() { publication_.isOpen = false; } ///< discards the written part of the snapshot

    /// Hash of the states of `slots`; equal for shared and separate simulations.
    uint64_t hash(std::span<const Slot> slots) const;
    /// Writes the states of `slots`. A shared state is written once.
    void save(std::span<const Slot> slots, StateWriter& writer) const;

    /// An instance to be restored, with the arguments of add().
    struct Entry
    {
        std::shared_ptr<const EffectDef> effect;
        InstanceStart start;
    };
    /// Fills an empty world with instances, in the order in which save() received them. After a failure,
    /// which the reader records, the world may only be destroyed.
    /// @param outSlots receives the slots; has as many elements as `entries`
    void restore(std::span<const Entry> entries, StateReader& reader, std::span<Slot> outSlots);
    /// Exchanges all instances with a world of the same schema, memory and environment that has no
    /// reservations. The reservations of this world stay, see SimulationPool::swap().
    void swap(World& other) noexcept;

private:
    struct Instance
    {
        SimulationIndex simulation = kNoSimulation;
        bool hidden = false;
        /// 1 plus the index in wanted_ of the deferred `start`; 0: `start` does not change
        uint32_t wanted = 0;
        InstanceStart start;
    };

    /// A change of an instance that is deferred while a step is open.
    struct Waiting
    {
        Slot slot;
        /// event; empty: the start of the instance changes to its entry in wanted_
        std::optional<HostEvent> event;
    };

    /// State of an incomplete step.
    struct StepInHand
    {
        bool isOpen = false;
        bool isPlanned = false;
        base::Ticks tick = 0;
        base::Ticks stepTicks = 0;
        size_t place = 0; ///< index of the present simulation in the list
        std::span<const Slot> active;
        std::span<const Slot> list;           ///< slots of `active` that are in no pool
        std::vector<Slot> ownActive, ownList; ///< memory of `active` and `list`, reused between calls
        StepCounters counters;
        std::optional<EventBoard> board;         ///< event board of the open sub-step
        std::span<const HostEvent> hostEvents{}; ///< host events of the step
    };
    /// State of an incomplete publication.
    struct PublicationInHand
    {
        bool isOpen = false;
        bool hasPools = false;
        size_t place = 0; ///< index of the present slot in the list
        std::span<const Slot> list;
        std::vector<Slot> own; ///< memory of `list` between two calls
        uint32_t solver = 0;   ///< index of the present solver in the slot
        size_t firstGroup = 0; ///< number of the first group of the slot in the snapshot
        PublicationPlace part; ///< progress of the publication of the present solver
        base::FrameSnapshot* snapshot = nullptr;
    };
    /// Inputs of a step of one simulation.
    struct SimulationStep
    {
        base::Ticks tick; ///< scene time
        base::Ticks stepTicks;
        /// Batch of births. Set only if the batch is executed before the simulation is read.
        SpawnBatch* spawnBatch = nullptr;
        /// event board of the step; null: the simulation has its own event board, see linkedPartOf()
        std::optional<EventBoard>* board = nullptr;
    };
    struct LocalSpan
    {
        base::Ticks begin; ///< local time
        base::Ticks end;
    };

    /// Lists that are rebuilt only when the list of slots or the pools have changed.
    struct Plan
    {
        std::vector<Slot> active; ///< the list
        std::vector<Slot> others; ///< instances that are in no pool
        uint64_t revision = 0;    ///< revision of the pools

        bool holds(std::span<const Slot> list, uint64_t now) const
        {
            return revision == now && std::ranges::equal(active, list);
        }
    };
    bool canPool(const SharedSimulation& simulation) const;
    void leavePool(SimulationIndex index);
    void endPools();
    void stepPools(std::span<const Slot> active, bool isPlanned, StepCounters& counters);
    void joinPools();
    void planStep(std::span<const Slot> active);
    void planPublication(std::span<const Slot> active);
    void makeRoster(std::span<const Slot> active);
    bool publishSlots(base::WorkBudget& work);
    bool stepSlot(base::WorkBudget& work);
    void keepStep();
    void dropStep();
    void changeAfterStep(Slot slot, const InstanceStart& start);
    /// The start of an instance, including changes that will be applied at the end of the open step.
    const InstanceStart& wantedOf(Slot slot) const
    {
        const Instance& instance = instances_[slot];
        return instance.wanted > 0 ? wanted_[instance.wanted - 1] : instance.start;
    }
    bool publishSlot(Slot slot, base::WorkBudget& work);

    static CueEvent inWorld(const CueEvent& event, const base::Placement& placement);
    void selectCues(SharedSimulation& simulation);
    SimulationConditions conditionsOf(const EffectDef& effect, const InstanceStart& start) const;
    Slot takeSlot(const InstanceStart& start, SimulationIndex simulation);
    void reserveSlots(size_t slots);
    /// Moves an instance to a simulation with the conditions of `start`.
    void change(Slot slot, const InstanceStart& start);
    SimulationIndex changeLater(SimulationIndex index, const SimulationConditions& wanted);
    bool isLagging(const SharedSimulation& simulation) const
    {
        return simulation.isPaused() && simulation.simulated < now_;
    }
    base::Ticks restOf(const SharedSimulation& simulation) const;
    void endRest(SimulationIndex index, base::Ticks tick);
    bool isFinished(const SharedSimulation& simulation, base::Ticks sceneTick) const;
    bool seek(SimulationIndex index, base::Ticks to, StepCounters& counters);
    template <class F>
    void withContext(SimulationIndex index, StepCounters& counters, F&& body);
    void divideByPlacement();
    void divideSimulations(std::span<const Slot> active);
    bool stepSolvers(SharedSimulation& simulation, StepContext& context, std::optional<EventBoard>& ioBoard,
                     base::WorkBudget& work);
    bool stepPart(SimulationIndex index, StepContext& context, const LocalSpan& time,
                  std::optional<EventBoard>& ioBoard, base::WorkBudget& work);
    LinkedPart* linkedPartOf(SharedSimulation& simulation);
    bool arrive(SimulationIndex index, base::Ticks tick, base::Ticks stepTicks, base::WorkBudget& work,
                StepCounters& counters);
    void setOut(SimulationIndex index, const LocalSpan& way, base::Ticks stepTicks, StepCounters& counters);
    bool replay(SimulationIndex index, base::WorkBudget& work, StepCounters& counters);
    bool replayPart(SimulationIndex index, base::WorkBudget& work, StepCounters& counters);
    void closeSimulation(SimulationIndex index);
    bool jump(SimulationIndex index, base::Ticks from, base::Ticks to, StepCounters& counters);
    void standBeforeStart(SimulationIndex index);
    bool playTo(SimulationIndex index, base::Ticks to, base::Ticks stepTicks, StepCounters& counters,
                base::WorkBudget& work);
    static void restoreSolvers(SharedSimulation& simulation, const StateBuffer& state);
    void isolate(Slot slot);
    std::span<const HostEvent> takeEvents(SimulationIndex index, base::Ticks tick, base::Arena& scratch);
    void restorePending(SharedSimulation& simulation, StateReader& reader);
    bool stepSimulation(SimulationIndex index, const SimulationStep& step, base::WorkBudget& work,
                        StepCounters& counters);
    void fetchAhead(std::span<const Slot> active, size_t place) const;
    void passQuietly(SharedSimulation& simulation, StepCounters& counters);
    base::Ticks quietOf(SharedSimulation& simulation) const;
    SimulationIndex restoreSimulation(const Entry& first, StateReader& reader);
    SimulationIndex joinSimulation(SimulationIndex index, const Entry& entry, StateReader& reader);

    void reserveUpdates();
    void updateConditions();
    static void standStill(const SharedSimulation& simulation);

    Environment environment_;
    HostContact contact_;
    std::atomic<uint64_t> contactFaults_{0};
    const base::SnapshotSchema* schema_;
    base::TaskRunner* tasks_;
    std::pmr::memory_resource* memory_;
    bool share_;
    base::Arena scratch_;
    SpawnBatch spawnBatch_; ///< batch of the open step or publication; empty if neither is open
    EmitterPools pools_;    ///< pools; declared before the simulations, because solvers are in the pools
    SimulationPool simulations_;
    std::vector<Instance> instances_;
    std::vector<Slot> free_;
    Plan stepPlan_;
    StepInHand hand_;
    PublicationInHand publication_;
    StepCounters closed_;                  ///< unreported counts of the work of steps that were ended early
    std::vector<Waiting> waiting_;         ///< deferred changes, in the order of the calls
    std::vector<InstanceStart> wanted_;    ///< starts that apply after the end of the open step
    std::vector<Slot> leaving_;            ///< removed instances
    std::vector<SimulationIndex> joining_; ///< simulations that may join a pool after the step
    std::vector<SimulationIndex> left_;    ///< simulations that left their pool in a step
    Plan publishPlan_;
    uint64_t placed_ = 0; ///< value of moves_ when publishPlan_ was made
    uint64_t moves_ = 1;  ///< number of motions of instances whose simulation is in a pool, plus 1
    /// Memory of rosters. Snapshots share the ownership of some rosters.
    std::vector<std::shared_ptr<base::GroupRoster>> rosterRoom_;
    std::shared_ptr<base::GroupRoster> roster_; ///< roster of the last publication
    std::vector<uint32_t> ends_;                ///< see FrameSnapshot::setRoster()
    std::optional<CueRecord> cues_; ///< events of the last step for the host; empty: they are not recorded
    uint32_t cueOrders_ = 0;        ///< number of simulations that have recorded events in the step
    uint64_t stepNumber_ = 0;
    uint64_t boards_ = 0; ///< number of EventBoards that have been created
    base::Ticks now_ = 0; ///< end of the last step
    uint32_t resting_ = 0;
    bool mayRest_ = true;
    bool mayPool_ = true;
    bool gpuParticles_ = false;
    bool rehearses_ = false; ///< true: a step is one of rehearse(), of which the host hears nothing
};

} // namespace fx::sim
