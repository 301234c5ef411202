/// @file simulation_pool.h
/// The simulations behind the instances of a world. Instances with equal results share one simulation. Before
/// one of these instances is changed, the state of the simulation is copied.
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

/// Key of a shared simulation: all conditions on which its results depend. The key does not contain the
/// placement of the instance, except its effect on local gravity and wind. If the simulation collides with
/// the host's geometry or depends on its placement, the key also contains the geometry and the placement.
struct SimulationConditions
{
    uint64_t seed = 0;
    /// Clock of the instance, relative to the start or to the last change of the clock by the host.
    InstanceClock clock;
    Quality quality;
    glm::vec3 gravity{0.0f}; ///< [m/s2] local gravity
    glm::vec3 wind{0.0f};    ///< [m/s] local wind, the sum of the winds of effect and host
    float groundHeight = 0;  ///< [m] local y of the ground plane; -infinity: no ground
    InstanceParameters
        parameters; ///< intensity and emission; the member for wind is 0, because `wind` includes it
    const DistanceField* field = nullptr; ///< the host's geometry; null: no geometry
    bool hasContact = false;              ///< true: the host's contact callback is used
    base::Placement placement; ///< target placement if the results depend on it; else the default placement
    /// [m/s] the host's wind in world space, if the effect depends on the placement
    glm::vec3 worldWind{0.0f};

    /// True if all members are equal, bit for bit.
    bool equals(const SimulationConditions& other) const;
    uint64_t hash() const;
};

