// How far an effect is said to reach, against where its particles are.
#include "simulation/particles/forces/force_ops.h"
#include "simulation/particles/shapes/shape_sample.h"
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

constexpr float kGravity = 9.80665f;

/// A module that does not say how far it moves particles.
struct Unbounded final : sim::TileOp
{
    sim::TilePhase phase() const override { return sim::TilePhase::Force; }
    void run(const sim::TileContext&, const void*, sim::Tile&) const override {}
};

/// What decides where the particles of an emitter get, drawn from `seed`.
std::unique_ptr<sim::EmitterDef> randomEmitter(uint64_t seed)
{
    const auto draw = [&seed](float below) {
        seed = base::hashWord(seed, 1);
        return below * float(seed % 1000) / 1000.0f;
    };
    auto emitter = std::make_unique<sim::EmitterDef>();
    emitter->maxParticles = 256;
    emitter->shape = sim::EmitterShape(uint8_t(draw(4)));
    emitter->position = {draw(1), draw(1), draw(1)};
    emitter->size = {draw(2), draw(2), draw(2)};
    emitter->angle = draw(3);
    emitter->emission.rate = 60;
    emitter->emission.duration = std::numeric_limits<float>::infinity();
    emitter->lifetime = {0.5f, 1.0f + draw(1)};
    emitter->speed = {0, draw(10)};
    emitter->radius = {0.1f, 0.1f + draw(1)};
    emitter->shutter = draw(0.1f);
    emitter->forces.gravity = draw(2) - 1;
    emitter->forces.drag = draw(2) > 1 ? draw(3) : 0;
    emitter->forces.wind = {draw(3), 0, draw(3)};
    emitter->forces.curlStrength = draw(2) > 1 ? draw(2) : 0;
    emitter->forces.curlOctaves = 1 + uint32_t(draw(4));
    if (draw(2) > 1)
        emitter->modules.push_back(sim::makeGustOp({{draw(5), draw(5), 0}, 0.5f}));
    return emitter;
}

Effect effectOf(std::unique_ptr<sim::EmitterDef> emitter)
{
    Effect effect = emptyEffect();
    effect->hasGround = false;
    effect->solvers.push_back(std::move(emitter));
    return effect;
}

/// The largest distance from the origin that the bounds of what is shown have over `steps` steps.
float farthest(const Effect& effect, int steps)
{
    SightStage stage(neverCulled());
    stage.add(effect, glm::dvec3(0.0));
    float most = 0;
    for (int i = 0; i < steps; ++i) {
        stage.play(1);
        const scene::Presentation shown = stage.scene().acquire();
        for (size_t g = 0; g < shown.snapshots.newer->groupCount(); ++g) {
            const base::SnapshotGroup& group = shown.snapshots.newer->group(g);
            for (uint32_t k = 0; k < group.info().count; ++k) {
                const glm::vec3 at(group.column(base::blob_column::PositionX)[k],
                                   group.column(base::blob_column::PositionY)[k],
                                   group.column(base::blob_column::PositionZ)[k]);
                most = std::max(most, glm::length(at) + group.column(base::blob_column::Radius)[k]);
            }
        }
        stage.scene().release(shown.snapshots);
    }
    return most;
}

/// Every particle of the first emitter becomes eight of the second when it dies.
Effect chainOf(std::unique_ptr<sim::EmitterDef> first, std::unique_ptr<sim::EmitterDef> second,
               float inherited)
{
    sim::EventRule rule;
    rule.target = 1;
    rule.fewest = rule.most = 8;
    rule.inheritVelocity = inherited;
    first->events.push_back(rule);
    second->fed = true;
    second->emission.rate = 0;
    Effect effect = effectOf(std::move(first));
    effect->solvers.push_back(std::move(second));
    effect->order = {0, 1};
    return effect;
}

} // namespace

TEST(EmitterReach, noParticleLeavesIt)
{
    float tightest = 1e9f;
    for (uint64_t seed = 0; seed < 60; ++seed) {
        const Effect effect = effectOf(randomEmitter(seed));
        const float reach = effect->reach(kGravity, 0.0f), most = farthest(effect, 180);
        EXPECT_LE(most, reach) << seed;
        tightest = std::min(tightest, reach / most);
    }
    EXPECT_LT(tightest, 1.5f); // it is not so large that nothing could leave it
}

TEST(EmitterReach, whatIsBornOfParticlesIsWithinItToo)
{
    int beyondOwn = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
        const float inherited = seed % 2 ? 1.0f : 0.0f;
        const Effect effect = chainOf(randomEmitter(seed), randomEmitter(seed + 100), inherited);
        const float most = farthest(effect, 180);
        EXPECT_LE(most, effect->reach(kGravity, 0.0f)) << seed;
        float own = 0;
        for (const auto& solver : effect->solvers)
            own = std::max(own, solver->reach(kGravity, 0.0f, 1e6f));
        beyondOwn += most > own;
    }
    EXPECT_GE(beyondOwn, 3); // without the chain they would be called out of sight while they are seen
}

TEST(EmitterReach, whateverShapeTheyAreBornIn)
{
    sim::ShapeDef tall;
    tall.kind = sim::ShapeKind::Cone;
    tall.position = {1, 2, 3};
    tall.size.x = 0.5f;
    tall.angle = 1.2f;
    tall.axis = {1, 1, 0};
    tall.height = 4;
    sim::ShapeDef torus;
    torus.kind = sim::ShapeKind::Torus;
    torus.position = {0, 1, 0};
    torus.size.x = 2;
    torus.axis = {0, 0, 1};
    torus.tube = 1.5f;
    for (const sim::ShapeDef& shape : {tall, torus}) {
        auto emitter = randomEmitter(3);
        emitter->forces = {};
        emitter->modules.clear();
        emitter->forces.gravity = 0;
        emitter->speed = {0, 0};
        emitter->emission.rate = 200;
        emitter->births = sim::makeShapeOp(shape);
        const float extent = emitter->births->extent(), radius = emitter->radius.max;
        const float most = farthest(effectOf(std::move(emitter)), 180);
        EXPECT_LE(most, extent + radius);
        EXPECT_GT(most, 0.6f * extent);
    }
}

TEST(EmitterReach, ofForcesThatNobodyCanBoundIsUnknownUnlessThePresetSays)
{
    auto emitter = randomEmitter(1);
    emitter->modules.push_back(std::make_shared<Unbounded>());
    const Effect effect = effectOf(std::move(emitter));
    EXPECT_TRUE(std::isinf(effect->reach(kGravity, 0.0f)));
    effect->bound = 12;
    EXPECT_EQ(effect->reach(kGravity, 0.0f), 12.0f);
    const Effect chain = chainOf(randomEmitter(1), randomEmitter(2), 1.0f);
    EXPECT_TRUE(std::isfinite(chain->reach(kGravity, 0.0f)));
    auto pulled = randomEmitter(1);
    pulled->modules.push_back(std::make_shared<Unbounded>());
    const Effect unknown = chainOf(std::move(pulled), randomEmitter(2), 0.0f);
    EXPECT_TRUE(std::isinf(unknown->reach(kGravity, 0.0f)));
}
