#include "tests/simulation/dynamics/gas_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using namespace fx::sim;

namespace {

/// [m] Mean distance of the densest gas from the middle.
template <class T>
double shockRadius(const GasDynamics<T>& gas)
{
    double radius = 0, weight = 0;
    for (uint32_t id = 0; id < gas.count(); ++id) {
        const double dense = std::pow(std::max(gas.densityOf(id) - 1.1, 0.0), 4.0);
        radius += dense * length(gas.particle(id).position - glm::dvec3(0.5));
        weight += dense;
    }
    return radius / weight;
}

} // namespace

TEST(TimeSteps, aHierarchyOfStepsGivesTheSameBlastForLess)
{
    constexpr uint32_t n = 20;
    auto common = pointBlast<float>(n, periodicBox(n));
    const AdvanceReport all = common.advance(0.02);
    auto block = pointBlast<float>(n, periodicBox(n, StepScheme::Block));
    const AdvanceReport some = block.advance(0.02);
    EXPECT_LE(std::abs(block.energyError()), 5e-3);
    EXPECT_NEAR(shockRadius(block.gas), shockRadius(common.gas), 0.01 * shockRadius(common.gas));
    EXPECT_LT(some.particleSteps * 3, all.particleSteps * 2); // at 8000 particles; far fewer in larger boxes
    const GasTotals totals = block.gas.totals();
    EXPECT_LE(length(totals.momentum), 1e-3 * totals.momentumScale);
}

TEST(TimeSteps, withoutTheLimiterTheBlastGoesWrong)
{
    // Guards the test above: particles that sleep while the shock arrives must be seen in the energy.
    GasDynamicsDef def = periodicBox(20, StepScheme::Block);
    def.neighborStepRatio = std::numeric_limits<double>::infinity();
    auto stage = pointBlast<float>(20, def);
    stage.advance(0.02);
    EXPECT_GT(std::abs(stage.energyError()), 5e-2);
}

TEST(TimeSteps, heatInTheMiddleOfASleepersStepWakesItAndItsNeighbors)
{
    uint64_t random = 1;
    for (int trial = 0; trial < 6; ++trial) {
        GasStage<float> stage(periodicBox(10, StepScheme::Block), lattice(10, 1e-4));
        double heat = 0;
        for (int k = 0; k < 4; ++k) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            stage.gas.injectLater(uint32_t(random >> 40) % 1000, 1.0,
                                  0.1 * double((random >> 20) & 1023) / 1024);
            heat += 1.0;
        }
        const AdvanceReport report = stage.advance(0.1);
        EXPECT_GT(report.subSteps, 10u);
        EXPECT_NEAR(stage.gas.totals().energy(), stage.before.energy() + heat, 5e-3 * heat) << trial;
    }
}

TEST(TimeSteps, heatBetweenFramesIsTheSame)
{
    GasStage<float> stage(periodicBox(10, StepScheme::Block), lattice(10, 1e-4));
    stage.advance(0.1);
    stage.gas.inject(555, 1.0);
    stage.advance(0.05);
    EXPECT_NEAR(stage.gas.totals().energy(), stage.before.energy() + 1.0, 1e-2);
}

TEST(TimeSteps, coldGasTakesOneStepForAFrame)
{
    GasStage<float> stage(periodicBox(6, StepScheme::Block), lattice(6, 0.0));
    EXPECT_EQ(stage.advance(1.0).subSteps, 1u);
}
