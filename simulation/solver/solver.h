/// @file solver.h
/// What a technique of simulation implements: an immutable definition, made from a preset, and a solver per
/// instance. What only some solvers can do stands beside it: budgeted_solver.h, seekable_solver.h,
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
#include "simulation/solver/catch_up.h"
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

/// What the host may change on a running instance.
struct InstanceParameters
{
    float intensity = 1.0f; ///< [1] >= 0, scales birth rates and injected energy of what is still to come
    glm::vec3 wind{0.0f};   ///< [m/s] world, added to the effect's own wind
    bool emitting = true;   ///< false: nothing new is born, what exists lives on
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
    /// What has been done since `before`.
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
    /// Whether the straight way from `from` to `to` [m, local] meets something: 0 when it is free; otherwise
    /// the free share of it, 0..1, and the normal there, of any length. Called by several threads at once;
    /// the same question has to get the same answer through a whole step.
    int (*meet)(void* user, const float from[3], const float to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

/// The same in the world, as the host gives it.
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

/// What a solver gets for one step.
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
    base::Arena* scratch; ///< forgotten after the step
    StepCounters* counters;
    const ContactHook* contactHook = nullptr; ///< null for none
    EventBoard* board = nullptr;              ///< events between solvers in this step; null for none
    std::span<const HostEvent> hostEvents{};  ///< happen at `tick`
    SpawnBatch* spawnBatch = nullptr; ///< may defer births until the end of the step; null: make them at once
    base::Placement placement{}; ///< target of the instance's motion; default unless the effect depends on it
    float moveShare = 1.0f;      ///< [1] of the rest of the way there that it goes in this step, 0..1
    glm::vec3 worldGravity{0.0f}; ///< [m/s2] world
    glm::vec3 worldWind{0.0f};    ///< [m/s] world, the host's share of `wind`; 0 unless placement matters
    glm::vec3 effectWind{0.0f};   ///< [m/s] local, the preset's share of `wind`
    bool gpuParticles = false;    ///< emitters that may be computed on the GPU are not needed as rows

    float seconds() const { return float(base::toSeconds(stepTicks)); }
};

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

    /// Adds what is to be seen to `snapshot`. `base` carries instance, solver and placement to copy into each
    /// group. A solver that holds nothing still adds its group: the memory is then there before the first
    /// element is.
    virtual void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const = 0;

    /// True when nothing is alive and nothing will ever be born again from local time `tick` on.
    virtual bool finished(base::Ticks tick) const = 0;

    virtual uint32_t elementCount() const = 0;

    /// Whether there are any; often without counting them.
    virtual bool hasElements() const { return elementCount() > 0; }

    /// Writes everything that later steps and publications depend on, and nothing else: equal states write
    /// equal bytes.
    virtual void save(StateWriter& writer) const = 0;

    /// Takes the state of a solver of the same definition and quality; from there on it gives the same bits.
    /// Checks whatever could harm it. After a failure, kept by the reader, the solver may only be destroyed.
    virtual void restore(StateReader& reader) = 0;

    // What only some solvers can do: the interface for it, null where the solver lacks it.

    virtual BudgetedSolver* budgeted() { return nullptr; }
    virtual SeekableSolver* seekable() { return nullptr; }
    virtual FiniteMemorySolver* finiteMemory() { return nullptr; }
    virtual PooledEmitter* pooledEmitter() { return nullptr; }
};

/// What decides how far things get.
struct ReachConditions
{
    float gravity = 0; ///< [m/s2] magnitude
    float wind = 0;    ///< [m/s] magnitude
    float seconds = 0; ///< after the start
};

/// Where events of other solvers may give birth.
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

/// For how long, and how, the past of an instance acts on what is alive.
struct Influence
{
    float seconds = 0;  ///< [s] of the instance's time; infinite where it is unknown
    float inherits = 0; ///< [1] share of the instance's velocity that particles keep from their birth
    float extent = 0;   ///< [m] local, of the births of those
    float drawnOut = 0; ///< [s] by which they are drawn longer for their speed

    void add(const Influence& more)
    {
        seconds += more.seconds; // one solver may cause births in another
        inherits = std::max(inherits, more.inherits);
        extent = std::max(extent, more.extent);
        drawnOut = std::max(drawnOut, more.drawnOut);
    }
};

/// What is to be expected of a step of a solver.
struct StepLoad
{
    double seconds;    ///< [s] length
    double births = 0; ///< of emitters: made, those that events cause included
    double alive = 0;  ///< of emitters, at most their capacity
    double events = 0; ///< of emitters: of particles, once for each rule that may answer
};

/// Immutable recipe of a solver; shared by all instances of a preset.
class SolverDef
{
public:
    virtual ~SolverDef() = default;
    /// Allocates all that the solver will ever need at this quality.
    virtual std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                           std::pmr::memory_resource* memory) const = 0;
    /// Upper bound on elements alive at once, at medium quality.
    virtual uint32_t capacity() const = 0;
    /// Whether its solvers publish groups of `kind`.
    virtual bool publishes(const base::KindDesc& kind) const = 0;
    /// Whether what it publishes is hot enough to bend light.
    virtual bool bendsLight() const { return false; }
    /// What the GPU computes instead of its solvers; null where it cannot or shall not. Any thread.
    virtual std::shared_ptr<const base::GpuParticleProgram> gpuProgram() const { return nullptr; }
    /// Of the instance's past, unless the host's parameters say more.
    virtual Influence influence() const { return {.seconds = std::numeric_limits<float>::infinity()}; }
    /// [byte] of memory that a solver takes at the most, at medium quality.
    virtual uint64_t bytes() const { return 0; }
    /// True when its solvers depend on StepContext::collider.
    virtual bool collides() const { return false; }
    /// True when its solvers depend on StepContext::placement.
    virtual bool dependsOnPlacement() const { return false; }
    /// What becomes of it out of sight, unless the preset says.
    virtual CatchUp catchUp() const { return CatchUp::Replay; }
    /// [m] distance from the instance's origin that no element passes within `seconds` after the start, with
    /// its radius; infinite when it is unknown.
    /// @param gravity [m/s2] magnitude @param wind [m/s] magnitude
    virtual float reach(float /*gravity*/, float /*wind*/, float /*seconds*/) const
    {
        return std::numeric_limits<float>::infinity();
    }
    /// The same where events give birth.
    /// @param births in it  @param ioOthers by solver index: gains where it gives birth in others
    virtual float reachFrom(const ReachConditions& conditions, const BirthReach& /*births*/,
                            std::span<BirthReach> /*ioOthers*/) const
    {
        return reach(conditions.gravity, conditions.wind, conditions.seconds);
    }
    /// [unit] of base::WorkBudget, about, that the most expensive step counts, at medium quality.
    virtual double workOf(const StepLoad& /*load*/) const { return 0.0; }
};

} // namespace fx::sim
