// Whatever the preset and the step say, what a gas publishes is finite and within its bounds.
#include "simulation/gas/gas_solver.h"
#include "tests/simulation/gas_cloud.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

void expectFinite(Stage& stage)
{
    const base::SnapshotGroup& group = stage.look().group(0);
    for (size_t c = 0; c < blob::Count; ++c)
        for (const float value : group.column(c))
            ASSERT_TRUE(std::isfinite(value)) << base::kBlobColumns[c].name;
}

} // namespace

TEST(GasLimits, coincidentParticlesStayFinite)
{
    Stage stage;
    auto def = fireball(64);
    def->energy = 1.0; // a ball of millimetres
    def->jitter = 0.0f;
    stage.add({}, std::move(def));
    stage.play(30);
    expectFinite(stage);
}

TEST(GasLimits, extremePresetsStayFiniteAndBounded)
{
    for (const float wild : {1e2f, 1e4f, 1e8f}) {
        Stage stage;
        auto def = fireball(64);
        def->energy = double(wild) * 1e6;
        def->pressureRatio = wild;
        def->soundSpeed = 0.0f;
        def->curlStrength = wild;
        def->buoyancy = wild;
        def->viscosity = 4.0f;
        stage.add({}, std::move(def));
        stage.play(3);
        expectFinite(stage);
        EXPECT_LE(stage.counters().subSteps, 3u * 65u * (sim::kMaxGasSubSteps + 1));
    }
}

TEST(GasLimits, stepsOfEveryLengthStayFinite)
{
    for (const base::Ticks ticks : {base::Ticks(1), base::kTicksPerSecond / 1000, base::kTicksPerSecond / 15,
                                    base::kTicksPerSecond, 100 * base::kTicksPerSecond})
    {
        Stage stage;
        auto def = fireball(64);
        def->dissipation = 0.0f;
        stage.add({}, std::move(def));
        for (int i = 0; i < 3; ++i)
            stage.step(ticks);
        expectFinite(stage);
    }
}

TEST(GasLimits, boundsHoldEveryBlobWithItsRadius)
{
    Stage stage;
    stage.add({}, fireball());
    stage.play(20);
    const base::SnapshotGroup& group = stage.look().group(0);
    for (uint32_t i = 0; i < group.count(); ++i)
        for (size_t a = 0; a < 3; ++a) {
            const float p = group.column(blob::PositionX + a)[i];
            ASSERT_LE(group.info().bounds.min[int(a)], p - group.column(blob::Radius)[i]);
            ASSERT_GE(group.info().bounds.max[int(a)], p + group.column(blob::Radius)[i]);
        }
}
