/// @file sight_stage.h
/// Scenes of effects whose states are easy to compare, and cameras for them.
#pragma once

#include "foundation/math/hash.h"
#include "foundation/memory/host_memory.h"
#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/scene/scene.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/solver/seekable_solver.h"

#include <glm/gtc/matrix_transform.hpp>

#include <memory>
#include <vector>

namespace fx::test {

constexpr base::Ticks kStep = base::kTicksPerSecond / 60;

/// Properties of a toy solver.
struct ToyKind
{
    bool seeks = false;         ///< true: the state is a pure function of time and intensity
    uint32_t elements = 4;      ///< number of elements that the solver reports
    base::Ticks restsUntil = 0; ///< local time before which the solver has no elements
    base::Ticks endsAt = INT64_MAX;
    int* created = nullptr; ///< counter of created solvers
};

/// A solver whose state is a single number. If the solver seeks, the number is a sum over time. If it does
/// not, the number is a chain of hashes over steps.
class ToySolver final : public sim::Solver, public sim::SeekableSolver
{
public:
    explicit ToySolver(const ToyKind& kind) : kind_(kind) {}
    void step(const sim::StepContext& context) override
    {
        advance(context, context.tick + context.stepTicks);
        context.counters->particleSteps += elementCount();
    }
    bool canSeek(const sim::StepContext&, base::Ticks tick) const override
    {
        return kind_.seeks || tick <= kind_.restsUntil;
    }
    void seek(const sim::StepContext& context, base::Ticks tick) override { advance(context, tick); }
    base::Ticks restsUntil(base::Ticks tick) const override { return std::max(tick, kind_.restsUntil); }
    sim::SeekableSolver* seekable() override { return this; }
    void publish(const base::GroupInfo&, base::FrameSnapshot&) const override {}
    bool finished(base::Ticks tick) const override { return tick >= kind_.endsAt; }
    uint32_t elementCount() const override { return now_ < kind_.restsUntil ? 0 : kind_.elements; }
    void save(sim::StateWriter& writer) const override
    {
        writer.value(now_);
        writer.value(state_);
    }
    void restore(sim::StateReader& reader) override
    {
        now_ = reader.value<base::Ticks>();
        state_ = reader.value<uint64_t>();
    }

private:
    void advance(const sim::StepContext& context, base::Ticks tick)
    {
        const uint64_t asked = uint64_t(context.parameters->intensity) + context.seed;
        if (kind_.seeks || tick <= kind_.restsUntil)
            state_ += asked * uint64_t(tick - now_);
        else
            state_ = base::hashWord(base::hashWord(state_, asked), uint64_t(tick));
        now_ = tick;
    }
    const ToyKind& kind_;
    base::Ticks now_ = 0;
    uint64_t state_ = 0;
};

struct ToyDef final : sim::SolverDef
{
    explicit ToyDef(const ToyKind& k) : kind(k) {}
    std::unique_ptr<sim::Solver> create(const base::SnapshotSchema&, const sim::Quality&,
                                        std::pmr::memory_resource*) const override
    {
        if (kind.created)
            ++*kind.created;
        return std::make_unique<ToySolver>(kind);
    }
    uint32_t capacity() const override { return kind.elements; }
    bool publishes(const base::KindDesc&) const override { return false; }
    sim::CatchUp catchUp() const override
    {
        return kind.seeks ? sim::CatchUp::Analytic : sim::CatchUp::Replay;
    }
    float reach(float, float, float) const override { return 1.0f; }
    ToyKind kind;
};

using Effect = std::shared_ptr<sim::EffectDef>;

/// An effect that differs from every other effect.
inline Effect emptyEffect()
{
    static uint64_t made = 0;
    auto effect = std::make_shared<sim::EffectDef>();
    effect->fingerprint = ++made;
    return effect;
}

inline Effect toyEffect(const ToyKind& kind)
{
    auto effect = emptyEffect();
    effect->solvers.push_back(std::make_unique<ToyDef>(kind));
    return effect;
}

/// An emitter of 60 particles per second. @param curls true: the motion of the particles is integrated
inline Effect fountainEffect(bool curls = false, float longestLife = 0.5f)
{
    auto emitter = std::make_unique<sim::EmitterDef>();
    emitter->maxParticles = uint32_t(128.0f * longestLife);
    emitter->shape = sim::EmitterShape::Sphere;
    emitter->size = glm::vec3(0.2f);
    emitter->emission.rate = 60;
    emitter->emission.duration = std::numeric_limits<float>::infinity();
    emitter->lifetime = {0.8f * longestLife, longestLife};
    emitter->speed = {0.5f, 1.0f};
    emitter->radius = {0.1f, 0.1f};
    emitter->forces.drag = 0.5f;
    emitter->forces.curlStrength = curls ? 1.0f : 0.0f;
    auto effect = emptyEffect();
    effect->solvers.push_back(std::move(emitter));
    return effect;
}

/// A camera at the origin that looks horizontally, with a field of view of 60 degrees. @param radians 0:
/// along -Z
inline activation::Frustum lookAt(double radians, activation::Frustum::Limits limits = {})
{
    const glm::mat4 view = glm::rotate(glm::mat4(1.0f), float(radians), glm::vec3(0, 1, 0));
    return {glm::dvec3(0.0), view, glm::perspective(1.0472f, 1.0f, 0.1f, 1000.0f), limits};
}

/// A scene for tests that do not use the C API.
class SightStage
{
public:
    explicit SightStage(scene::SceneOptions options = {}) : scene_(options, &schema_, tasks_.get(), &memory_)
    {}

    scene::LocalId add(const Effect& effect, const glm::dvec3& position, uint64_t seed = 1,
                       base::Ticks start = 0)
    {
        scene::InstanceSetup setup;
        setup.effect = effect;
        setup.seed = seed;
        setup.startTick = start;
        setup.placement.position = position;
        return scene_.add(std::move(setup));
    }
    void look(double radians) { lookThrough({lookAt(radians)}); }
    void lookThrough(const std::vector<activation::Frustum>& cameras) { scene_.setFocus(cameras); }
    void play(int steps)
    {
        for (int i = 0; i < steps; ++i)
            scene_.update(1.0 / 60.0);
    }
    scene::Scene& scene() { return scene_; }
    scene::InstanceState state(scene::LocalId id) { return scene_.activity(id).state; }
    scene::Reason reason(scene::LocalId id) { return scene_.activity(id).reason; }
    base::HostMemory& memory() { return memory_; }

private:
    static base::SnapshotSchema blobs()
    {
        base::SnapshotSchema schema;
        schema.add(base::kBlobKind);
        return schema;
    }
    base::HostMemory memory_;
    base::SnapshotSchema schema_ = blobs();
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    scene::Scene scene_;
};

inline scene::SceneOptions neverCulled()
{
    scene::SceneOptions options;
    options.culling = false;
    return options;
}

constexpr double kBehind = 3.14159265; ///< [rad]
const glm::dvec3 kAhead{0, 0, -20};

} // namespace fx::test
