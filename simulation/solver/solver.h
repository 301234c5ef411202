/// @file solver.h
/// Interface of a simulation technique: an immutable definition, built from a preset, and a solver per
/// instance. Optional capabilities have interfaces of their own: budgeted_solver.h, seekable_solver.h,
/// finite_memory_solver.h, and emitters/pools/pooled_emitter.h.
///
/// Solvers work in the instance's local space. Time is the instance's own: tick 0 is its start.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/arena.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/tasks/task_runner.h"
#include "foundation/time/ticks.h"
#include "simulation/collision/collider.h"
#include "simulation/motion/thermal_flow.h"
#include "simulation/solver/quality.h"
#include "simulation/state/state_reader.h"
#include "simulation/state/state_writer.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <memory_resource>
#include <span>

namespace fx::base {
class GpuParticleProgram;
}

namespace fx::sim {

/// Policy for a hidden instance: how its state reaches the present when the instance is visible again.
enum class CatchUp : uint8_t
{
    Analytic, ///< not simulated; the present is computed directly, with the bits of an unbroken simulation
    Replay,   ///< not simulated; the missing steps are taken later, some each frame, with the same bits
    Coarse,   ///< steps of four times the length, at fixed ticks; deterministic, but other bits
    Skip,     ///< not simulated; the missing time is left out: particles age without moving
    Authoritative, ///< always simulated
};

/// True if hiding an instance does not change its state.
constexpr bool isExact(CatchUp policy)
{
    return policy == CatchUp::Analytic || policy == CatchUp::Replay || policy == CatchUp::Authoritative;
}

constexpr int64_t kCoarseSteps = 4; ///< steps of the scene in one step of CatchUp::Coarse

/// Parameters of a running instance.
struct InstanceParameters
{
    float intensity = 1.0f; ///< [1] >= 0, scales future birth rates and injected energies
    glm::vec3 wind{0.0f};   ///< [m/s] world, added to the effect's own wind
    bool emitting = true;   ///< false: no births, existing elements continue
};

/// Work done, summed over a step; exact counts, not times.
struct StepCounters
{
    uint64_t born = 0;
    uint64_t dropped = 0;       ///< births refused because a capacity was full
    uint64_t particleSteps = 0; ///< particles advanced, once per sub-step
    uint64_t neighborPairs = 0;
    uint64_t subSteps = 0;
    uint64_t clamped = 0; ///< values limited to keep the state finite
    base::Ticks debt = 0; ///< time that is not simulated, because the limit of sub-steps was reached
    uint64_t events = 0;  ///< events of particles, counted once for each rule that may answer

