/// @file simulation_pool.h
/// The simulations behind the instances of a world. Instances with equal results share one simulation. When
/// one of these instances must differ, the state of the simulation is copied first.
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

/// Key of a shared simulation: all conditions on which its results depend. It does not contain the position,
/// the scale, or a rotation that leaves local gravity and wind unchanged. Only if the simulation collides
/// with the host's geometry or depends on its placement, these are part of the key.
struct SimulationConditions
{
    uint64_t seed = 0;
    InstanceClock clock; ///< its anchor is the start, or the time at which the host last changed it
    Quality quality;
    glm::vec3 gravity{0.0f};       ///< [m/s] local, sum of the winds of effect and host
    glm::vec3 wind{0.0f};          ///< [m/s] local, the effect's and the host's
    float groundHeight = 0;        ///< [m] local y; -infinity for none
    InstanceParameters parameters; ///< intensity and emission; the wind is 0, because `wind` contains it
    const DistanceField* field = nullptr; ///< the host's geometry; null for none
    bool hasContact = false;              ///< the host's contact callback is used
    base::Placement placement;            ///< target placement if results depend on it; otherwise the default
    glm::vec3 worldWind{0.0f}; ///< [m/s] world, the host's wind, if the effect depends on its placement

    /// Compares bit for bit.
    bool equals(const SimulationConditions& other) const;
    uint64_t hash() const;
};

/// An incomplete sub-step of solvers that exchange events, in a shared simulation that is stepped separately.
/// It keeps the events until the next call.
struct LinkedPart
{
    explicit LinkedPart(std::pmr::memory_resource* memory) : scratch(memory) {}

    base::Arena scratch;
    std::optional<EventBoard> board;
    std::span<const HostEvent> hostEvents{}; ///< events of the host, stored in `scratch`
};

/// The solvers of one effect and their inputs.
struct SharedSimulation
{
    /// A pending change of the conditions of a paused simulation. The simulation has not reached its time
    /// yet.
    struct Change
    {
        base::Ticks tick; ///< scene time
        SimulationConditions conditions;
        std::shared_ptr<const DistanceField> field; ///< keeps the field of the conditions alive
    };

    /// An event of the host.
    struct PendingEvent
    {
        base::Ticks tick; ///< scene time
        HostEvent event;
    };

    // Members that every step and publication reads, adjacent for the cache.
    std::vector<std::unique_ptr<Solver>> solvers; ///< empty while released
    Solver* only = nullptr;                       ///< the solver, if there is only one; otherwise null
    base::Ticks simulated = 0;                    ///< scene time of the state
    base::Ticks restUntil = 0;                    ///< scene time up to which steps have no effect
    base::Ticks quietUntil =
        0; ///< scene time up to which steps need not be taken, see SeekableSolver::passTo()
    base::Ticks quietOffset = 0; ///< local time minus scene time until then
    uint64_t steppedIn = 0;      ///< number of the last step in which it was stepped
    uint32_t users = 0;          ///< number of its instances; 0: unused
    uint32_t hidden = 0; ///< number of users that are out of sight; if all are, the simulation is paused
    bool pooled = false; ///< its only solver is in a pool; then `simulated` is the time of joining
    bool released =
        false; ///< its solvers were released; `kept` has their state, and is empty before the start
    std::shared_ptr<const EffectDef> effect;
    SimulationConditions conditions;
    std::vector<Change> changes;                ///< changes of a paused simulation, by tick
    std::vector<PendingEvent> pendingEvents;    ///< host events that are not yet in hostEvents, by tick
    std::shared_ptr<const DistanceField> field; ///< keeps the field of a paused simulation's conditions alive
    std::shared_ptr<const StateBuffer> pristine; ///< state of the solvers before their first step
    std::optional<StateBuffer> kept;
    bool brief = false; ///< the kept state lacks elements that have died since
    base::Ticks forgottenAt =
        kNever; ///< scene time after which no particle of the state is alive; of a released simulation
    bool fresh = false;     ///< not stepped yet; another instance may still join
    uint32_t nextFresh = 0; ///< see SimulationPool

    // State of an open step, see World::proceed(), and of an incomplete prewarm or seek, see World::arrive().
    bool inStep = false;                  ///< some of its sub-steps are complete, or one is open
    bool inPart = false;                  ///< a sub-step is open
    bool arriving = false;                ///< a prewarm or seek from `reached` to `target` is in progress
    uint32_t stepped = 0;                 ///< number of solvers that have finished the open sub-step
    base::Ticks part = 0;                 ///< number of complete sub-steps of the step
    base::Ticks stepTick = 0;             ///< [tick] of the scene at which the step begins
    base::Ticks stepLength = 0;           ///< [tick] of the scene
    base::Ticks reached = 0;              ///< [tick] local
    base::Ticks target = 0;               ///< [tick] local
    std::unique_ptr<LinkedPart> linked{}; ///< exists while the simulation catches up separately

    // Data of one step of the world.
    uint64_t visitedIn = 0; ///< number of the last step whose list contained it
    uint64_t dividedIn = 0; ///< number of the last step whose list contained only some of its users
    uint32_t visits = 0;    ///< number of users in the list of that step
    uint32_t division = 0;  ///< the simulation for these users

    static constexpr base::Ticks kNever = std::numeric_limits<base::Ticks>::max();
    bool isPaused() const { return hidden == users; }
    /// [tick] local time after which no presently living element is left, see influenceHorizon(). kNever
    /// while host events are pending.
    base::Ticks influenceHorizon() const;
    /// Called after the solvers have been created or moved.
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

    // Functions that create solvers may throw std::bad_alloc; then the pool is unchanged.

    /// Adds an instance, which joins an equal fresh simulation or starts a new one.
    /// @param released start a new simulation without solvers
    SimulationIndex acquire(const std::shared_ptr<const EffectDef>& effect,
                            const SimulationConditions& conditions, bool released = false);
    /// Creates a simulation without users; instances cannot join it before publish().
    SimulationIndex create(const std::shared_ptr<const EffectDef>& effect,
                           const SimulationConditions& conditions, bool released = false);
    /// Restores the solvers of a released simulation.
    void materialize(SimulationIndex index);
    /// Moves the solvers of a shared simulation to the free list and keeps its state as bytes.
    /// @param mayForget the saved state may omit elements that die before the simulation is restored
    void release(SimulationIndex index, base::Ticks now, bool mayForget);
    /// Frees solvers that have been in the free list since before `tick`.
    void trimFreeList(base::Ticks tick);
    size_t freeSolvers() const { return freeList_.size(); }
    /// Copies a shared simulation with its state; the copy has one user.
    SimulationIndex copy(SimulationIndex index);
    /// Changes the conditions of a shared simulation for all users from now on. Never fails.
    void reset(SimulationIndex index, const SimulationConditions& conditions);
    /// Changes the conditions of one user of a shared simulation from now on. @return the simulation of this
    /// user afterwards
    SimulationIndex change(SimulationIndex index, const SimulationConditions& conditions);
    /// Removes a user; without users the solvers are destroyed.
    void leave(SimulationIndex index);
    /// As leave(), but moves the solvers to the free list.
    void recycle(SimulationIndex index, base::Ticks now);
    /// Marks a simulation as stepped; it is no longer fresh.
    void touch(SimulationIndex index);
    /// Allows instances to join a fresh simulation from now on.
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
    std::vector<FreeSolvers> freeList_; ///< sorted by time
    std::array<SimulationIndex, kChains>
        chains_; ///< first fresh simulation of each hash; SharedSimulation::nextFresh is the next
    uint32_t count_ = 0;
};

} // namespace fx::sim
