/// @file simulation_pool.h
/// The simulations behind the instances of a world. Instances that must come out alike share one simulation;
/// a shared simulation is divided by copying its state as soon as one of its instances is to differ.
#pragma once

#include "foundation/math/geometry.h"
#include "simulation/emitters/events/event_board.h"
#include "simulation/solver/budgeted_solver.h"
#include "simulation/solver/effect_def.h"
#include "simulation/solver/finite_memory_solver.h"
#include "simulation/solver/seekable_solver.h"
#include "simulation/world/instance_clock.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <memory_resource>
#include <optional>
#include <vector>

namespace fx::sim {

/// Key of a shared simulation: all conditions that its results depend on. Position, scale, and a rotation
/// that does not change local gravity and wind are not part of it, unless the simulation collides with the
/// host's geometry or depends on its placement.
struct SimulationConditions
{
    uint64_t seed = 0;
    InstanceClock clock; ///< its anchor is the start, or when the host last changed its time
    Quality quality;
    glm::vec3 gravity{0.0f};              ///< [m/s2] local
    glm::vec3 wind{0.0f};                 ///< [m/s] local, the effect's and the host's
    float groundHeight = 0;               ///< [m] local y; -infinity for none
    InstanceParameters parameters;        ///< intensity and emission; its wind is 0, being part of `wind`
    const DistanceField* field = nullptr; ///< the host's geometry; null for none
    bool hasContact = false;              ///< the host's contact callback is used
    base::Placement placement;            ///< if results depend on it; otherwise the default
    glm::vec3 worldWind{0.0f}; ///< [m/s] world, the host's, where the effect depends on its placement

    /// Bit for bit.
    bool equals(const SimulationConditions& other) const;
    uint64_t hash() const;
};

/// An incomplete sub-step of solvers that exchange events, in a shared simulation that is stepped separately.
/// Keeps the events until the next call.
struct LinkedPart
{
    explicit LinkedPart(std::pmr::memory_resource* memory) : scratch(memory) {}

    base::Arena scratch;
    std::optional<EventBoard> board;
    std::span<const HostEvent> hostEvents{}; ///< in `scratch`
};

/// The solvers of one effect and their inputs.
struct SharedSimulation
{
    /// A pending change of the conditions of a paused simulation, at a time that it has not reached yet.
    struct Change
    {
        base::Ticks tick; ///< scene time
        SimulationConditions conditions;
        std::shared_ptr<const DistanceField> field; ///< keeps that of the conditions
    };

    /// An event of the host.
    struct PendingEvent
    {
        base::Ticks tick; ///< scene time
        HostEvent event;
    };

    // Members that every step and publication reads, adjacent for the cache.
    std::vector<std::unique_ptr<Solver>> solvers; ///< none while released
    Solver* only = nullptr;                       ///< the solver, if there is only one; otherwise null
    base::Ticks simulated = 0;                    ///< scene time that the state has reached
    base::Ticks restUntil = 0;                    ///< scene time up to which steps would have no effect
    base::Ticks quietUntil =
        0; ///< scene time up to which steps need not be taken, see SeekableSolver::passTo()
    base::Ticks quietOffset = 0; ///< local minus scene time meanwhile
    uint64_t steppedIn = 0;      ///< number of the last step that stepped it
    uint32_t users = 0;          ///< number of its instances; 0: unused
    uint32_t hidden = 0;         ///< users that are out of sight; when all are, the simulation is paused
    bool pooled = false;         ///< its only solver is in a pool; `simulated` is of the time before
    bool released =
        false; ///< its solvers were released; `kept` has their state, and is empty before the start
    std::shared_ptr<const EffectDef> effect;
    SimulationConditions conditions;
    std::vector<Change> changes;                 ///< of a paused simulation, by tick
    std::vector<PendingEvent> pendingEvents;     ///< by the host, not hostEvents yet, by tick
    std::shared_ptr<const DistanceField> field;  ///< keeps that of the conditions of a paused simulation
    std::shared_ptr<const StateBuffer> pristine; ///< of the solvers before their first step
    std::optional<StateBuffer> kept;
    bool brief = false; ///< the kept state lacks elements, all of which are dead by now
    base::Ticks forgottenAt =
        kNever; ///< scene time after which no particle of the state is alive; of a released simulation
    bool fresh = false;     ///< no step has touched it: another instance may still join
    uint32_t nextFresh = 0; ///< see SimulationPool

    // An open step, see World::proceed(), and a past that is still to be simulated, see World::arrive().
    bool inStep = false;                  ///< some of its sub-steps are complete, or one is open
    bool inPart = false;                  ///< a sub-step is open
    bool arriving = false;                ///< it is simulated from `reached` to `target`, its prewarm or seek
    uint32_t stepped = 0;                 ///< solvers that are through with the open sub-step
    base::Ticks part = 0;                 ///< sub-steps of the step that are complete
    base::Ticks stepTick = 0;             ///< [tick] of the scene at which the step begins
    base::Ticks stepLength = 0;           ///< [tick] of the scene
    base::Ticks reached = 0;              ///< [tick] local
    base::Ticks target = 0;               ///< [tick] local
    std::unique_ptr<LinkedPart> linked{}; ///< while it catches up separately

