/// @file world.h
/// Holds the instances that exist and steps the given ones.
///
/// Instances with equal results are simulated once: those with equal effect, seed, start and quality, equal
/// intensity and emission, equal gravity and wind in local space, and, if they collide with the host's
/// geometry, equal placements. Each is published at its own placement. Sharing never changes results: when
/// one of them is changed, its state is copied first.
///
/// A simulation all of whose instances are hidden is paused: it costs nothing until catchUp() takes it to the
/// present, and changes meanwhile are applied at the time at which they were made.
///
/// Threads: one thread at a time (the scene thread). Work inside a step is spread over the task runner.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/arena.h"
#include "simulation/emitters/events/event_board.h"
#include "simulation/emitters/pools/emitter_pools.h"
#include "simulation/emitters/pools/spawn_batch.h"
#include "simulation/solver/effect_def.h"
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

/// How an instance enters the world.
struct InstanceStart
{
    uint64_t instance = 0; ///< identity, unique while the instance lives
    uint64_t seed = 0;
    base::Ticks startTick = 0; ///< scene time of local tick 0
    base::Placement placement;
    InstanceParameters parameters;
    QualityLevel quality = QualityLevel::Medium; ///< for life
    uint32_t rate = kNormalRate;                 ///< see InstanceClock, from the start on
    /// Set when the host has changed its time; otherwise derived from the members above.
    std::optional<InstanceClock> clock{};
};

/// Conditions shared by all instances of a world.
struct Environment
{
    glm::vec3 gravity{0.0f, -9.80665f, 0.0f};     ///< [m/s2] world
    bool hasGround = true;                        ///< false: no effect has a ground
    std::shared_ptr<const DistanceField> field{}; ///< geometry of the host; null for none
};

/// Index of an instance inside the world; valid until removed.
using Slot = uint32_t;

class World
{
public:
    /// @param share false: every instance has its own simulation
    World(const base::SnapshotSchema* schema, base::TaskRunner* tasks, std::pmr::memory_resource* memory,
          const Environment& environment = {}, bool share = true);

