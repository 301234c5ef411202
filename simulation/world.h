/// @file world.h
/// Holds the solvers of the instances that exist and steps those it is told to, and nothing else.
///
/// Threads: one thread at a time (the scene thread). Work inside a step is spread over the task runner.
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/memory/arena.h"
#include "simulation/effect_def.h"

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
};

/// What all instances of a world share.
struct Environment
{
    glm::vec3 gravity{0.0f, -9.80665f, 0.0f}; ///< [m/s2] world
    bool hasGround = true;                    ///< false: no effect has a ground, whatever its preset says
};

/// Index of an instance inside the world; valid until removed.
using Slot = uint32_t;

class World
{
public:
    World(const base::SnapshotSchema* schema, base::TaskRunner* tasks, std::pmr::memory_resource* memory,
          const Environment& environment = {});

    /// Creates all solvers of `effect`. Strong guarantee: on an exception nothing has changed.
    Slot add(std::shared_ptr<const EffectDef> effect, const InstanceStart& start);
    void remove(Slot slot);

    void setPlacement(Slot slot, const base::Placement& placement);
    void setParameters(Slot slot, const InstanceParameters& parameters);
    /// True at the end of the effect's duration, when all solvers have finished, and when an instance that no
    /// longer emits is empty.
    bool finished(Slot slot, base::Ticks sceneTick) const;
    uint32_t elementCount(Slot slot) const;
    const EffectDef& effect(Slot slot) const;

    /// Steps each slot of `active` from scene time `tick` to `tick + stepTicks`, in the order of the list. A
    /// slot whose start lies inside the step begins at its own start tick; one that starts later is left
    /// alone.
    StepCounters step(std::span<const Slot> active, base::Ticks tick, base::Ticks stepTicks);

    /// Writes the groups of each slot of `active`, in the order of the list.
    void publish(std::span<const Slot> active, base::FrameSnapshot& snapshot) const;

private:
    struct Instance
    {
        std::shared_ptr<const EffectDef> effect;
        InstanceStart start;
        std::vector<std::unique_ptr<Solver>> solvers;
        bool used = false;
    };

    Environment environment_;
    const base::SnapshotSchema* schema_;
    base::TaskRunner* tasks_;
    std::pmr::memory_resource* memory_;
    base::Arena scratch_;
    std::vector<Instance> instances_;
    std::vector<Slot> free_;
};

} // namespace fx::sim