/// Events of an incomplete sub-step, for solvers that exchange events. The struct is used for a shared
/// simulation that is stepped separately.
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
    /// A pending change of the conditions of a paused simulation. The simulation has not yet reached the time
    /// of the change.
    struct Change
    {
        base::Ticks tick; ///< scene time
        SimulationConditions conditions;
        std::shared_ptr<const DistanceField> field; ///< keeps the field of the conditions alive
    };

    /// A pending event of the host.
    struct PendingEvent
    {
        base::Ticks tick; ///< scene time
        HostEvent event;
    };

    // Members that every step and publication reads, adjacent for the cache.
    std::vector<std::unique_ptr<Solver>> solvers; ///< empty while released
    Solver* only = nullptr;                       ///< the solver, if there is only one; else null
    base::Ticks simulated = 0;                    ///< scene time of the state
    base::Ticks restUntil = 0;                    ///< scene time up to which steps have no effect
    /// Scene time up to which passTo() may replace steps, see SeekableSolver::passTo().
    base::Ticks quietUntil = 0;
    base::Ticks quietOffset = 0; ///< local time minus scene time, until quietUntil
    uint64_t steppedIn = 0;      ///< number of the last step of the world in which the simulation was stepped
    uint32_t users = 0;          ///< number of instances that use the simulation; 0: the simulation is unused
    uint32_t hidden = 0; ///< number of hidden users; if all users are hidden, the simulation is paused
    /// True: the only solver is in a pool. `simulated` is then the time at which the solver joined the pool.
    bool pooled = false;
    /// True: the solvers were released. `kept` then has the state of the solvers. Before the start of the
    /// instance, `kept` is empty.
    bool released = false;
    std::shared_ptr<const EffectDef> effect;
    SimulationConditions conditions;
    std::vector<Change> changes; ///< changes of a paused simulation, in the order of time
    /// host events that solvers have not received yet, in the order of time
    std::vector<PendingEvent> pendingEvents;
    std::shared_ptr<const DistanceField> field; ///< keeps the field of a paused simulation's conditions alive
    std::shared_ptr<const StateBuffer> pristine; ///< state of the solvers before their first step
    std::optional<StateBuffer> kept;
    bool reserved = false; ///< true: the solvers are a set of a reservation, see SimulationPool::reserve()
    bool brief = false;    ///< true: `kept` does not contain elements that have died since it was saved
    /// For a released simulation: scene time after which no particle of the state is alive.
    base::Ticks forgottenAt = kNever;
    bool fresh = false; ///< true: another instance may still join, because the simulation was not yet stepped
    uint32_t nextFresh = 0; ///< next fresh simulation with the same hash, see SimulationPool

    // State of an open step, see World::proceed(), and of an incomplete prewarm or seek, see World::arrive().
    bool inStep = false;        ///< true: some sub-steps of the step are complete, or one is open
    bool inPart = false;        ///< true: a sub-step is open
    bool arriving = false;      ///< true: a prewarm or seek from `reached` to `target` is in progress
    uint32_t stepped = 0;       ///< number of solvers that have finished the open sub-step
    base::Ticks part = 0;       ///< number of complete sub-steps of the step
    base::Ticks stepTick = 0;   ///< [tick] scene time at which the step begins
    base::Ticks stepLength = 0; ///< [tick] length of the step in scene time
    base::Ticks reached = 0;    ///< [tick] local time
    base::Ticks target = 0;     ///< [tick] local time
    /// events of a sub-step; exists while the simulation catches up separately
    std::unique_ptr<LinkedPart> linked{};

    // Data of one step of the world.
    uint64_t visitedIn = 0; ///< number of the last step whose list contained an instance of the simulation
    uint64_t dividedIn =
        0; ///< number of the last step whose list contained only some instances of the simulation
    uint32_t visits = 0;   ///< number of instances of the simulation in the list of step `visitedIn`
    uint64_t cuesIn = 0;   ///< number of the last step that recorded events for the host
    uint64_t cues = 0;     ///< number of events of that step, including those that were not kept
    uint32_t cueOrder = 0; ///< order of the simulation in that step
    uint32_t division =
        0; ///< index of the simulation to which the instances in the list of step `dividedIn` are moved

    static constexpr base::Ticks kNever = std::numeric_limits<base::Ticks>::max();
    bool isPaused() const { return hidden == users; }
    /// [tick] Local time at which all presently living elements are dead, see
    /// FiniteMemorySolver::influenceHorizon(). kNever while host events are pending.
    base::Ticks influenceHorizon() const;
    /// Updates `only`. Must be called after the solvers have been created or moved.
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
    /// Creates an empty pool.
    /// @param share false: every instance has its own simulation
    SimulationPool(const base::SnapshotSchema* schema, std::pmr::memory_resource* memory, bool share);

    SharedSimulation& at(SimulationIndex index) { return simulations_[index]; }
    const SharedSimulation& at(SimulationIndex index) const { return simulations_[index]; }
    uint32_t count() const { return count_; }           ///< number of simulations in use
    size_t size() const { return simulations_.size(); } ///< number of indices, used and unused

    // Functions that create solvers may throw std::bad_alloc. The pool then does not change.

    /// Adds an instance. The instance joins an equal fresh simulation or starts a new simulation.
    /// @param released true: a new simulation is started without solvers
    SimulationIndex acquire(const std::shared_ptr<const EffectDef>& effect,
                            const SimulationConditions& conditions, bool released = false);
    /// Creates a simulation without users. Instances cannot join the simulation before publish().
    SimulationIndex create(const std::shared_ptr<const EffectDef>& effect,
                           const SimulationConditions& conditions, bool released = false);
    /// Restores the solvers of a released simulation.
    void materialize(SimulationIndex index);
    /// Moves the solvers of a shared simulation to the free list and saves its state as bytes.
    /// @param mayForget true: the saved state may omit elements that die before the simulation is restored
    void release(SimulationIndex index, base::Ticks now, bool mayForget);
    /// Frees solvers that were moved to the free list before `tick`.
    void trimFreeList(base::Ticks tick);
    size_t freeSolvers() const { return freeList_.size(); }
    /// Copies a shared simulation with its state. The copy has one user.
    SimulationIndex copy(SimulationIndex index);
    /// Changes the conditions of a shared simulation for all users at the present time. Never fails.
    void reset(SimulationIndex index, const SimulationConditions& conditions);
    /// Changes the conditions of one user of a shared simulation at the present time. @return new simulation
    /// of the user
    SimulationIndex change(SimulationIndex index, const SimulationConditions& conditions);
    /// Removes a user. If no user remains, the solvers are destroyed.
    void leave(SimulationIndex index);
    /// Removes a user. If no user remains, the solvers are moved to the free list.
    void recycle(SimulationIndex index, base::Ticks now);
    /// Marks a simulation as stepped. The simulation is then no longer fresh.
    void touch(SimulationIndex index);
    /// Allows instances to join a fresh simulation.
    void publish(SimulationIndex index);

    /// Exchanges all simulations. The reservations stay: they get back the sets of the simulations that
    /// leave, and then hold for the simulations that come.
    /// @param other a pool without reservations
    void swap(SimulationPool& other) noexcept;

    /// A number of sets of solvers that are kept for the simulations of one effect at one quality.
    struct Reservation
    {
        std::shared_ptr<const EffectDef> effect;
        QualityLevel level;
        uint32_t count = 0;  ///< number of simulations that the reservation is for
        uint64_t misses = 0; ///< number of simulations that found no set
        uint32_t idle = 0;   ///< number of sets that no simulation uses
    };
    /// Creates or destroys sets of solvers until there are `count` for the effect, including those in use.
    /// Strong guarantee.
    /// @return number of sets that were created
    uint32_t reserve(const std::shared_ptr<const EffectDef>& effect, QualityLevel level, uint32_t count);
    /// Lowers the count of a reservation. Never fails.
    void shrinkReservation(const EffectDef& effect, QualityLevel level, uint32_t count) noexcept;
    /// Number of sets that no simulation would use, of all reservations, after reserve() with these
    /// arguments.
    size_t idleAfter(const EffectDef& effect, QualityLevel level, uint32_t count) const;
    size_t reservedSets() const; ///< sum of the counts of all reservations
    /// Reserves memory for the entries of `more` simulations. Strong guarantee.
    void reserveEntries(size_t more);
    std::optional<Reservation> reservation(const EffectDef& effect, QualityLevel level) const;
    /// Publishes a set of a reservation, for its room: one that no simulation uses, or one in use. Does
    /// nothing if there is none.
    void publishReserved(const EffectDef& effect, QualityLevel level, base::FrameSnapshot& snapshot) const;
    /// True if the solvers of the simulation return to a reservation.
    bool isReserved(SimulationIndex index) const { return simulations_[index].reserved; }

private:
    /// The solvers of one simulation in the free list.
    struct FreeSolvers
    {
        std::shared_ptr<const EffectDef> effect;
        QualityLevel level;
        std::vector<std::unique_ptr<Solver>> solvers;
        std::shared_ptr<const StateBuffer> pristine;
        base::Ticks since; ///< scene time
    };
    struct Reserved
    {
        Reservation is;
        std::vector<FreeSolvers> sets; ///< has room for all sets of the reservation
    };
    Reserved* reservedFor(const EffectDef& effect, QualityLevel level);
    uint32_t usedSets(const EffectDef& effect, QualityLevel level) const;
    void settle(Reserved& reserved) noexcept;
    FreeSolvers makeSet(const std::shared_ptr<const EffectDef>& effect, const Quality& quality) const;
    void takeSet(FreeSolvers& set, SharedSimulation& simulation);
    bool giveBack(SharedSimulation& simulation);
    static void restoreKept(const SharedSimulation& released, SharedSimulation& made);
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
    std::vector<Reserved> reserved_;
    std::array<SimulationIndex, kChains> chains_; ///< first fresh simulation of each hash;
                                                  ///< SharedSimulation::nextFresh links the next simulation
    uint32_t count_ = 0;
};

} // namespace fx::sim
