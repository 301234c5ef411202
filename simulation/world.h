/// @file world.h
/// Holds the instances that exist and steps those it is told to, and nothing else.
///
/// Instances that must come out alike are simulated once: same effect, seed, start and quality, same
/// intensity and emission, same gravity and wind in local space; and the same placement, when they meet the
/// geometry of the host. Each is published at its own placement.
/// Nobody can tell from the results: when one of them is changed, its state is copied first.
///
/// Threads: one thread at a time (the scene thread). Work inside a step is spread over the task runner.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/arena.h"
#include "simulation/effect_def.h"
#include "simulation/run_pool.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::sim {

/// How an instance enters the world.
struct InstanceStart
{
    uint64_t instance = 0; ///< identity, unique while the instance lives
    uint64_t seed = 0;
    base::Ticks startTick = 0; ///< scene time of local tick 0
    base::Placement placement;
    InstanceParameters parameters;
    QualityLevel quality = QualityLevel::Medium; ///< for life
};

/// What all instances of a world share.
struct Environment
{
    glm::vec3 gravity{0.0f, -9.80665f, 0.0f};     ///< [m/s2] world
    bool hasGround = true;                        ///< false: no effect has a ground, whatever its preset says
    std::shared_ptr<const DistanceField> field{}; ///< geometry of the host; null for none
};

/// Index of an instance inside the world; valid until removed.
using Slot = uint32_t;

class World
{
public:
    /// @param share false: every instance is simulated by itself
    World(const base::SnapshotSchema* schema, base::TaskRunner* tasks, std::pmr::memory_resource* memory,
          const Environment& environment = {}, bool share = true);

    /// Creates all solvers of `effect`. Strong guarantee: on an exception nothing has changed.
    Slot add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start);
    void remove(Slot slot);

    const Environment& environment() const { return environment_; }
    /// Exchanges the geometry of the host, from the next step on; null for none. Strong guarantee; needs
    /// memory when instances at different places were simulated as one.
    void setField(std::shared_ptr<const DistanceField> field);

    // Strong guarantee; both may need memory when the instance no longer comes out like others.
    void setPlacement(Slot slot, const base::Placement& placement);
    void setParameters(Slot slot, const InstanceParameters& parameters);
    /// True at the end of the effect's duration, when all solvers have finished, and when an instance that no
    /// longer emits is empty.
    bool finished(Slot slot, base::Ticks sceneTick) const;
    uint32_t elementCount(Slot slot) const;
    const EffectDef& effect(Slot slot) const;
    uint32_t simulations() const { return runs_.count(); } ///< at most one an instance

    /// Steps each slot of `active` from scene time `tick` to `tick + stepTicks`, in the order of the list. A
    /// slot whose start lies inside the step begins at its own start tick; one that starts later is left
    /// alone.
    StepCounters step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks);

    /// Writes the groups of each slot of `active`, in the order of the list.
    void publish(std::span<const Slot> active, base::FrameSnapshot& snapshot) const;

    /// Hash of the states behind `slots`; the same for shared and unshared ones.
    uint64_t hash(std::span<const Slot> slots) const;
    /// Writes the states behind `slots`, each once.
    void save(std::span<const Slot> slots, StateWriter& writer) const;

    /// An instance to be restored: what add() would be given.
    struct Entry
    {
        std::shared_ptr<const EffectDef> effect;
        InstanceStart start;
    };
    /// Fills an empty world with instances in the order in which save() was given them.
    /// @param outSlots as many as `entries`
    /// After a failure, kept by the reader, the world may only be destroyed.
    void restore(std::span<const Entry> entries, StateReader& reader, std::span<Slot> outSlots);
    /// Exchanges all instances with a world of the same schema, memory and environment.
    void swap(World& other) noexcept;

private:
    struct Instance
    {
        InstanceStart start;
        RunIndex run = kNoRun;
    };

    RunConditions conditionsOf(const EffectDef& effect, const InstanceStart& start) const;
    Slot takeSlot(const InstanceStart& start, RunIndex run);
    /// The run of an instance becomes one that has the conditions of `start`.
    void change(Slot slot, const InstanceStart& start);
    void divideByPlacement();
    void divideRuns(std::span<const Slot> active);
    void stepRun(RunIndex index, base::Ticks tick, base::Ticks stepTicks, StepCounters& counters);
    RunIndex restoreRun(const Entry& first, StateReader& reader);
    RunIndex joinRun(RunIndex index, const Entry& entry, StateReader& reader);

    Environment environment_;
    const base::SnapshotSchema* schema_;
    base::TaskRunner* tasks_;
    std::pmr::memory_resource* memory_;
    bool share_;
    base::Arena scratch_;
    RunPool runs_;
    std::vector<Instance> instances_;
    std::vector<Slot> free_;
    uint64_t stepNumber_ = 0;
};

} // namespace fx::sim
