/// @file block_fixture.h
/// Blocks outside of a world, and what they publish.
#pragma once

#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/block_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "simulation/blocks/blocks_def.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace fx::test {

constexpr base::Ticks kBlockStep = base::kTicksPerSecond / 60;

inline const base::SnapshotSchema& blockSchema()
{
    static const base::SnapshotSchema kinds = [] {
        base::SnapshotSchema made;
        made.add(base::kBlobKind);
        made.add(base::kBlockKind);
        made.add(base::kBlockBallKind);
        made.add(base::kBlockMaterialKind);
        made.add(base::kMaterialKind);
        return made;
    }();
    return kinds;
}

inline sim::ListedBall ballAt(const glm::vec3& center, float radius = 1.0f, float crossSection = 1.0f)
{
    sim::ListedBall ball;
    ball.center = center;
    ball.radius = radius;
    ball.crossSection = crossSection;
    return ball;
}

inline sim::BlockType typeOf(const char* name, sim::BallList balls)
{
    sim::BlockType type;
    type.name = name;
    type.balls = std::move(balls);
    return type;
}

inline sim::BlockType typeOf(const char* name, std::vector<sim::BlockPlacement> blocks)
{
    sim::BlockType type;
    type.name = name;
    type.blocks = std::move(blocks);
    return type;
}

inline sim::BlockPlacement placedAt(const glm::vec3& position, uint32_t type, float scale = 1.0f,
                                    uint32_t phase = 0)
{
    sim::BlockPlacement placed;
    placed.position = position;
    placed.type = type;
    placed.scale = scale;
    placed.phase = phase;
    return placed;
}

/// An emitter of balls that rise and swirl, which has no closed form.
inline std::shared_ptr<sim::EmitterDef> boiling(float rate = 30.0f)
{
    auto emitter = std::make_shared<sim::EmitterDef>();
    emitter->maxParticles = 400;
    emitter->shape = sim::EmitterShape::Sphere;
    emitter->size = glm::vec3(1.0f);
    emitter->emission.rate = rate;
    emitter->emission.duration = std::numeric_limits<float>::infinity();
    emitter->lifetime = {1.0f, 3.0f};
    emitter->speed = {0.5f, 1.0f};
    emitter->forces.gravity = 0.0f;
    emitter->forces.curlStrength = 0.5f;
    return emitter;
}

/// A solver of blocks, its clock and its surroundings.
class BlockBench
{
public:
    explicit BlockBench(sim::BlocksDef def,
                        std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner())
        : def_(std::move(def)), tasks_(std::move(tasks)), solver_(def_.create(blockSchema(), {}, &memory_)),
          scratch_(&memory_), snapshot_(&blockSchema(), &memory_)
    {}

    void play(int steps)
    {
        for (int i = 0; i < steps; ++i) {
            sim::StepContext context{};
            context.tick = tick_;
            context.stepTicks = kBlockStep;
            context.seed = 9;
            context.gravity = {0, -9.8f, 0};
            context.groundHeight = -std::numeric_limits<float>::infinity();
            context.parameters = &parameters_;
            context.tasks = tasks_.get();
            context.scratch = &scratch_;
            context.counters = &counters_;
            solver_->step(context);
            scratch_.reset();
            tick_ += kBlockStep;
        }
    }

    const base::FrameSnapshot& look()
    {
        snapshot_.begin(tick_, 1, kBlockStep);
        solver_->publish({}, snapshot_);
        return snapshot_;
    }

    /// The balls of all blocks.
    const base::SnapshotGroup& balls()
    {
        look();
        return snapshot_.group(snapshot_.groupCount() - 1);
    }

    std::vector<std::byte> state() const
    {
        sim::StateBuffer buffer(&memory_);
        solver_->save(buffer);
        return {buffer.bytes().begin(), buffer.bytes().end()};
    }
    bool restore(std::span<const std::byte> bytes, base::Ticks at)
    {
        sim::StateReader reader(bytes);
        solver_->restore(reader);
        tick_ = at;
        return reader.ok() && reader.left() == 0;
    }
    base::Ticks tick() const { return tick_; }
    uint64_t allocations() const { return memory_.allocationCount(); }

private:
    const sim::BlocksDef def_;
    mutable base::HostMemory memory_;
    std::unique_ptr<base::TaskRunner> tasks_;
    std::unique_ptr<sim::Solver> solver_;
    base::Arena scratch_;
    base::FrameSnapshot snapshot_;
    sim::InstanceParameters parameters_;
    sim::StepCounters counters_;
    base::Ticks tick_ = 0;
};

inline glm::vec3 positionOf(const base::SnapshotGroup& group, size_t i)
{
    namespace blob = base::blob_column;
    return {group.column(blob::PositionX)[i], group.column(blob::PositionY)[i],
            group.column(blob::PositionZ)[i]};
}

} // namespace fx::test
