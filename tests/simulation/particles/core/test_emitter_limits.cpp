#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

#include <limits>

using namespace fx;
using namespace fx::test;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

uint32_t livingRows(const base::SnapshotGroup& group)
{
    uint32_t living = 0;
    for (const float radius : group.column(base::particle_column::Radius))
        living += radius > 0.0f ? 1 : 0;
    return living;
}

} // namespace

TEST(EmitterLimits, noRateIsTooStrange)
{
    for (const float rate : {0.0f, -5.0f, kNaN}) {
        Stage stage;
        stage.add({}, spriteEmitter(rate, {1, 1}));
        stage.play(10);
        EXPECT_EQ(stage.counters().born, 0u) << rate;
    }
    for (const float rate : {1e9f, 1e18f, kInfinity}) { // larger ones are taken as 1e9
        Stage stage;
        const sim::Slot slot = stage.add({}, spriteEmitter(rate, {1, 1}));
        stage.play(3);
        EXPECT_NEAR(double(stage.counters().born), 1e9 * 3 / 60, 2.0) << rate;
        EXPECT_EQ(stage.world().elementCount(slot), 1024u) << rate;
        EXPECT_EQ(stage.counters().born - stage.counters().dropped, 1024u) << rate;
        EXPECT_EQ(livingRows(stage.look().group(0)), 1024u) << rate;
    }
}

TEST(EmitterLimits, noLifetimeIsTooStrange)
{
    for (const float life : {0.0f, -1.0f, kNaN, 1e-30f}) {
        Stage stage;
        const sim::Slot slot = stage.add({}, spriteEmitter(600.0f, {life, life}));
        for (int i = 0; i < 30; ++i) {
            stage.step();
            EXPECT_EQ(livingRows(stage.look().group(0)), 0u) << life;
        }
        EXPECT_EQ(stage.counters().born, 300u) << life;
        EXPECT_EQ(stage.world().elementCount(slot), 0u) << life;
    }
    Stage stage;
    auto def = spriteEmitter(600.0f, {kInfinity, kInfinity});
    def->maxParticles = 100;
    const sim::Slot slot = stage.add({}, std::move(def));
    stage.play(200);
    EXPECT_EQ(stage.world().elementCount(slot), 100u);
    EXPECT_EQ(stage.counters().dropped, 1900u);
}

TEST(EmitterLimits, aLifeShorterThanAStepEndsWithinIt)
{
    Stage stage;
    stage.add({}, spriteEmitter(60000.0f, {0.001f, 0.001f}));
    stage.play(60);
    EXPECT_EQ(stage.counters().born, 60000u);
    EXPECT_NEAR(livingRows(stage.look().group(0)), 60.0, 1.0);
}

TEST(EmitterLimits, burstsAtTheSameMomentAllHappen)
{
    Stage stage;
    auto def = spriteEmitter(0.0f, {10, 10});
    def->emission.bursts = {{0.0f, 3}, {0.0f, 5}, {1.0f / 60.0f, 7}};
    stage.add({}, std::move(def));
    stage.step();
    EXPECT_EQ(stage.counters().born, 8u);
    stage.step();
    EXPECT_EQ(stage.counters().born, 15u);
}

TEST(EmitterLimits, anHourInOneStepIsAnHour)
{
    Stage once, often;
    once.add({}, spriteEmitter(10.0f, {1.0f, 2.0f}));
    often.add({}, spriteEmitter(10.0f, {1.0f, 2.0f}));
    once.step(600 * base::kTicksPerSecond);
    for (int i = 0; i < 600; ++i)
        often.step(base::kTicksPerSecond);
    EXPECT_EQ(once.counters().born, 6000u);
    EXPECT_EQ(once.look().hash(), often.look().hash());
}

TEST(EmitterLimits, afterTheFirstStepsNothingIsAllocated)
{
    for (const float curl : {0.0f, 1.0f}) {
        Stage stage;
        auto def = spriteEmitter(900.0f, {0.5f, 1.0f});
        def->forces.curlStrength = curl;
        stage.add({}, std::move(def));
        stage.step();
        stage.look();
        const uint64_t before = stage.memory().allocationCount();
        for (int i = 0; i < 100; ++i) {
            stage.step();
            stage.look();
        }
        EXPECT_EQ(stage.memory().allocationCount(), before);
    }
}

/// 100 rows, 1000 births a second, all of which live 0.95 s: a row is free again for the tenth birth that
/// asks for it, so the births of every tenth lap of the ring live and no others.
TEST(EmitterLimits, aFullEmitterTakesTheBirthsOfEveryTenthLap)
{
    for (const base::Ticks ticks : {kStep, kStep / 7 + 1, 10 * kStep}) {
        Stage stage;
        auto def = spriteEmitter(1000.0f, {0.95f, 0.95f});
        def->maxParticles = 100;
        stage.add({}, std::move(def));
        uint64_t born = 0;
        while (born < 2500) {
            stage.step(ticks);
            born = stage.counters().born;
            const uint64_t laps = born / 100, rest = born % 100;
            const uint64_t stored = 100 * ((laps + 9) / 10) + (laps % 10 == 0 ? rest : 0);
            ASSERT_EQ(stage.counters().dropped, born - stored) << born;
        }
    }
}
