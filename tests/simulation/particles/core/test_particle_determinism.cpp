#include "tests/foundation/every_set.h"
#include "tests/foundation/real_threads.h"
#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

/// A ballistic emitter, an integrated one and a medium.
void addAll(Stage& stage)
{
    auto ballistic = spriteEmitter(6000.0f, {0.3f, 1.1f});
    ballistic->maxParticles = 7000;
    ballistic->appearance.fastest = 5.0f;
    ballistic->appearance.kind = sim::AppearanceKind::Mesh;
    auto integrated = spriteEmitter(1200.0f, {0.3f, 1.1f});
    integrated->shape = sim::EmitterShape::Sphere;
    integrated->maxParticles = 1500;
    integrated->forces.curlStrength = 2.0f;
    integrated->forces.bounce = 0.4f;
    auto medium = rateEmitter(150.0f, 4.5f);
    medium->temperature = {500, 900};
    medium->forces.buoyancy = 1.0f;
    medium->forces.drag = 1.0f;
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(std::move(ballistic));
    effect->solvers.push_back(std::move(integrated));
    effect->solvers.push_back(std::move(medium));
    stage.add({}, effect);
}

uint64_t history(std::unique_ptr<base::TaskRunner> tasks, int steps)
{
    Stage stage(std::move(tasks));
    addAll(stage);
    uint64_t hash = 0;
    for (int i = 0; i < steps; ++i) {
        stage.step();
        if (i % 50 == 49)
            hash = base::hashWord(hash, stage.look().hash());
    }
    return hash;
}

} // namespace

TEST(ParticleDeterminism, everyNumberOfWorkersGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(16);
    const uint64_t want = history(base::makeSerialRunner(), 300);
    for (const uint32_t threads : {1u, 2u, 3u, 7u, 16u})
        EXPECT_EQ(history(base::makeTbbRunner(threads), 300), want) << threads;
}

TEST(ParticleDeterminism, everyInstructionSetGivesTheSameBits)
{
    const uint64_t want = history(base::makeSerialRunner(), 2000);
    test::everySet([&](base::InstructionSet) { EXPECT_EQ(history(base::makeSerialRunner(), 2000), want); });
}
