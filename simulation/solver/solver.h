/// @file solver.h
/// Interface of a simulation technique: an immutable definition, built from a preset, and a solver per
/// instance. Optional capabilities have separate interfaces: budgeted_solver.h, seekable_solver.h,
/// finite_memory_solver.h, and emitters/pools/pooled_emitter.h.
///
/// Solvers work in the instance's local space. Tick 0 of the local time is the start of the instance.
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

/// Policy for a hidden instance. It defines how the state is advanced to the present when the instance
/// becomes visible again.
enum class CatchUp : uint8_t
{
    Analytic, ///< not simulated while hidden; the present state is computed directly, with the same bits as
              ///< without hiding
    /// not simulated while hidden; the missing steps are executed later, some in each frame, with the same
    /// bits as without hiding
    Replay,
    /// simulated while hidden, in steps of four times the length at fixed ticks; deterministic, but with
    /// different bits than a visible instance
    Coarse,
    Skip,          ///< not simulated while hidden; particles then age by the missing time without moving
    Authoritative, ///< always simulated
};

/// True if hiding an instance does not change a bit of its later state.
constexpr bool isExact(CatchUp policy)
{
    return policy == CatchUp::Analytic || policy == CatchUp::Replay || policy == CatchUp::Authoritative;
}

constexpr int64_t kCoarseSteps = 4; ///< number of steps of the scene in one step of CatchUp::Coarse

/// Parameters of a running instance.
struct InstanceParameters
{
    float intensity = 1.0f; ///< [1] factor on future birth rates and injected energies, >= 0
    glm::vec3 wind{0.0f};   ///< [m/s] world wind that is added to the effect's own wind
    bool emitting = true;   ///< false: there are no births; existing elements continue
    glm::vec3 tint{1.0f};   ///< [1] factor of emitted and scattered light, 0..1, see instance-tint

    bool isTinted() const { return tint != glm::vec3(1.0f); }
};

