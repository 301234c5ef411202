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

/// Policy for a hidden instance: how its state is brought to the present when the instance becomes visible
/// again.
enum class CatchUp : uint8_t
{
    Analytic, ///< not simulated; the present is computed directly, with the bits of an unbroken simulation
    /// not simulated while hidden; the missing steps are taken later, some in each frame, with the same bits
    Replay,
    /// simulated while hidden, in steps of four times the length at fixed ticks; deterministic, but with
    /// other bits
    Coarse,
    Skip,          ///< not simulated while hidden; the missing time is skipped: particles age without moving
    Authoritative, ///< always simulated
};

/// Whether hiding an instance leaves its later state unchanged, bit for bit.
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
};

/// Counts of the work of a step. They are exact, not times.
struct StepCounters
{
    uint64_t born = 0;
    uint64_t dropped = 0;       ///< number of births that were dropped because a capacity was full
    uint64_t particleSteps = 0; ///< number of particles advanced, summed over sub-steps
    uint64_t neighborPairs = 0;
    uint64_t subSteps = 0;
    uint64_t clamped = 0; ///< number of values that were limited to keep the state finite
    base::Ticks debt = 0; ///< time that is not simulated, because the limit of sub-steps was reached
    /// number of events of particles, each counted once for each rule that may apply to it
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
    /// The counts since an earlier state `before` of these counters.
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

/// Geometry of the host behind a callback. The callback is called for the path of each particle that collides
/// with it.
struct ContactHook
{
    void* user = nullptr;
    /// Intersects the segment from `from` to `to` [m, local] with the geometry. Returns 0 when the segment is
    /// free. Otherwise returns another number, the share of the path before the contact, 0..1, and the
    /// normal, of any length. Called by several threads at once. Equal arguments must give equal results
    /// during a step.
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

/// An event that the host has triggered.
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
    uint32_t solverIndex;     ///< index of the solver in the effect; part of the key of every random number
    glm::vec3 gravity;        ///< [m/s2] local
    glm::vec3 wind;           ///< [m/s] local
    float groundHeight;       ///< [m] local y of the ground plane; -infinity for none
    const Collider* collider; ///< the host's geometry; null for none
    /// intensity and emission; its wind is already part of `wind`
    const InstanceParameters* parameters;
    base::TaskRunner* tasks;
    base::Arena* scratch; ///< freed after the step
    StepCounters* counters;
    const ContactHook* contactHook = nullptr; ///< null for none
    EventBoard* board = nullptr;              ///< events between solvers in this step; null: there are none
    std::span<const HostEvent> hostEvents{};  ///< host events, which happen at `tick`
    /// batch to which births may be deferred until the end of the step; null: births are computed at once
    SpawnBatch* spawnBatch = nullptr;
    /// placement that the instance moves to; identity unless the effect depends on the placement
    base::Placement placement{};
    /// [1] share of the remaining motion to `placement` that takes place in this step, 0..1
    float moveShare = 1.0f;
    glm::vec3 worldGravity{0.0f}; ///< [m/s2] world
    /// [m/s] the host's share of `wind`, in world space; 0 unless the effect depends on the placement
    glm::vec3 worldWind{0.0f};
    glm::vec3 effectWind{0.0f}; ///< [m/s] the preset's share of `wind`, in local space
    /// air flows of the effect's gases, for solvers that follow them
    std::span<const ThermalFlow> thermals{};
    bool gpuParticles = false; ///< true: emitters that the GPU can compute need not be computed as rows

    float seconds() const { return float(base::toSeconds(stepTicks)); }
};

class AirMover;
class BudgetedSolver;
class FiniteMemorySolver;
class PooledEmitter;
class SeekableSolver;

/// The changing state of one part of an instance, such as an emitter or a gas.
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

    /// Whether no element is alive and none will be born from local time `tick` on.
    virtual bool finished(base::Ticks tick) const = 0;

    virtual uint32_t elementCount() const = 0;

    /// Whether elementCount() is above 0. An implementation may be faster than counting.
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

/// Conditions on which the upper bound of distances depends.
struct ReachConditions
{
    float gravity = 0; ///< [m/s2] magnitude
    float wind = 0;    ///< [m/s] magnitude
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
    /// [s] time, in the time of the instance, after which the past has no influence; infinite if unknown
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

/// Expected amounts of a step of a solver, from which its work is estimated.
struct StepLoad
{
    double seconds;    ///< [s] length
    double births = 0; ///< number of births of an emitter, including those caused by events
    double alive = 0;  ///< number of living particles of an emitter, at most its capacity
    /// number of events of an emitter's particles, each counted once for each rule that may apply to it
    double events = 0;
};

/// Immutable definition of a solver; shared by all instances of a preset.
class SolverDef
{
public:
    virtual ~SolverDef() = default;
    /// Creates a solver with all memory that it needs at this quality.
    virtual std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                           std::pmr::memory_resource* memory) const = 0;
    /// Maximum number of simultaneously alive elements, at medium quality.
    virtual uint32_t capacity() const = 0;
    /// Whether its solvers publish groups of `kind`.
    virtual bool publishes(const base::KindDesc& kind) const = 0;
    /// Whether its published media refract light (heat shimmer).
    virtual bool bendsLight() const { return false; }
    /// Program by which the GPU replaces the solvers; null if this is impossible or disabled. [any thread]
    virtual std::shared_ptr<const base::GpuParticleProgram> gpuProgram() const { return nullptr; }
    /// Influence of the past of an instance, without that of the host's parameters.
    virtual Influence influence() const { return {.seconds = std::numeric_limits<float>::infinity()}; }
    /// [byte] maximum memory of a solver, at medium quality.
    virtual uint64_t bytes() const { return 0; }
    /// Whether its solvers depend on StepContext::collider.
    virtual bool collides() const { return false; }
    /// Whether its solvers depend on StepContext::placement.
    virtual bool dependsOnPlacement() const { return false; }
    /// Whether its solvers depend on StepContext::thermals.
    virtual bool followsThermals() const { return false; }
    /// Policy of hidden instances, unless the preset defines one.
    virtual CatchUp catchUp() const { return CatchUp::Replay; }
    /// [m] Upper bound of the distance of elements, radius included, from the instance's origin within
    /// `seconds` after the start; infinite when unknown.
    /// @param gravity [m/s2] magnitude of gravity
    /// @param wind [m/s] magnitude of the wind
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
    /// [unit of base::WorkBudget] Estimated work of the most expensive step, at medium quality.
    virtual double workOf(const StepLoad& /*load*/) const { return 0.0; }
};

} // namespace fx::sim
