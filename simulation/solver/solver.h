/// @file solver.h
/// What a technique of simulation implements: an immutable definition, made from a preset, and a solver per
/// instance.
///
/// Solvers work in the instance's local space. Time is the instance's own: tick 0 is its start.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/arena.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/tasks/task_runner.h"
#include "foundation/tasks/work_budget.h"
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

/// Geometry that only the host knows, asked for each way of a particle that heeds it.
struct ContactHook
{
    void* user = nullptr;
    /// Whether the straight way from `from` to `to` [m, local] meets something: 0 when it is free; otherwise
    /// the free share of it, 0..1, and the normal there, of any length. Called by several threads at once;
    /// the same question has to get the same answer through a whole step.
    int (*meet)(void* user, const float from[3], const float to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

class EmitterCrowd;
class EmitterPools;
struct PoolRequest;
/// The same in the world, as the host gives it.
struct HostContact
{
    void* user = nullptr;
    int (*meet)(void* user, const double from[3], const double to[3], float* outShare,
                float outNormal[3]) = nullptr;
};

class EventBoard;

/// The host says that something happened.
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
    EventBoard* board = nullptr;              ///< what solvers tell each other in this step; null for nothing
    std::span<const HostEvent> hostEvents{};  ///< happen at `tick`
    EmitterCrowd* crowd = nullptr; ///< what is left to it is done before anybody looks; null: do it at once
    base::Placement placement{};   ///< where the instance is going; default unless the effect heeds it
    float moveShare = 1.0f;        ///< [1] of the rest of the way there that it goes in this step, 0..1
    glm::vec3 worldGravity{0.0f};  ///< [m/s2] world
    glm::vec3 worldWind{0.0f};     ///< [m/s] world, the host's share of `wind`; 0 unless placement is heeded
    glm::vec3 effectWind{0.0f};    ///< [m/s] local, the preset's share of `wind`
    bool gpuParticles = false;     ///< emitters that may be computed on the GPU are not needed as rows

    float seconds() const { return float(base::toSeconds(stepTicks)); }
};

/// How far the publication of one solver has come. What its members mean is the solver's own.
struct PublicationPlace
{
    uint32_t group = 0;    ///< of those that it publishes
    uint32_t part = 0;     ///< of the way to that group
    uint32_t row = 0;      ///< of that part
    uint32_t count = 0;    ///< elements that are found or written
    bool isSorted = true;  ///< they are in their order
    base::Bounds bounds{}; ///< of those that are written
    float radius = 0;      ///< [m] likewise the largest
};

/// The changing state of one emitter, one gas, ... of one instance.
class Solver
{
public:
    virtual ~Solver() = default;

    /// Advances by one fixed step. Equal calls give equal bits for any number of threads. Allocates nothing
    /// but scratch.
    virtual void step(const StepContext& context) = 0;
    /// Whether seek() can take it from where it is to local time `tick`.
    virtual bool canSeek(const StepContext&, base::Ticks) const { return false; }
    /// Goes to local time `tick` at once, under the conditions of `context`: forwards as steps from where it
    /// is would, bit for bit, backwards as steps from 0 would. Only where canSeek() holds; the context's own
    /// tick and stepTicks are ignored.
    virtual void seek(const StepContext&, base::Ticks) {}
    /// Local time, at least `tick`, up to which steps from `tick` on change nothing that is seen. canSeek()
    /// holds for any tick up to it.
    virtual base::Ticks restsUntil(base::Ticks tick) const { return tick; }
    /// Local time, at least `tick`, up to which steps from `tick` on, under the conditions of the last one,
    /// do nothing but let time pass, however much of what is seen changes with it: passTo() may stand for
    /// them.
    virtual base::Ticks quietUntil(base::Ticks tick) const { return tick; }
    /// Steps to local time `tick`, at most quietUntil(), that need not be taken.
    virtual void passTo(base::Ticks, StepCounters&) {}
    /// The instance stands at `placement` now, and got there while its own time stood still.
    virtual void standAt(const base::Placement&) {}
    /// Joins a pool of emitters, which computes it from then on until it leaves: meanwhile it is neither
    /// stepped nor published, and all other questions are answered as ever. @return whether it has joined
    virtual bool joinPool(EmitterPools&, const PoolRequest&) { return false; }
    virtual void leavePool() {}
    /// publish(), but what is in the columns may be left to `crowd`. @return false, and nothing has happened,
    /// when it wants nothing of it
    virtual bool joinPublication(const base::GroupInfo&, base::FrameSnapshot&, EmitterCrowd&) const
    {
        return false;
    }
    /// Adds what is to be seen to `snapshot`. `base` carries instance, solver and placement to copy into each
    /// group.
    /// A solver that holds nothing still adds its group: the memory is then there before the first element
    /// is.
    virtual void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const = 0;
    /// True when nothing is alive and nothing will ever be born again from local time `tick` on.
    virtual bool finished(base::Ticks tick) const = 0;
    virtual uint32_t elementCount() const = 0;
    /// Whether there are any; often without counting them.
    virtual bool hasElements() const { return elementCount() > 0; }