    StepCounters& operator+=(const StepCounters& more)
    {
        born += more.born;
        dropped += more.dropped;
        particleSteps += more.particleSteps;
        neighborPairs += more.neighborPairs;
        subSteps += more.subSteps;
        clamped += more.clamped;
        events += more.events;
        debt += more.debt;
        return *this;
    }
    /// Difference to the earlier counters `before`.
    StepCounters since(const StepCounters& before) const
    {
        return {born - before.born,
                dropped - before.dropped,
                particleSteps - before.particleSteps,
                neighborPairs - before.neighborPairs,
                subSteps - before.subSteps,
                clamped - before.clamped,
                debt - before.debt,
                events - before.events};
    }
};

/// Geometry behind a callback of the host. The callback is called for each path of particles that collide
/// with it.
struct ContactHook
{
    void* user = nullptr;
    /// Intersects the segment from `from` to `to` [m, local]. Returns 0 when it is free. Otherwise gives the
    /// share of the path before the contact, 0..1, and the normal, of any length. Called by several threads
    /// at once. Equal arguments must give equal results during a step.
    int (*meet)(void* user, const float from[3], const float to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

/// Contact callback in world space, set by the host.
struct HostContact
{
    void* user = nullptr;
    int (*meet)(void* user, const double from[3], const double to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

class SpawnBatch;
class EventBoard;

/// An event of the host.
struct HostEvent
{
    uint32_t event; ///< index in EffectDef::hostEvents
    uint32_t count; ///< number of times that it was triggered
};

/// Input of a solver for one step.
struct StepContext
{
    base::Ticks tick;         ///< local time at which the step begins
    base::Ticks stepTicks;    ///< length of the step, > 0
    uint64_t seed;            ///< seed of the instance
    uint32_t solverIndex;     ///< position in the effect; part of the key of every random number
    glm::vec3 gravity;        ///< [m/s2] local
    glm::vec3 wind;           ///< [m/s] local
    float groundHeight;       ///< [m] local y of the ground plane; -infinity for none
    const Collider* collider; ///< the host's geometry; null for none
    /// intensity and emission; the host's wind is already part of `wind`
    const InstanceParameters* parameters;
    base::TaskRunner* tasks;
    base::Arena* scratch; ///< freed after the step
    StepCounters* counters;
    const ContactHook* contactHook = nullptr; ///< null for none
    EventBoard* board = nullptr;              ///< events between solvers in this step; null for none
    std::span<const HostEvent> hostEvents{};  ///< happen at `tick`
    /// may defer births to the end of the step; null: births are computed at once
    SpawnBatch* spawnBatch = nullptr;
    /// target of the instance's motion; identity unless the effect depends on it
    base::Placement placement{};
    /// [1] 0..1, share of the remaining motion to `placement` that takes place in this step.
    float moveShare = 1.0f;
    glm::vec3 worldGravity{0.0f}; ///< [m/s2] world
    /// [m/s] world, the host's share of `wind`; 0 unless the effect depends on the placement
    glm::vec3 worldWind{0.0f};
    glm::vec3 effectWind{0.0f};              ///< [m/s] local, the preset's share of `wind`
    std::span<const ThermalFlow> thermals{}; ///< flows of the effect's gases, for solvers that follow them
    bool gpuParticles = false; ///< emitters that the GPU may compute need not be computed as rows

    float seconds() const { return float(base::toSeconds(stepTicks)); }
};

class AirMover;
class BudgetedSolver;
class FiniteMemorySolver;
class PooledEmitter;
class SeekableSolver;

/// The changing state of one emitter, one gas, ... of one instance.
class Solver
{
public:
    virtual ~Solver() = default;

    /// Advances by one fixed step. Equal calls give equal bits for any number of threads. Allocates scratch
    /// memory only.
    virtual void step(const StepContext& context) = 0;

    /// Adds the visible groups to `snapshot`. `base` has instance, solver and placement to copy into each
    /// group. A solver without elements also adds its group, so that the memory of the group exists before
    /// the first birth.
    virtual void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const = 0;

    /// True when no element is alive and none will be born from local time `tick` on.
    virtual bool finished(base::Ticks tick) const = 0;

    virtual uint32_t elementCount() const = 0;

    /// Whether elementCount() is above 0; may be cheaper than counting.
    virtual bool hasElements() const { return elementCount() > 0; }

    /// Writes exactly the data that later steps and publications depend on, so equal states write equal
    /// bytes.
    virtual void save(StateWriter& writer) const = 0;

    /// Restores the state of a solver of the same definition and quality; later results have the same bits.
    /// Validates all data. After a failure, which the reader records, the solver may only be destroyed.
    virtual void restore(StateReader& reader) = 0;

    // Optional interfaces; null if the solver does not have one.

    virtual const AirMover* airMover() const { return nullptr; }
    virtual BudgetedSolver* budgeted() { return nullptr; }
    virtual SeekableSolver* seekable() { return nullptr; }
    virtual FiniteMemorySolver* finiteMemory() { return nullptr; }
    virtual PooledEmitter* pooledEmitter() { return nullptr; }
};

/// Conditions for the bound of distances.
struct ReachConditions
{
    float gravity = 0; ///< [m/s2] magnitude
    float wind = 0;    ///< [m/s] magnitude
    float seconds = 0; ///< [s] time since the start
};

/// Bounds of births caused by events of other solvers.
struct BirthReach
{
    float distance = 0; ///< [m] largest distance from the origin
    float speed = 0;    ///< [m/s] largest inherited speed

    void add(const BirthReach& more)
    {
        distance = std::max(distance, more.distance);
        speed = std::max(speed, more.speed);
    }
};

/// Influence of an instance's past on its living elements.
struct Influence
{
    /// [s] time of the instance after which the past has no influence; infinite if unknown
    float seconds = 0;
    float inherits = 0; ///< [1] share of the instance's velocity that particles inherit
    float extent = 0;   ///< [m] local extent of the births of particles that inherit velocity
    float drawnOut = 0; ///< [s] time by which sprites are stretched along their velocity

    void add(const Influence& more)
    {
        seconds += more.seconds; // one solver may cause births in another
        inherits = std::max(inherits, more.inherits);
        extent = std::max(extent, more.extent);
        drawnOut = std::max(drawnOut, more.drawnOut);
    }
};

/// Expected amounts of work of a step of a solver.
struct StepLoad
{
    double seconds;    ///< [s] length
    double births = 0; ///< of emitters: births, including those caused by events
    double alive = 0;  ///< of emitters: living particles, at most the capacity
    double events = 0; ///< of emitters: events of particles, counted once for each rule that may answer
};

/// Immutable definition of a solver; shared by all instances of a preset.
class SolverDef
{
public:
    virtual ~SolverDef() = default;
    /// Creates a solver with all memory that it needs at this quality.
    virtual std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                           std::pmr::memory_resource* memory) const = 0;
    /// Upper bound on elements alive at once, at medium quality.
    virtual uint32_t capacity() const = 0;
    /// Whether its solvers publish groups of `kind`.
    virtual bool publishes(const base::KindDesc& kind) const = 0;
    /// Whether its published media refract light (heat shimmer).
    virtual bool bendsLight() const { return false; }
    /// Program by which the GPU replaces the solvers; null if this is impossible or disabled. [any thread]
    virtual std::shared_ptr<const base::GpuParticleProgram> gpuProgram() const { return nullptr; }
    /// Influence of the instance's past, without that of the host's parameters.
    virtual Influence influence() const { return {.seconds = std::numeric_limits<float>::infinity()}; }
    /// [byte] maximum memory of a solver, at medium quality.
    virtual uint64_t bytes() const { return 0; }
    /// True when its solvers depend on StepContext::collider.
    virtual bool collides() const { return false; }
    /// True when its solvers depend on StepContext::placement.
    virtual bool dependsOnPlacement() const { return false; }
    /// True when its solvers depend on StepContext::thermals.
    virtual bool followsThermals() const { return false; }
    /// Catch-up policy of hidden instances, unless the preset defines one.
    virtual CatchUp catchUp() const { return CatchUp::Replay; }
    /// [m] upper bound of the distance of elements, radius included, from the instance's origin within
    /// `seconds` after the start; infinite when unknown.
    /// @param gravity [m/s2] magnitude @param wind [m/s] magnitude
    virtual float reach(float /*gravity*/, float /*wind*/, float /*seconds*/) const
    {
        return std::numeric_limits<float>::infinity();
    }
    /// As reach(), for solvers whose births are caused by events.
    /// @param births bounds of its births @param ioOthers bounds of births by solver index; extended by the
    ///         births that it causes in other solvers
    virtual float reachFrom(const ReachConditions& conditions, const BirthReach& /*births*/,
                            std::span<BirthReach> /*ioOthers*/) const
    {
        return reach(conditions.gravity, conditions.wind, conditions.seconds);
    }
    /// [unit] of base::WorkBudget: estimated work of the most expensive step, at medium quality.
    virtual double workOf(const StepLoad& /*load*/) const { return 0.0; }
};

} // namespace fx::sim