    /// Creates all solvers of `effect`. Strong guarantee: on an exception nothing has changed.
    /// @param hidden begin out of sight: solvers are created when it becomes visible
    Slot add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start, bool hidden = false);
    void remove(Slot slot);
    /// Removes an instance at the end of its life, and moves its solvers to the free list.
    void recycle(Slot slot);

    // ---- out of sight; hidden slots are not given to step() and publish() ----
    void hide(Slot slot);
    void show(Slot slot); ///< call after catchUp() has returned true
    bool isHidden(Slot slot) const { return instances_[slot].hidden; }
    /// True when the state has not reached the present.
    bool lags(Slot slot) const;
    base::Ticks simulated(Slot slot) const
    {
        const SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
        return simulation.pooled ? pools_.now() : simulation.simulated;
    }
    /// True when the simulation has so many pending changes that catchUp() should apply them.
    bool hasManyChanges(Slot slot) const;
    /// Advances a hidden instance towards the present by `policy`, its prewarm first. Strong guarantee for
    /// each step.
    /// @param ioBudget [1] particle steps that may be taken; each step costs one more than its particles. The
    ///         last step may exceed it.
    /// @param work also limits the call, possibly in the middle of a step, which the next call continues
    /// @return true when it is at the present, or finished
    bool catchUp(Slot slot, CatchUp policy, base::Ticks stepTicks, uint64_t& ioBudget, StepCounters& counters,
                 base::WorkBudget& work);
    bool catchUp(Slot slot, CatchUp policy, base::Ticks stepTicks, uint64_t& ioBudget, StepCounters& counters)
    {
        base::WorkBudget unlimited;
        return catchUp(slot, policy, stepTicks, ioBudget, counters, unlimited);
    }
    /// Takes one step of any length from the state of a hidden instance to the present, or continues one that
    /// exceeded the work budget.
    void stepCoarsely(Slot slot, base::Ticks stepTicks, StepCounters& counters, base::WorkBudget& work);
    /// Simulates the prewarm of an instance before its first step.
    /// @return whether it is complete; otherwise the instance must be hidden, and catchUp() continues
    bool arrive(Slot slot, base::Ticks stepTicks, StepCounters& counters, base::WorkBudget& work)
    {
        return arrive(instances_[slot].simulation, now_, stepTicks, work, counters);
    }
    /// Ends the step that catchUp() has begun and not ended.
    void closeStep(Slot slot) { closeSimulation(instances_[slot].simulation); }
    /// True while the past that an instance begins with, or is taken to by seekTo(), is not simulated yet.
    bool isArriving(Slot slot) const { return simulations_.at(instances_[slot].simulation).arriving; }
    /// [tick] local time that is not simulated yet.
    base::Ticks missing(Slot slot) const
    {
        const SharedSimulation& simulation = simulations_.at(instances_[slot].simulation);
        return simulation.arriving ? simulation.target - simulation.reached : 0;
    }
    /// Moves the solvers of a paused simulation to the free list and keeps its state as bytes.
    /// @param mayForget it will be caught up without a trace: particles that will be dead by then need not be
    ///             kept
    /// @return scene time at which another call would free more; the largest number for never
    base::Ticks release(Slot slot, bool mayForget);
    /// Skips time of a lagging simulation whose past has no influence: moves it to a step shortly before the
    /// present, from which catchUp() gives the same bits.
    void passOver(Slot slot, base::Ticks stepTicks);
    /// Gives a hidden instance its solvers back.
    void materialize(Slot slot) { simulations_.materialize(instances_[slot].simulation); }
    /// Frees solvers that have been in the free list since before `tick`.
    void trimFreeList(base::Ticks tick) { simulations_.trimFreeList(tick); }
    size_t freeSolvers() const { return simulations_.freeSolvers(); } ///< sets of solvers in the free list
    /// Scene time, at least the present, up to which steps do not change the visible state of the instance,
    /// and are not taken.
    base::Ticks restsUntil(Slot slot) const;
    uint32_t pooled() const
    {
        return pools_.members();
    }                                             ///< instances that are computed together, see EmitterPool
    uint32_t resting() const { return resting_; } ///< slots that the last step() let rest
    /// false: every step is taken.
    void allowRest(bool allow) { mayRest_ = allow; }
    /// false: emitters do not use pools, from the next step on. Results are the same.
    void allowPools(bool allow) { mayPool_ = allow; }
    /// Whether emitters are published as input of the GPU where possible, from the next step on; see
    /// StepContext::gpuParticles.
    void setGpuParticles(bool onGpu) { gpuParticles_ = onGpu; }
    /// Advances resting instances to the present, for saving and hashing.
    void endRests();
    /// Sets the present time after restore(), which all instances have reached.
    void setNow(base::Ticks now);

    const Environment& environment() const { return environment_; }
    /// Replaces the geometry of the host from the next step on; null for none. Strong guarantee; needs memory
    /// when instances at different places were simulated as one.
    void setField(std::shared_ptr<const DistanceField> field);

    /// Sets the contact callback of the host from the next step on; without `meet` there are no contacts. As
    /// setField().
    void setContact(const HostContact& contact);
    const HostContact& contact() const { return contact_; }
    /// Answers of the host since the last call that were none.
    uint64_t takeContactFaults() { return contactFaults_ == 0 ? 0 : contactFaults_.exchange(0); }

    // Strong guarantee. Both functions may allocate when the instance no longer gives the results of the
    // instances that share its simulation.
    void setPlacement(Slot slot, const base::Placement& placement);
    void setParameters(Slot slot, const InstanceParameters& parameters);
    /// Plays an instance at another rate from now on. As setParameters().
    void setRate(Slot slot, uint32_t rate);
    /// Moves an instance to local time `to`, with the result of playing it from its first step in steps of
    /// `stepTicks` under the present conditions; host events are not replayed. Strong guarantee.
    /// @return whether it has arrived; otherwise as arrive()
    bool seekTo(Slot slot, base::Ticks to, base::Ticks stepTicks, StepCounters& counters,
                base::WorkBudget& work);
    bool seekTo(Slot slot, base::Ticks to, base::Ticks stepTicks, StepCounters& counters)
    {
        base::WorkBudget unlimited;
        return seekTo(slot, to, stepTicks, counters, unlimited);
    }
    base::Ticks localTime(Slot slot) const { return clockOf(slot).toLocal(now_); }
    /// See InstanceClock; the present one, also while it is pending.
    InstanceClock clockOf(Slot slot) const;
    /// Posts a host event to an instance. It takes effect in the next step after its state has reached the
    /// present. Strong guarantee; may allocate.
    void postEvent(Slot slot, const HostEvent& event);
    /// True at the end of the effect's duration, when all solvers have finished, and when an instance that no
    /// longer emits is empty.
    bool finished(Slot slot, base::Ticks sceneTick) const;
    uint32_t elementCount(Slot slot) const;
    bool hasElements(Slot slot) const; ///< whether that is not 0
    const EffectDef& effect(Slot slot) const;
    uint32_t simulations() const { return simulations_.count(); } ///< at most one an instance

    /// Steps each slot of `active` from scene time `tick` to `tick + stepTicks`, in the order of the list. A
    /// slot whose start lies inside the step begins at its own start tick; one that starts later is left
    /// alone.
    StepCounters step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks);
    /// step() in parts, with equal bits: call beginStep() once, then proceed() until it returns true. While a
    /// step is open, changes of instances are deferred to its end, see endStep(), and only functions that
    /// change or query an instance may be called.
    void beginStep(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks);
    /// @param work at least one piece is executed: a sub-step of a solver, or a sub-step of a gas
    /// @param counters receives the counts of the step when it is complete After an exception no step is
    ///         open.
    bool proceed(base::WorkBudget& work, StepCounters& counters);
    /// Whether a step or its publication is open.
    bool isStepping() const { return hand_.isOpen || publication_.isOpen; }
    bool isPublishing() const { return publication_.isOpen; }
    /// Applies deferred changes. If an exception is thrown, the remaining ones stay deferred.
    void makeChanges();
    bool hasChanges() const { return !waiting_.empty() || !leaving_.empty(); }

    /// A step without instances: time advances to `now`.
    void passTime(base::Ticks now)
    {
        if (!pools_.empty())
            endPools();
        now_ = now;
        resting_ = 0;
    }

    /// Writes the groups of each slot of `active`, in the order of the list.
    void publish(std::span<const Slot> active, base::FrameSnapshot& snapshot);
    /// publish() in parts, with equal bits: call beginPublication() once, then proceedPublication() until it
    /// returns true. Meanwhile the rules of an open step apply, and no other code may write to `snapshot`.
    void beginPublication(std::span<const Slot> active, base::FrameSnapshot& snapshot);
    /// An exception closes the publication.
    bool proceedPublication(base::WorkBudget& work);
    void dropPublication() { publication_.isOpen = false; } ///< discards the written part of the snapshot

    /// Hash of the states behind `slots`; the same for shared and unshared ones.
    uint64_t hash(std::span<const Slot> slots) const;
    /// Writes the states behind `slots`, each once.
    void save(std::span<const Slot> slots, StateWriter& writer) const;

    /// An instance to restore: the arguments of add().
    struct Entry
    {
        std::shared_ptr<const EffectDef> effect;
        InstanceStart start;
    };
    /// Fills an empty world with instances in the order in which save() was given them.
    /// @param outSlots as many as `entries` After a failure, kept by the reader, the world may only be
    ///         destroyed.
    void restore(std::span<const Entry> entries, StateReader& reader, std::span<Slot> outSlots);
    /// Exchanges all instances with a world of the same schema, memory and environment.
    void swap(World& other) noexcept;