    // of one step of the world
    uint64_t visitedIn = 0; ///< number of the last step whose list contained it
    uint64_t dividedIn = 0; ///< number of the last step that had only some of its users
    uint32_t visits = 0;    ///< users in the list of that step
    uint32_t division = 0;  ///< simulation of these users

    static constexpr base::Ticks kNever = std::numeric_limits<base::Ticks>::max();
    bool isPaused() const { return hidden == users; }
    /// [tick] local time after which no element alive now is left, see influenceHorizon(); kNever also while
    /// host events are pending.
    base::Ticks influenceHorizon() const;
    /// The solvers have been made or given away.
    void updateOnly() { only = solvers.size() == 1 ? solvers.front().get() : nullptr; }
    void save(StateWriter& writer) const;
    void saveWithoutElements(StateWriter& writer) const;
    void restore(StateReader& reader);
};

using SimulationIndex = uint32_t;
constexpr SimulationIndex kNoSimulation = ~0u;

class SimulationPool
{
public:
    /// @param share false: every instance has its own simulation
    SimulationPool(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory, bool share);

    SharedSimulation& at(SimulationIndex index) { return simulations_[index]; }
    const SharedSimulation& at(SimulationIndex index) const { return simulations_[index]; }
    uint32_t count() const { return count_; }           ///< simulations in use
    size_t size() const { return simulations_.size(); } ///< one more than the largest index

    // Functions that create solvers may throw std::bad_alloc and then leave the pool unchanged.

    /// One more instance: joins a fresh simulation that is equal, or starts one.
    /// @param released start it without solvers
    SimulationIndex acquire(const std::shared_ptr<const EffectDef>& effect,
                            const SimulationConditions& conditions, bool released = false);
    /// A simulation without users, which no instance joins before publish().
    SimulationIndex create(const std::shared_ptr<const EffectDef>& effect,
                           const SimulationConditions& conditions, bool released = false);
    /// Gives a released simulation its solvers back.
    void materialize(SimulationIndex index);
    /// Moves the solvers of a shared simulation to the free list and keeps its state as bytes.
    /// @param mayForget the state may omit elements that die before it is restored
    void release(SimulationIndex index, base::Ticks now, bool mayForget);
    /// Frees solvers that have been in the free list since before `tick`.
    void trimFreeList(base::Ticks tick);
    size_t freeSolvers() const { return freeList_.size(); }
    /// A copy of a shared simulation, with its state and one user.
    SimulationIndex copy(SimulationIndex index);
    /// All users of a shared simulation are to have other conditions from now on. Never fails.
    void reset(SimulationIndex index, const SimulationConditions& conditions);
    /// Changes the conditions of one user of a shared simulation from now on. @return the simulation of this
    /// user afterwards
    SimulationIndex change(SimulationIndex index, const SimulationConditions& conditions);
    /// Removes a user; without users the solvers are destroyed.
    void leave(SimulationIndex index);
    /// The same, but the solvers go to the free list.
    void recycle(SimulationIndex index, base::Ticks now);
    /// The simulation is stepped: it is no longer fresh.
    void touch(SimulationIndex index);
    /// A fresh simulation may be joined from now on.
    void publish(SimulationIndex index);

    void swap(SimulationPool& other) noexcept;

private:
    /// Solvers of the free list.
    struct FreeSolvers
    {
        std::shared_ptr<const EffectDef> effect;
        QualityLevel level;
        std::vector<std::unique_ptr<Solver>> solvers;
        std::shared_ptr<const StateBuffer> pristine;
        base::Ticks since; ///< scene time
    };
    static constexpr size_t kChains = 256;
    static constexpr size_t kMaxFreeSolvers = 256;
    void makeSolvers(SharedSimulation& simulation);
    void addToFreeList(SharedSimulation& simulation, base::Ticks now);
    uint32_t& chainOf(const SharedSimulation& simulation)
    {
        return chains_[simulation.conditions.hash() % kChains];
    }
    SimulationIndex findFresh(const EffectDef* effect, const SimulationConditions& conditions) const;
    void unlink(SimulationIndex index);

    const base::SnapshotSchema* schema_;
    std::pmr::memory_resource* memory_;
    bool share_;
    std::vector<SharedSimulation> simulations_;
    std::vector<SimulationIndex> free_;
    std::vector<FreeSolvers> freeList_; ///< by time
    std::array<SimulationIndex, kChains>
        chains_; ///< first fresh simulation of each hash; SharedSimulation::nextFresh is the next
    uint32_t count_ = 0;
};

} // namespace fx::sim
