#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

/// Heats a standing wave bit by bit for a while. @return its kinetic and thermal energy, and the work done
std::pair<GasTotals, uint64_t> warmedUp(bool nudge, int slices)
{
    std::vector<GasParticle> particles = lattice(8, 0.9);
    for (GasParticle& particle : particles)
        particle.velocity.x = 0.2 * std::sin(6.283185307 * particle.position.x);
    GasStage<float> stage(periodicBox(8, StepScheme::Block), particles);
    uint64_t evaluations = 0;
    for (int i = 0; i < slices; ++i) {
        const GasView<float> view = stage.gas.view();
        for (uint32_t k = 0; k < view.count; ++k)
            view.entropy[k] *= 1.0f + 0.2f / float(slices);
        if (nudge) {
            stage.gas.nudged(1.0, *stage.tasks);
        } else {
            stage.gas.edited();
            evaluations += view.count;
        }
        evaluations += stage.advance(0.2 / slices).particleSteps;
    }
    return {stage.gas.totals(), evaluations};
}

} // namespace

TEST(Nudge, needsFewerEvaluationsForNearlyTheSameFlow)
{
    const auto [slow, many] = warmedUp(false, 40);
    const auto [quick, few] = warmedUp(true, 40);
    EXPECT_LT(few, many * 3 / 4);
    EXPECT_NEAR(quick.kinetic, slow.kinetic, 0.02 * slow.kinetic);
    EXPECT_NEAR(quick.thermal, slow.thermal, 1e-3 * slow.thermal);
    EXPECT_LE(length(quick.momentum), 1e-5 * quick.momentumScale);
}

TEST(Nudge, bringsPressureToTheEntropyAtOnce)
{
    GasStage<float> stage(periodicBox(6), lattice(6, 0.9));
    const double before = stage.gas.pressureOf(5);
    const double step = stage.gas.stepOf(5);
    const GasView<float> view = stage.gas.view();
    for (uint32_t k = 0; k < view.count; ++k)
        view.entropy[k] *= 4.0f;
    stage.gas.nudged(1.0, *stage.tasks);
    EXPECT_NEAR(stage.gas.pressureOf(5), 4.0 * before, 1e-5 * before);
    EXPECT_NEAR(stage.gas.stepOf(5), 0.5 * step, 1e-5 * step); // sound is twice as fast
}

TEST(Nudge, takesASmallerSoundWithoutAnEvaluation)
{
    GasStage<float> stage(periodicBox(6), lattice(6, 0.9));
    stage.gas.nudged(0.25, *stage.tasks);
    EXPECT_EQ(stage.gas.pressureScale(), 0.25);
    stage.gas.nudged(2.0, *stage.tasks); // refused
    EXPECT_EQ(stage.gas.pressureScale(), 0.25);
    GasStage<float> scaled(periodicBox(6), lattice(6, 0.9));
    scaled.gas.setPressureScale(0.25);
    scaled.gas.initialize(*scaled.tasks);
    stage.advance(1e-3);
    scaled.advance(1e-3);
    EXPECT_NEAR(stage.gas.stepOf(5), scaled.gas.stepOf(5), 1e-3 * scaled.gas.stepOf(5));
}
