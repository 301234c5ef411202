#include "tests/foundation/real_threads.h"
#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

/// A host that cuts loops into uneven ranges and runs them last to first.
void unevenly(void*, uint32_t count, uint32_t minBatch, base::LoopBody body, void* argument)
{
    uint32_t end = count;
    for (uint32_t k = 1; end > 0; ++k) {
        const uint32_t size = std::min(end, minBatch * (1 + k % 3));
        body(argument, end - size, end);
        end -= size;
    }
}

template <class T>
uint64_t hashAfter(std::unique_ptr<base::TaskRunner> tasks, StepScheme steps)
{
    auto stage = pointBlast<T>(12, periodicBox(12, steps));
    stage.tasks = std::move(tasks);
    stage.advance(0.01);
    stage.gas.inject(17, 0.1);
    stage.gas.injectLater(99, 0.1, 0.003);
    for (int i = 0; i < 3; ++i)
        stage.advance(0.005);
    return stage.gas.hash();
}

} // namespace

TEST(GasDeterminism, anyNumberOfWorkersGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(7);
    for (const StepScheme steps : {StepScheme::Global, StepScheme::Block}) {
        const uint64_t want = hashAfter<float>(base::makeSerialRunner(), steps);
        for (const uint32_t threads : {1u, 2u, 3u, 7u})
            EXPECT_EQ(hashAfter<float>(base::makeTbbRunner(threads), steps), want) << threads;
        EXPECT_EQ(hashAfter<float>(base::makeHostRunner({nullptr, unevenly}), steps), want);
    }
    EXPECT_EQ(hashAfter<double>(base::makeTbbRunner(3), StepScheme::Block),
              hashAfter<double>(base::makeSerialRunner(), StepScheme::Block));
}

TEST(GasDeterminism, aRestoredStateGoesOnWithTheSameBits)
{
    for (const StepScheme steps : {StepScheme::Global, StepScheme::Block}) {
        auto stage = pointBlast<float>(12, periodicBox(12, steps));
        stage.advance(0.02);
        stage.gas.injectLater(99, 0.1, 0.003);
        std::vector<std::byte> bytes;
        stage.gas.save(bytes);
        GasDynamics<float> other(stage.gas.definition(), std::pmr::get_default_resource());
        ASSERT_TRUE(other.restore(bytes).ok());
        EXPECT_EQ(other.hash(), stage.gas.hash());
        for (int i = 0; i < 4; ++i) {
            stage.advance(0.004);
            ASSERT_TRUE(other.advance(0.004, *stage.tasks).ok());
            ASSERT_EQ(other.hash(), stage.gas.hash()) << i;
        }
    }
}

TEST(GasDeterminism, aRestoredStateThatIsEditedGoesOnWithTheSameBits)
{
    auto stage = pointBlast<float>(12, periodicBox(12, StepScheme::Block));
    stage.advance(0.02);
    std::vector<std::byte> bytes;
    stage.gas.save(bytes);
    GasDynamics<float> other(stage.gas.definition(), std::pmr::get_default_resource());
    ASSERT_TRUE(other.restore(bytes).ok());
    for (int i = 0; i < 4; ++i) {
        for (GasDynamics<float>* gas : {&stage.gas, &other}) { // first in place, then far away
            const GasView<float> view = gas->view();
            for (uint32_t k = 0; k < view.count; ++k) {
                view.vx[k] += 0.01f * view.y[k];
                view.mass[k] *= 1.002f;
                if (i == 2 && view.id[k] % 97 == 0)
                    view.z[k] = 1.0f - view.z[k];
            }
            gas->edited();
            ASSERT_TRUE(gas->advance(0.002, *stage.tasks).ok());
        }
        ASSERT_EQ(other.hash(), stage.gas.hash()) << i;
    }
}

TEST(GasDeterminism, whatListsKeepFromTheStepBeforeDoesNotShow)
{
    // Positions moved and moved back leave the lists as they are; a state that has none must agree.
    auto stage = pointBlast<double>(12, periodicBox(12, StepScheme::Block));
    stage.advance(0.02);
    GasStage<double> fresh(stage.gas.definition(), {});
    std::vector<GasParticle> particles;
    for (uint32_t id = 0; id < stage.gas.count(); ++id)
        particles.push_back(stage.gas.particle(id));
    ASSERT_TRUE(fresh.gas.add(particles).ok());
    fresh.gas.initialize(*fresh.tasks);
    stage.gas.edited();
    stage.gas.initialize(*stage.tasks);
    for (uint32_t id = 0; id < stage.gas.count(); ++id) {
        EXPECT_NEAR(fresh.gas.densityOf(id) / stage.gas.densityOf(id), 1.0, 1e-5);
        EXPECT_NEAR(fresh.gas.supportOf(id) / stage.gas.supportOf(id), 1.0, 1e-5);
    }
}

TEST(GasDeterminism, damagedBytesAreRefused)
{
    auto stage = pointBlast<float>(8, periodicBox(8));
    stage.advance(0.001);
    std::vector<std::byte> bytes;
    stage.gas.save(bytes);
    const uint64_t hash = stage.gas.hash();
    for (const size_t at : {size_t(0), size_t(9), size_t(200), bytes.size() - 1}) {
        std::vector<std::byte> damaged = bytes;
        damaged[at] ^= std::byte(4);
        EXPECT_FALSE(stage.gas.restore(damaged).ok()) << at;
    }
    for (const size_t size : {size_t(0), size_t(10), bytes.size() - 1})
        EXPECT_FALSE(stage.gas.restore(std::span(bytes).first(size)).ok());
    GasDynamics<double> other(periodicBox(8), std::pmr::get_default_resource());
    EXPECT_FALSE(other.restore(bytes).ok());
    EXPECT_EQ(stage.gas.hash(), hash);
}
