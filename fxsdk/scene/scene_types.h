/// @file scene_types.h
/// What a scene is told, and what it tells: options, states and counters.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "simulation/world/world.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace fx::scene {

struct SceneOptions
{
    base::Ticks stepTicks = base::kTicksPerSecond / 60;
    base::Ticks maxFrameTicks = base::kTicksPerSecond / 15;
    uint32_t maxInstances = 65'536;
    sim::Environment environment;
    bool shareInstances = true; ///< false: identical instances are simulated one by one
    bool culling = true;        ///< false: instances are never hidden
    bool lockStep = false;      ///< true: an instance is hidden only if its catch-up is bit-identical
    /// time out of sight after which the memory of an instance is released
    base::Ticks releaseAfter = 5 * base::kTicksPerSecond;
    base::Ticks maxCatchUp = 30 * base::kTicksPerSecond; ///< longest time out of sight that is replayed
    uint64_t catchUpSteps = 200'000; ///< particle steps that one update may spend on replays
    /// [unit of base::WorkBudget] largest amount of work of one update
    uint64_t workBudget = base::kNoWorkLimit;
    uint32_t eventCapacity = 0; ///< maximum number of events that the host has not read; 0: no events
    bool finishedEvents = true; ///< true: ends of instances are events
    bool cueEvents = true;      ///< true: events with a cue in the preset are recorded
    bool unnamedEvents = false; ///< true: events without a cue that cause births are recorded
    uint64_t reserveLimit = uint64_t(1) << 30; ///< [byte] largest memory of all reservations
};

/// Lifecycle state of an instance. An update visits only active and waking instances.
enum class InstanceState : uint32_t
{
    Dormant,  ///< before its start; not in the world
    Active,   ///< stepped and shown
    Finished, ///< after its end; not in the world
    Waking,   ///< in sight again and catching up
    Resting,  ///< has no particles, and no birth is due yet
    Hidden,   ///< paused, because it is out of sight
};

/// Reason why an instance is not active.
enum class Reason : uint32_t
{
    None,
    NotStarted,
    Outside, ///< outside of all frusta
    TooFar,
    TooSmall,
    Occluded,   ///< marked as occluded by the host
    Budget,     ///< hidden by the budget, because other instances are more significant
    CatchingUp, ///< its missed steps are being simulated
    NothingMoves,
    Ended,
};

/// Local time at which an instance goes on with another effect.
enum class Replacement
{
    Restart, ///< as a new instance that starts now
    Seek,    ///< the local time that the instance has
};

/// An instance in the debug overlay.
struct Mark
{
    glm::dvec3 position; ///< [m] world
    double reach;        ///< [m] world; infinite when unknown
    InstanceState state;
    Reason reason;
};

/// The host's hints about the significance of an instance.
struct ActivationHints
{
    float priority = 1;    ///< [1] factor of the size on the picture
    float maxDistance = 0; ///< [m] largest distance at which the instance is visible; 0: no limit
    bool occluded = false;
};

/// Counters of the last update.
struct UpdateCounters
{
    uint32_t judged = 0;   ///< number of instances and tree nodes that were tested against the frusta
    uint32_t hidden = 0;   ///< number of instances that went out of sight
    uint32_t returned = 0; ///< number of instances that have finished catching up
    uint32_t denied = 0;   ///< present number of instances that are in sight, but hidden by the budget
    base::Ticks catchUpTicks = 0;
    uint64_t catchUpParticleSteps = 0;
    uint64_t workUnits = 0; ///< [unit of base::WorkBudget] work of the update, including catch-ups
    sim::StepCounters work;
};

/// Initial values of an instance. The caller must validate the values.
struct InstanceSetup
{
    std::shared_ptr<const sim::EffectDef> effect;
    uint64_t seed = 0;
    base::Ticks startTick = 0; ///< start; for a past tick, the instance starts with the next step
    base::Placement placement;
    /// Placement at the last step, if the host has moved the instance since the last step. Set only if the
    /// effect depends on its placement.
    std::optional<base::Placement> cameFrom = {};
    uint64_t userData = 0; ///< number of the host
    sim::InstanceParameters parameters;
    bool destroyWhenFinished = false;
    sim::QualityLevel quality = sim::QualityLevel::Medium;
    uint32_t rate = sim::kNormalRate;             ///< see sim::InstanceClock
    std::optional<sim::InstanceClock> clock = {}; ///< set after the host has changed the instance's time
};

/// Exact counts since the scene was created, unless marked "now".
struct SceneCounters
{
    uint32_t instances = 0;   ///< now; sum of the following six counters
    uint32_t dormant = 0;     ///< now
    uint32_t active = 0;      ///< now
    uint32_t finished = 0;    ///< now
    uint32_t waking = 0;      ///< now
    uint32_t resting = 0;     ///< now
    uint32_t hidden = 0;      ///< now
    uint32_t simulations = 0; ///< now; at most `active`, because identical instances share one simulation
    uint64_t steps = 0;
    uint64_t wakeFailures = 0;
    uint64_t refusedUpdates = 0;
    uint64_t catchUpsSkipped = 0; ///< number of times that an instance was hidden too long for a replay
    base::Ticks droppedTicks = 0;
    sim::StepCounters work;
};

/// Input of a view: the snapshots of two steps, and the shown moment between the steps.
struct Presentation
{
    base::SnapshotPair snapshots;
    double interpolation = 0; ///< [0, 1), 0 shows the older step
    double time = 0;          ///< [s] scene time of the picture
    /// Drawing hints of all instances that have not ended. The hints do not depend on the camera.
    sim::DrawingHints hints;
};

} // namespace fx::scene
