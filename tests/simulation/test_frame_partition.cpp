#include "foundation/time/step_clock.h"
#include "tests/simulation/stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

/// An emitter that uses everything that could depend on time: rate, bursts, drag, noise, ground, curves.
std::unique_ptr<sim::EmitterDef> busyEmitter()
{
    auto def = rateEmitter(211.7f, 0.7f);
    def->emission.bursts = {{0.31f, 17}, {0.0f, 5}};
    def->shape = sim::EmitterShape::Cone;
    def->size = {0.3f, 0, 0};
    def->angle = 0.4f;
    def->position = {0, 0.5f, 0};
    def->speed = {1, 9};
    def->lifetime = {0.05f, 1.5f};
    def->temperature = {400, 1500};
    def->forces = {1.0f, 1.3f, 0.2f, {1, 0, 0}, 1.5f, 0.7f, 0.5f, 0.4f, 0.1f};
    return def;
}

/// Hash of the state at two seconds when frames last as `frameSeconds` says.
template <class FrameSeconds>
uint64_t hashAtTwoSeconds(FrameSeconds frameSeconds)
{
    Stage stage;
    auto effect = std::make_shared<sim::EffectDef>();
    effect->subSteps = 2;
    effect->solvers.push_back(busyEmitter());
    stage.add({}, effect);
    base::StepClock clock(kStep, base::kTicksPerSecond / 10);
    int frame = 0;
    while (stage.now() < 2 * base::kTicksPerSecond) {
        const base::StepPlan plan = clock.advance(frameSeconds(frame++));
        for (uint32_t i = 0; i < plan.steps && stage.now() < 2 * base::kTicksPerSecond; ++i)
            stage.step();
    }
    EXPECT_GT(stage.look().group(0).count(), 50u);
    return stage.look().hash();
}

/// Ids that are alive at two seconds when every step lasts `stepTicks`.
std::vector<uint64_t> idsAtTwoSeconds(base::Ticks stepTicks)
{
    Stage stage;
    stage.add({}, busyEmitter());
    while (stage.now() < 2 * base::kTicksPerSecond)
        stage.step(stepTicks);
    const auto ids = stage.look().group(0).ids();
    return {ids.begin(), ids.end()};
}

} // namespace

TEST(FramePartition, everyFrameRateGivesTheSameBits)
{
    const uint64_t want = hashAtTwoSeconds([](int) { return 1.0 / 60.0; });
    for (const double rate : {24.0, 30.0, 90.0, 144.0, 240.0, 1000.0})
        EXPECT_EQ(hashAtTwoSeconds([rate](int) { return 1.0 / rate; }), want) << rate;
}

TEST(FramePartition, irregularFramesGiveTheSameBits)
{
    const uint64_t want = hashAtTwoSeconds([](int) { return 1.0 / 60.0; });
    EXPECT_EQ(hashAtTwoSeconds([](int frame) { return frame % 3 == 0 ? 0.0 : 0.001 + 0.0137 * (frame % 5); }),
              want);
}

TEST(FramePartition, theSetOfParticlesDoesNotDependOnTheStep)
{
    const std::vector<uint64_t> want = idsAtTwoSeconds(kStep);
    ASSERT_GT(want.size(), 50u);
    for (const base::Ticks step : {base::kTicksPerSecond / 30, base::kTicksPerSecond / 144,
                                   base::kTicksPerSecond / 25, base::kTicksPerSecond})
        EXPECT_EQ(idsAtTwoSeconds(step), want) << step;
}
