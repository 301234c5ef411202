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

/// Policy for a hidden instance: how it reaches the present when it is visible again.
enum class CatchUp : uint8_t
{
    Analytic, ///< not simulated; computed for the present directly, with the bits of an unbroken simulation
    Replay,   ///< not simulated; takes the missing steps later, some each frame, with the same bits
    Coarse,   ///< steps of four times the length, on the schedule of ticks. Deterministic, other bits
    Skip,     ///< not simulated; the missing time is left out: particles grow older where they are
    Authoritative, ///< always simulated
};

/// True when a pause leaves no trace in the state.
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
    base::Ticks debt = 0; ///< time that a solver's budget of sub-steps did not cover: it is not simulated
    uint64_t events = 0;  ///< of particles, once for each rule that may answer

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

/// Geometry behind a function of the host, called for each path of a particle that depends on it.
struct ContactHook
{
    void* user = nullptr;
    /// Intersects the segment from `from` to `to` [m, local]: returns 0 when it is free, otherwise the free
    /// share, 0..1, and the normal, of any length. Called by several threads at once; equal arguments must
    /// give equal results during a step.
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
    uint32_t event; ///< number in EffectDef::hostEvents
    uint32_t count; ///< how often
};

/// Input of a solver for one step.
struct StepContext
{
    base::Ticks tick;                     ///< local time at which the step begins
    base::Ticks stepTicks;                ///< its length, > 0
    uint64_t seed;                        ///< of the instance
    uint32_t solverIndex;                 ///< position in the effect: part of every random key
    glm::vec3 gravity;                    ///< [m/s2] local
    glm::vec3 wind;                       ///< [m/s] local
    float groundHeight;                   ///< [m] local y of the ground plane; -infinity for none
    const Collider* collider;             ///< the host's geometry; null for none
    const InstanceParameters* parameters; ///< intensity and emission; its wind is part of `wind` already
    base::TaskRunner* tasks;
    base::Arena* scratch; ///< freed after the step
    StepCounters* counters;
    const ContactHook* contactHook = nullptr; ///< null for none
    EventBoard* board = nullptr;              ///< events between solvers in this step; null for none
    std::span<const HostEvent> hostEvents{};  ///< happen at `tick`
    SpawnBatch* spawnBatch = nullptr; ///< may defer births until the end of the step; null: make them at once
    base::Placement placement{}; ///< target of the instance's motion; default unless the effect depends on it
    /// [1] 0..1, share of the remaining motion to `placement` that takes place in this step.
    float moveShare = 1.0f;
    glm::vec3 worldGravity{0.0f}; ///< [m/s2] world
    glm::vec3 worldWind{0.0f};    ///< [m/s] world, the host's share of `wind`; 0 unless placement matters
    glm::vec3 effectWind{0.0f};   ///< [m/s] local, the preset's share of `wind`
    std::span<const ThermalFlow> thermals{}; ///< of the effect's gases, for solvers that follow them
    bool gpuParticles = false; ///< emitters that may be computed on the GPU are not needed as rows

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

    /// Advances by one fixed step. Equal calls give equal bits for any number of threads. Allocates nothing
    /// but scratch.
    virtual void step(const StepContext& context) = 0;

    /// Adds the visible groups to `snapshot`. `base` has instance, solver and placement to copy into each
    /// group. A solver without elements also adds its group, so that its memory is allocated before the first
    /// element is born.
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

    // Optional interfaces; null if the solver lacks one.

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
    float seconds = 0; ///< after the start
};

/// Bounds of births caused by events of other solvers.
struct BirthReach
{
    float distance = 0; ///< [m] from the origin, at most
    float speed = 0;    ///< [m/s] that is inherited, at most

    void add(const BirthReach& more)
    {
        distance = std::max(distance, more.distance);
        speed = std::max(speed, more.speed);
    }
};

/// Influence of an instance's past on its living elements.
struct Influence
{
    float seconds = 0;  ///< [s] of the instance's time; infinite if unknown
    float inherits = 0; ///< [1] share of the instance's velocity that particles inherit
    float extent = 0;   ///< [m] local extent of the births of these particles
    float drawnOut = 0; ///< [s] by which sprites are stretched along their velocity

    void add(const Influence& more)
    {
        seconds += more.seconds; // one solver may cause births in another
        inherits = std::max(inherits, more.inherits);
        extent = std::max(extent, more.extent);
        drawnOut = std::max(drawnOut, more.drawnOut);
    }
};

/// Expected load of a step of a solver.
struct StepLoad
{
    double seconds;    ///< [s] length
    double births = 0; ///< of emitters: made, those that events cause included
    double alive = 0;  ///< of emitters, at most their capacity
    double events = 0; ///< of emitters: of particles, once for each rule that may answer
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
    /// Program with which the GPU replaces its solvers; null if this is impossible or disabled. Any thread.
    virtual std::shared_ptr<const base::GpuParticleProgram> gpuProgram() const { return nullptr; }
    /// Influence of the instance's past, without that of the host's parameters.
    virtual Influence influence() const { return {.seconds = std::numeric_limits<float>::infinity()}; }
    /// [byte] of memory that a solver takes at the most, at medium quality.
    virtual uint64_t bytes() const { return 0; }
    /// True when its solvers depend on StepContext::collider.
    virtual bool collides() const { return false; }
    /// True when its solvers depend on StepContext::placement.
    virtual bool dependsOnPlacement() const { return false; }
    /// True when its solvers depend on StepContext::thermals.
    virtual bool followsThermals() const { return false; }
    /// Catch-up policy of hidden instances, unless the preset has one.
    virtual CatchUp catchUp() const { return CatchUp::Replay; }
    /// [m] upper bound of the distance of elements, radius included, from the instance's origin within
    /// `seconds` after the start; infinite when unknown.
    /// @param gravity [m/s2] magnitude @param wind [m/s] magnitude
    virtual float reach(float /*gravity*/, float /*wind*/, float /*seconds*/) const
    {
        return std::numeric_limits<float>::infinity();
    }
    /// reach() for solvers whose births are caused by events.
    /// @param bounds of births in it @param ioOthers by solver index: extended by births that it causes in
    ///         others
    virtual float reachFrom(const ReachConditions& conditions, const BirthReach& /*births*/,
                            std::span<BirthReach> /*ioOthers*/) const
    {
        return reach(conditions.gravity, conditions.wind, conditions.seconds);
    }
    /// [unit] of base::WorkBudget, about, that the most expensive step counts, at medium quality.
    virtual double workOf(const StepLoad& /*load*/) const { return 0.0; }
};

} // namespace fx::sim