    /// Writes everything that later steps and publications depend on, and nothing else: equal states write
    /// equal bytes.
    virtual void save(StateWriter& writer) const = 0;
    /// [tick] of local time after which nothing is left of what lives now, as long as the host's parameters
    /// stay as they are; the largest number where that cannot be told.
    virtual base::Ticks memory(const InstanceParameters&) const
    {
        return std::numeric_limits<base::Ticks>::max();
    }
    /// save() without what lives. What restore() takes from it is right once memory() has passed.
    virtual void saveBriefly(StateWriter& writer) const { save(writer); }
    /// Goes forwards to local time `tick` without those who are born meanwhile: right once memory() has
    /// passed after it. Only where memory() is known; the context's own tick and stepTicks are ignored.
    virtual void passOver(const StepContext&, base::Ticks) {}
    /// Takes the state of a solver of the same definition and quality; from there on it gives the same bits.
    /// Checks whatever could harm it. After a failure, kept by the reader, the solver may only be destroyed.
    virtual void restore(StateReader& reader) = 0;
    /// step() within a budget: spends what the step counts, and where nothing is left before its end,
    /// returns false. Then the same call has to be made again, with an equal context, before any other call
    /// but the destructor; the bits are those of one step(). Scratch memory may be forgotten between the two.
    virtual bool proceed(const StepContext& context, base::WorkBudget& work);
    /// [unit] of base::WorkBudget that what was done in a step counts, for solvers that are not divided.
    virtual uint64_t workOf(const StepCounters& done) const { return done.particleSteps + done.born; }
    /// [unit] that it counts to publish what there is, for solvers whose publication is not divided.
    virtual uint64_t shownWork() const { return 0; }
    /// publish() within a budget: spends what it counts, and where nothing is left before its end, returns
    /// false. Then the same call has to be made again before any other call of the solver, and before another
    /// group is added to `snapshot`; the bits are those of publish().
    /// @param ioPlace as it is made for the first call; then as the call before has left it
    virtual bool proceedPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                    PublicationPlace& /*ioPlace*/, base::WorkBudget& work) const
    {
        publish(base, snapshot);
        work.spend(shownWork());
        return true;
    }
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
    float seconds = 0;  ///< [s] of the instance's time; infinite where it cannot be told
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
    /// True when its solvers heed StepContext::collider.
    virtual bool collides() const { return false; }
    /// True when its solvers heed StepContext::placement.
    virtual bool heedsPlacement() const { return false; }
    /// What becomes of it out of sight, unless the preset says.
    virtual CatchUp catchUp() const { return CatchUp::Replay; }
    /// [m] distance from the instance's origin that no element passes within `seconds` after the start, with
    /// its radius; infinite when it cannot be told.
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