/// Counts of the work of a step.
struct StepCounters
{
    uint64_t born = 0;
    uint64_t dropped = 0;       ///< number of births that were dropped because a capacity was full
    uint64_t particleSteps = 0; ///< number of particles advanced, summed over sub-steps
    uint64_t neighborPairs = 0;
    uint64_t subSteps = 0;
    uint64_t clamped = 0; ///< number of values that were limited to keep the state finite
    base::Ticks debt = 0; ///< time that is not simulated, because the limit of sub-steps was reached
    /// number of pairs of an event of a particle and a rule that may apply to the event
    uint64_t events = 0;

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
    /// The difference between these counters and their earlier state `before`.
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

/// Geometry of the host behind a callback. The callback is called for the path of each particle that may
/// collide with the geometry.
struct ContactHook
{
    void* user = nullptr;
    /// Intersects the segment from `from` to `to` [m, local] with the geometry. Returns 0 if there is no
    /// intersection. If there is one, returns a number other than 0, the fraction of the path before the
    /// contact, 0..1, and the normal, of any length. Several threads call the function at the same time.
    /// Equal arguments must give equal results during a step.
    int (*meet)(void* user, const float from[3], const float to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

/// The host's contact callback, in world space.
struct HostContact
{
    void* user = nullptr;
    int (*meet)(void* user, const double from[3], const double to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

class SpawnBatch;
class EventBoard;
class CueSink;

/// An event that the host has triggered.
struct HostEvent
{
    uint32_t event; ///< index in EffectDef::hostEvents
    uint32_t count; ///< number of times that the event was triggered
};

/// Input of a solver for one step.
struct StepContext
{
    base::Ticks tick;         ///< local time at which the step begins
    base::Ticks stepTicks;    ///< length of the step, > 0
    uint64_t seed;            ///< seed of the instance
    uint32_t solverIndex;     ///< index of the solver in the effect; part of the key of every random number
    glm::vec3 gravity;        ///< [m/s2] gravity in local space
    glm::vec3 wind;           ///< [m/s] wind in local space
    float groundHeight;       ///< [m] local y of the ground plane; -infinity: no ground
    const Collider* collider; ///< the host's geometry; null: no geometry
    /// intensity and emission; the wind of these parameters is already part of `wind`
    const InstanceParameters* parameters;
    base::TaskRunner* tasks;
    base::Arena* scratch; ///< freed after the step
    StepCounters* counters;
    const ContactHook* contactHook = nullptr; ///< the host's contact callback; null: no callback
    EventBoard* board = nullptr;              ///< events between solvers in this step; null: no events
    CueSink* cues = nullptr; ///< receives the events that the host wants to know; null: none are reported
    std::span<const HostEvent> hostEvents{}; ///< host events, which happen at `tick`
    /// batch to which births may be deferred until the end of the step; null: births are computed at once
    SpawnBatch* spawnBatch = nullptr;
    /// placement to which the instance moves; identity unless the effect depends on the placement
    base::Placement placement{};
    /// [1] fraction of the remaining motion to `placement` that takes place in this step, 0..1
    float moveShare = 1.0f;
    glm::vec3 worldGravity{0.0f}; ///< [m/s2] gravity in world space
    /// [m/s] part of `wind` that the host sets, in world space; 0 unless the effect depends on the placement
    glm::vec3 worldWind{0.0f};
    glm::vec3 effectWind{0.0f}; ///< [m/s] part of `wind` that the preset sets, in local space
    /// air flows of the effect's gases, for solvers that depend on these flows
    std::span<const ThermalFlow> thermals{};
    bool gpuParticles = false; ///< true: the CPU need not compute emitters that the GPU can compute

    float seconds() const { return float(base::toSeconds(stepTicks)); }
};

class AirMover;
class BudgetedSolver;
class FiniteMemorySolver;
class PooledEmitter;
class SeekableSolver;

/// The state of one part of an instance, such as an emitter or a gas.
class Solver
{
public:
    virtual ~Solver() = default;

    /// Advances by one fixed step. Equal calls give equal bits for any number of threads. The function
    /// allocates only scratch memory.
    virtual void step(const StepContext& context) = 0;

    /// Adds the visible groups to `snapshot`. `base` has instance, solver and placement to copy into each
    /// group. A solver without elements also adds its group, so that the memory of the group exists before
    /// the first birth.
    virtual void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const = 0;

    /// True if no element is alive at local time `tick`, and no element will be born later.
    virtual bool finished(base::Ticks tick) const = 0;

    virtual uint32_t elementCount() const = 0;

    /// True if elementCount() is above 0. An override may be faster than elementCount().
    virtual bool hasElements() const { return elementCount() > 0; }

    /// Writes exactly the data on which later steps and publications depend. Therefore equal states write
    /// equal bytes.
    virtual void save(StateWriter& writer) const = 0;

    /// Restores the state of a solver of the same definition and quality; later results have the same bits.
    /// Validates all data. After a failure, which the reader records, the solver may only be destroyed.
    virtual void restore(StateReader& reader) = 0;

    // Optional interfaces; null if the solver does not have the interface.

    virtual const AirMover* airMover() const { return nullptr; }
    virtual BudgetedSolver* budgeted() { return nullptr; }
    virtual SeekableSolver* seekable() { return nullptr; }
    virtual FiniteMemorySolver* finiteMemory() { return nullptr; }
    virtual PooledEmitter* pooledEmitter() { return nullptr; }
};

/// Conditions on which the upper bound of distances depends.
struct ReachConditions
{
    float gravity = 0; ///< [m/s2] magnitude of gravity
    float wind = 0;    ///< [m/s] magnitude of the wind
    float seconds = 0; ///< [s] time since the start of the instance
};

/// Upper bounds of the births that events of other solvers cause.
struct BirthReach
{
    float distance = 0; ///< [m] largest distance of a birth from the origin
    float speed = 0;    ///< [m/s] largest inherited speed

    void add(const BirthReach& more)
    {
        distance = std::max(distance, more.distance);
        speed = std::max(speed, more.speed);
    }
};

/// Influence of the past of an instance on its living elements.
struct Influence
{
    /// [s] local time span after which the past has no influence; infinite if unknown
    float seconds = 0;
    float inherits = 0; ///< [1] fraction of the instance's velocity that particles inherit
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

/// Expected amounts of a step of a solver, from which its work is estimated.
struct StepLoad
{
    double seconds;    ///< [s] length of the step
    double births = 0; ///< number of births of an emitter, including births caused by events
    double alive = 0;  ///< number of living particles of an emitter, at most its capacity
    /// number of pairs of an event of the emitter's particles and a rule that may apply to the event
    double events = 0;
};

/// Immutable definition of a solver; shared by all instances of a preset.
class SolverDef
{
public:
    virtual ~SolverDef() = default;
    /// Creates a solver, and allocates all memory that it needs at this quality.
    virtual std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                           std::pmr::memory_resource* memory) const = 0;
    /// Maximum number of simultaneously alive elements, at medium quality.
    virtual uint32_t capacity() const = 0;
    /// True if solvers of this definition publish groups of `kind`.
    virtual bool publishes(const base::KindDesc& kind) const = 0;
    /// True if the published media refract light (heat shimmer).
    virtual bool bendsLight() const { return false; }
    /// Program by which the GPU replaces the solvers; null if this is impossible or disabled. [any thread]
    virtual std::shared_ptr<const base::GpuParticleProgram> gpuProgram() const { return nullptr; }
    /// Influence of the past of an instance, without the influence of the host's parameters.
    virtual Influence influence() const { return {.seconds = std::numeric_limits<float>::infinity()}; }
    /// [byte] maximum memory of a solver, at medium quality.
    virtual uint64_t bytes() const { return 0; }
    /// True if the solvers have elements at the start of an instance, before the first step, and move them.
    /// Such solvers are seekable, also to times before the start.
    virtual bool startsInMotion() const { return false; }
    /// True if the solvers depend on StepContext::collider.
    virtual bool collides() const { return false; }
    /// True if the solvers depend on StepContext::placement.
    virtual bool dependsOnPlacement() const { return false; }
    /// True if the solvers depend on StepContext::thermals.
    virtual bool followsThermals() const { return false; }
    /// Policy of hidden instances, unless the preset defines one.
    virtual CatchUp catchUp() const { return CatchUp::Replay; }
    /// [m] Upper bound of the distance of elements from the instance's origin within `seconds` after the
    /// start. The radius of elements is included. The bound is infinite if unknown.
    /// @param gravity [m/s2] magnitude of gravity
    /// @param wind [m/s] magnitude of the wind
    virtual float reach(float /*gravity*/, float /*wind*/, float /*seconds*/) const
    {
        return std::numeric_limits<float>::infinity();
    }
    /// Computes reach() for solvers whose births are caused by events.
    /// @param births bounds of the births of this solver @param ioOthers bounds of births by solver index;
    ///         extended by the births that this solver causes in other solvers
    virtual float reachFrom(const ReachConditions& conditions, const BirthReach& /*births*/,
                            std::span<BirthReach> /*ioOthers*/) const
    {
        return reach(conditions.gravity, conditions.wind, conditions.seconds);
    }
    /// [unit of base::WorkBudget] Estimated work of the most expensive step, at medium quality.
    virtual double workOf(const StepLoad& /*load*/) const { return 0.0; }
};

} // namespace fx::sim
