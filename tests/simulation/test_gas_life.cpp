// When a gas begins, what is left of it, and when it ends.
#include "tests/simulation/gas_cloud.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

TEST(GasLife, qualityChoosesTheNumberOfParticles)
{
    Stage stage;
    sim::InstanceStart start;
    start.quality = sim::QualityLevel::Low;
    const sim::Slot slot = stage.add(start, fireball(200));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 50u);
}

TEST(GasLife, startsAtItsTimeWithinAStep)
{
    Stage stage;
    auto def = fireball(50);
    def->start = 2.5f / 60.0f;
    const sim::Slot slot = stage.add({}, std::move(def));
    stage.play(2);
    EXPECT_EQ(stage.world().elementCount(slot), 0u);
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 50u);
    EXPECT_NEAR(stage.look().group(0).column(blob::Age)[0], 0.5f / 60.0f, 1e-6f);
}

TEST(GasLife, aReleaseWithinAStepMovesOnlyForTheRestOfIt)
{
    Stage whole;
    Stage half;
    for (const auto& [stage, start] : {std::pair{&whole, 0.0f}, std::pair{&half, 0.5f / 60.0f}}) {
        auto def = pureGas(1);
        def->initialBias = {60, 0, 0};
        def->jitter = 0.0f;
        def->start = start;
        stage->add({}, std::move(def));
        stage->step();
    }
    const float way =
        whole.look().group(0).column(blob::PositionX)[0] - half.look().group(0).column(blob::PositionX)[0];
    EXPECT_NEAR(way, 0.5f, 1e-5f);
}

TEST(GasLife, isNeverReleasedWhenNothingNewIsWanted)
{
    Stage stage;
    sim::InstanceStart start;
    start.parameters.emitting = false;
    const sim::Slot slot = stage.add(start, fireball(50));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 0u);
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
}

TEST(GasLife, smokeDissolvesToNothingWithoutASuddenEnd)
{
    Stage stage;
    auto def = fireball(30);
    def->dissipation = 2.0f;
    const sim::Slot slot = stage.add({}, std::move(def));
    double last = 0;
    for (int i = 0; i < 1200 && !stage.world().finished(slot, stage.now()); ++i) {
        stage.step();
        if (stage.look().group(0).count() == 0)
            break;
        last = 0;
        for (const float sigma : stage.look().group(0).column(blob::CrossSection))
            last += double(sigma) / 30.0;
    }
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
    EXPECT_LT(last, 0.05);
}

TEST(GasLife, theSmokeThatRemainsIsTheSootOfTheMaterial)
{
    Stage stage;
    auto def = fireball(100);
    def->dissipation = 0.0f;
    def->entrainment = 8.0f;
    const sim::Material& tnt = *def->material;
    const double soot = def->energy / tnt.nominalEnergy * tnt.smokeSoot; // [kg]
    stage.add({}, std::move(def));
    stage.play(600);
    double area = 0;
    for (const float sigma : stage.look().group(0).column(blob::CrossSection))
        area += double(sigma);
    EXPECT_NEAR(area, soot * sim::kSootOptics.extinction, 0.35 * area);
    EXPECT_EQ(stage.look().group(0).column(blob::FireShare)[0], 0.0f);
}
