/// @file stage.h
/// A small world for tests, with one schema, one memory resource, one task runner and steps of 1/60 s.
#pragma once

#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/world/world.h"

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace fx::test {

constexpr base::Ticks kStep = base::kTicksPerSecond / 60;

class Stage
{
public:
    explicit Stage(std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner())
        : tasks_(std::move(tasks)), world_(&schema_, tasks_.get(), &memory_), snapshot_(&schema_, &memory_)
    {}

    /// Adds an instance of an effect that consists of the given solvers, without ground.
    template <class... Defs>
    sim::Slot add(const sim::InstanceStart& start, std::unique_ptr<Defs>... defs)
    {
        auto effect = std::make_shared<sim::EffectDef>();
        effect->hasGround = false;
        (effect->solvers.push_back(std::move(defs)), ...);
        return add(start, std::move(effect));
    }
    sim::Slot add(const sim::InstanceStart& start, std::shared_ptr<const sim::EffectDef> effect)
    {
        slots_.push_back(world_.add(std::move(effect), start));
        return slots_.back();
    }

    /// Steps all instances by `ticks` and adds the counts to the counters.
    void step(base::Ticks ticks = kStep)
    {
        counters_ += world_.step(slots_, now_, ticks);
        now_ += ticks;
    }
    void play(int steps)
    {
        for (int i = 0; i < steps; ++i)
            step();
    }

    /// Publishes the present state.
    const base::FrameSnapshot& look()
    {
        snapshot_.begin(now_, 1);
        world_.publish(slots_, snapshot_);
        return snapshot_;
    }

    sim::World& world() { return world_; }
    base::HostMemory& memory() { return memory_; }
    base::Ticks now() const { return now_; }
    const sim::StepCounters& counters() const { return counters_; }

private:
    static base::SnapshotSchema kinds()
    {
        base::SnapshotSchema schema;
        schema.add(base::kBlobKind);
        schema.add(base::kParticleKind);
        schema.add(base::kMaterialKind);
        return schema;
    }

    base::SnapshotSchema schema_ = kinds();
    base::HostMemory memory_;
    std::unique_ptr<base::TaskRunner> tasks_;
    sim::World world_;
    base::FrameSnapshot snapshot_;
    std::vector<sim::Slot> slots_;
    sim::StepCounters counters_;
    base::Ticks now_ = 0;
};

/// An emitter of `count` particles with a long lifetime, all born at local time 0.
inline std::unique_ptr<sim::EmitterDef> burstEmitter(uint32_t count)
{
    auto def = std::make_unique<sim::EmitterDef>();
    def->emission.bursts = {{0.0f, count}};
    def->lifetime = {1000.0f, 1000.0f};
    return def;
}

/// An emitter with a constant rate, without end.
inline std::unique_ptr<sim::EmitterDef> rateEmitter(float rate, float lifetime = 1000.0f)
{
    auto def = std::make_unique<sim::EmitterDef>();
    def->emission.rate = rate;
    def->emission.duration = std::numeric_limits<float>::infinity();
    def->lifetime = {lifetime, lifetime};
    return def;
}

} // namespace fx::test
