/// @file scene.h
/// The instance table over the simulated world: who exists, who is stepped, and what views get to see.
///
/// Threads: one thread at a time (the scene thread); acquire() and release() from any thread.
#pragma once

#include "foundation/snapshot/snapshot_ring.h"
#include "foundation/time/step_clock.h"
#include "fxsdk/activation/active_list.h"
#include "fxsdk/activation/wake_queue.h"
#include "fxsdk/scene/id_table.h"
#include "simulation/world.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <memory_resource>
#include <mutex>

namespace fx::scene {

struct SceneOptions
{
    base::Ticks stepTicks = base::kTicksPerSecond / 60;
    base::Ticks maxFrameTicks = base::kTicksPerSecond / 15;
    uint32_t maxInstances = 65'536;
    sim::Environment environment;
    bool shareInstances = true; ///< false: identical instances are simulated one by one
};

/// Where an instance is in its life. Dormant and finished ones have no slot in the world and are never
/// visited.
enum class InstanceState : uint32_t
{
    Dormant,
    Active,
    Finished,
};

/// How an instance starts, checked by the caller.
struct InstanceSetup
{
    std::shared_ptr<const sim::EffectDef> effect;
    uint64_t seed = 0;
    base::Ticks startTick = 0; ///< what is past means the next step
    base::Placement placement;
    sim::InstanceParameters parameters;
    bool destroyWhenFinished = false;
    sim::QualityLevel quality = sim::QualityLevel::Medium;
};

/// Exact counts since the scene was created, unless they say "now".
struct SceneCounters
{
    uint32_t instances = 0;   ///< now; the sum of the next three
    uint32_t dormant = 0;     ///< now
    uint32_t active = 0;      ///< now
    uint32_t finished = 0;    ///< now
    uint32_t simulations = 0; ///< now; at most `active`: identical instances share one
    uint64_t steps = 0;
    uint64_t wakeFailures = 0;
    uint64_t refusedUpdates = 0;
    base::Ticks droppedTicks = 0;
    sim::StepCounters work;
};

/// What a view draws: two steps and the moment between them.
struct Presentation
{
    base::SnapshotPair snapshots;
    double interpolation = 0; ///< [0, 1), 0 shows the older
    double time = 0;          ///< [s] scene time of the moment shown
};

class Scene
{
public:
    Scene(const SceneOptions& options, const base::SnapshotSchema* schema, base::TaskRunner* tasks,
          std::pmr::memory_resource* memory);

    /// Strong guarantee, also when memory runs out. @return 0 when the scene is full
    LocalId add(InstanceSetup setup);
    bool contains(LocalId id) { return instances_.find(id) != nullptr; }

    // The id must name an instance of this scene.
    void remove(LocalId id);
    InstanceState state(LocalId id) { return instances_.find(id)->state; }
    uint32_t particles(LocalId id);
    void setPlacement(LocalId id, const base::Placement& placement);
    void setParameters(LocalId id, const sim::InstanceParameters& parameters);

    /// Exchanges the geometry that effects collide with; null for none. Strong guarantee.
    /// @param cellSize see sim::DistanceField::build
    /// @return what building the field fails with
    base::Status setCollisionMesh(const sim::TriangleMesh* mesh, float cellSize);

    /// Advances by dt [s] and publishes the last two of the steps taken.
    /// Throws std::bad_alloc after all steps when memory ran out in one: time has advanced, and what needed
    /// the memory is missing.
    /// @return false when dt was negative or not finite; then only the counter of refusals has changed
    bool update(double dt);

    SceneCounters counters() const;
    uint32_t particles() const; ///< of all active instances
    const base::StepClock& clock() const { return clock_; }
    uint64_t stateHash(); ///< of what is to be seen of the last step

    /// Hash of everything that decides what later steps give; apart from the part of a step that has not been
    /// taken yet, so that it does not depend on the frame rate.
    uint64_t simulationHash() const;
    /// Writes all that restore() needs.
    void save(sim::StateWriter& writer) const;
    /// Finds the effect of a fingerprint among those that no instance has any more; null when there is none.
    using FindEffect = std::function<std::shared_ptr<const sim::EffectDef>(uint64_t fingerprint)>;
    /// Takes the state of a scene with the same step, gravity, ground and geometry, identities included, and
    /// publishes it. Strong guarantee.
    /// @return Parse, NotFound (an effect), InvalidArgument (another step, gravity, ground or
    /// geometry), Capacity
    base::Status restore(std::span<const std::byte> bytes, const FindEffect& findEffect);
    /// Calls f(id) for each instance by ascending index.
    template <class F>
    void forEach(F&& f) const
    {
        instances_.forEach([&](uint32_t index, const Instance&) { f(instances_.idAt(index)); });
    }

    Presentation acquire();
    void release(const base::SnapshotPair& snapshots) { ring_.release(snapshots); }

private:
    struct Instance
    {
        InstanceSetup setup;
        uint64_t serial = 0; ///< order of creation
        sim::Slot slot = 0;  ///< in the world, while active
        InstanceState state = InstanceState::Finished;
    };
    struct Restored; ///< a state on its way into the scene

    void wake(base::Ticks until);
    void enterWorld(uint32_t index);
    void step(base::Ticks from);
    void retireFinished(base::Ticks now);
    void finish(uint32_t index);
    void publish(base::Ticks tick, double interpolation);
    void show(base::Ticks newest, double interpolation); ///< with presentation_ held
    static sim::InstanceStart startOf(const IdTable<Instance>& instances, uint32_t index);

    using Effects = std::vector<std::shared_ptr<const sim::EffectDef>>;
    Effects effects() const; ///< each once, in the order of first use
    void saveRules(sim::StateWriter& writer) const;
    void saveInstances(sim::StateWriter& writer) const;
    void checkRules(sim::StateReader& reader) const;
    Effects restoreEffects(sim::StateReader& reader, const FindEffect& findEffect) const;
    base::ClockState restoreClock(sim::StateReader& reader) const;
    void restoreInstances(sim::StateReader& reader, const Effects& effects, Restored& state) const;
    void restoreWorld(sim::StateReader& reader, Restored& state) const;
    void take(Restored& state);

    const SceneOptions options_;
    const base::SnapshotSchema* schema_;
    base::TaskRunner* tasks_;
    std::pmr::memory_resource* memory_;
    base::StepClock clock_;
    sim::World world_;
    IdTable<Instance> instances_;
    activation::WakeQueue dormant_;
    activation::ActiveList active_;
    base::SnapshotRing ring_;
    SceneCounters counters_;
    uint64_t nextSerial_ = 0;

    std::mutex presentation_; ///< makes publication and the members below one change for acquire()
    double interpolation_ = 0;
    double shownTime_ = 0;
};

} // namespace fx::scene