private:
    struct Instance
    {
        SimulationIndex simulation = kNoSimulation;
        bool hidden = false;
        uint32_t wanted = 0; ///< index in wanted_ plus 1 of the deferred `start`; 0: unchanged
        InstanceStart start;
    };

    /// A change of an instance while a step is open.
    struct Waiting
    {
        Slot slot;
        std::optional<HostEvent> event; ///< empty: its start changes to the wanted one
    };

    /// A step of which some is still to be done.
    struct StepInHand
    {
        bool isOpen = false;
        bool isPlanned = false;
        base::Ticks tick = 0;
        base::Ticks stepTicks = 0;
        size_t place = 0; ///< in the list, of the current simulation
        std::span<const Slot> active;
        std::span<const Slot> list;           ///< those of them that are in no pool
        std::vector<Slot> ownActive, ownList; ///< memory of both, reused between calls
        StepCounters counters;
        std::optional<EventBoard> board;         ///< of the open sub-step
        std::span<const HostEvent> hostEvents{}; ///< host events of the step
    };
    /// A publication of which some is still to be written.
    struct PublicationInHand
    {
        bool isOpen = false;
        bool hasPools = false;
        size_t place = 0; ///< in the list, of the current slot
        std::span<const Slot> list;
        std::vector<Slot> own; ///< its memory, between two calls
        uint32_t solver = 0;   ///< of that slot
        PublicationPlace part; ///< of that solver
        base::FrameSnapshot* snapshot = nullptr;
    };
    /// A step of one simulation.
    struct SimulationStep
    {
        base::Ticks tick; ///< scene time
        base::Ticks stepTicks;
        SpawnBatch* spawnBatch = nullptr; ///< null unless it is closed before the simulation is read
        std::optional<EventBoard>* board = nullptr; ///< null: the simulation has its own, see linkedPartOf()
    };
    struct LocalSpan
    {
        base::Ticks begin; ///< local time
        base::Ticks end;
    };

    /// Data that is rebuilt only when the list or the pools have changed.
    struct Plan
    {
        std::vector<Slot> active; ///< the list
        std::vector<Slot> others; ///< instances that are in no pool
        uint64_t revision = 0;    ///< of the pools

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
    /// Its start including changes that are deferred to the end of the open step.
    const InstanceStart& wantedOf(Slot slot) const
    {
        const Instance& instance = instances_[slot];
        return instance.wanted > 0 ? wanted_[instance.wanted - 1] : instance.start;
    }
    bool publishSlot(Slot slot, base::WorkBudget& work);

    SimulationConditions conditionsOf(const EffectDef& effect, const InstanceStart& start) const;
    Slot takeSlot(const InstanceStart& start, SimulationIndex simulation);
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
    SpawnBatch spawnBatch_; ///< of the open step or publication; empty otherwise
    EmitterPools pools_;    ///< before the simulations, whose solvers are in them
    SimulationPool simulations_;
    std::vector<Instance> instances_;
    std::vector<Slot> free_;
    Plan stepPlan_;
    StepInHand hand_;
    PublicationInHand publication_;
    StepCounters closed_;                  ///< work of steps that had to be ended, not counted yet
    std::vector<Waiting> waiting_;         ///< in the order of the calls
    std::vector<InstanceStart> wanted_;    ///< from the end of the open step on
    std::vector<Slot> leaving_;            ///< removed instances
    std::vector<SimulationIndex> joining_; ///< simulations that may join a pool after the step
    std::vector<SimulationIndex> left_;    ///< simulations that left their pool in a step
    Plan publishPlan_;
    uint64_t placed_ = 0; ///< of publishPlan_: see moves_
    uint64_t moves_ = 1;  ///< goes up when an instance whose simulation is in a pool has been moved
    std::vector<std::shared_ptr<base::GroupRoster>> rosterRoom_; ///< snapshots hold some of them
    std::shared_ptr<base::GroupRoster> roster_;                  ///< of the last publication
    std::vector<uint32_t> ends_;                                 ///< see FrameSnapshot::setRoster()
    uint64_t stepNumber_ = 0;
    uint64_t boards_ = 0; ///< number of EventBoards that have been created
    base::Ticks now_ = 0; ///< end of the last step
    uint32_t resting_ = 0;
    bool mayRest_ = true;
    bool mayPool_ = true;
    bool gpuParticles_ = false;
};

} // namespace fx::sim
