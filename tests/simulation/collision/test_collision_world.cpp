#include "simulation/fragments/fragments_def.h"
#include "simulation/gas/gas_def.h"
#include "tests/simulation/collision/shapes.h"
#include "tests/simulation/fragments/fragment_burst.h"

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

constexpr float kWall = 2.0f; ///< [m] x of the near side of a wall

std::shared_ptr<const sim::DistanceField> wall()
{
    return fieldOf(boxMesh({kWall, -20, -20}, {kWall + 0.5f, 20, 20}), 0.25f);
}

/// A kilogram of petrol.
std::unique_ptr<sim::GasDef> fireball(uint32_t particles = 150)
{
    auto def = std::make_unique<sim::GasDef>();
    def->energy = 10e6;
    def->particles = particles;
    return def;
}

/// [m] along x, of everything that the first instance shows.
std::pair<float, float> extent(Stage& stage, size_t group = 0)
{
    const auto x = stage.look().group(group).column(blob::PositionX);
    const auto [least, most] = std::minmax_element(x.begin(), x.end());
    return {*least, *most};
}

uint64_t hashAfter(std::unique_ptr<base::TaskRunner> tasks, int steps)
{
    Stage stage(std::move(tasks));
    stage.world().setField(wall());
    const sim::Slot gas = stage.add({}, fireball(700));
    const sim::Slot burstSlot = stage.add({}, burst(60));
    stage.play(steps);
    return stage.world().hash(std::array{gas, burstSlot});
}

} // namespace

TEST(CollisionWorld, aBallOfGasBesideAWallStaysOnItsSide)
{
    Stage with, without;
    with.world().setField(wall());
    with.add({}, fireball());
    without.add({}, fireball());
    float farthest = 0.0f;
    for (int step = 0; step < 90; ++step) {
        with.step();
        without.step();
        EXPECT_LT(extent(with).second, kWall) << "step " << step;
        farthest = std::max(farthest, extent(without).second);
    }
    EXPECT_GT(farthest, kWall + 0.6f); // the wall had something to hold back
    EXPECT_LT(extent(with).first, -kWall);
}

TEST(CollisionWorld, aChargeThatReachesThroughAWallIsReleasedOnItsSide)
{
    Stage stage;
    stage.world().setField(wall());
    auto def = fireball();
    def->position.x = kWall - 0.1f;
    stage.add({}, std::move(def));
    for (int step = 0; step < 30; ++step) {
        stage.step();
        EXPECT_LT(extent(stage).second, kWall) << "step " << step;
    }
}

TEST(CollisionWorld, aChargeBesideASheetStaysOnItsSide)
{
    Stage stage;
    stage.world().setField(fieldOf(sheetMesh(12.0f), 0.3f)); // at x = 0
    auto def = fireball();
    def->position.x = 0.2f;
    stage.add({}, std::move(def));
    for (int step = 0; step < 40; ++step) {
        stage.step();
        EXPECT_GT(extent(stage).first, 0.0f) << "step " << step;
    }
}

TEST(CollisionWorld, aFragmentBouncesOffAWall)
{
    Stage stage;
    stage.world().setField(wall());
    auto def = oneFragment(12.0f);
    def->matter.bounce = 0.5f;
    def->matter.gravity = 0.0f;
    sim::InstanceStart start;
    start.placement.rotation =
        glm::angleAxis(-0.5f * std::numbers::pi_v<float>, glm::vec3(0, 0, 1)); // up is +x
    stage.add(start, std::move(def));
    stage.play(60); // 2 m in 1/6 s, then 5/6 s at 6 m/s
    const base::SnapshotGroup& group = stage.look().group(0);
    EXPECT_NEAR(group.column(blob::VelocityY)[0], -6.0f, 0.01f); // local y
    EXPECT_NEAR(group.column(blob::PositionY)[0], kWall - 5.0f, 0.1f);
}

TEST(CollisionWorld, emittedParticlesThatBounceDoSoAndOthersPass)
{
    Stage stage;
    stage.world().setField(wall());
    for (const float bounce : {0.2f, -1.0f}) {
        auto def = burstEmitter(50);
        def->speed = {20.0f, 20.0f};
        def->shape = sim::EmitterShape::Sphere;
        def->forces.gravity = 0.0f;
        def->forces.bounce = bounce;
        stage.add({}, std::move(def));
    }
    stage.play(30);
    EXPECT_LT(extent(stage, 0).second, kWall);
    EXPECT_GT(extent(stage, 1).second, kWall + 4.0f);
}

TEST(CollisionWorld, isTheSameForAnyNumberOfThreads)
{
    const uint64_t serial = hashAfter(base::makeSerialRunner(), 40);
    for (const uint32_t threads : {1u, 2u, 3u, 7u})
        EXPECT_EQ(hashAfter(threadedRunner(threads), 40), serial) << threads;
}

TEST(CollisionWorld, geometryThatIsFarAwayChangesNothing)
{
    const auto play = [](const std::shared_ptr<const sim::DistanceField>& field) {
        Stage stage;
        stage.world().setField(field);
        const sim::Slot slot = stage.add({}, fireball());
        stage.play(30);
        return stage.world().hash(std::array{slot});
    };
    EXPECT_EQ(play(nullptr), play(fieldOf(boxMesh({500, 500, 500}, {501, 501, 501}), 0.1f)));
}

TEST(CollisionWorld, instancesThatCollideShareOnlyAtTheSamePlace)
{
    Stage stage;
    sim::InstanceStart there;
    there.placement.position = {-30, 0, 0};
    auto effect = std::make_shared<sim::EffectDef>();
    effect->hasGround = false;
    effect->solvers.push_back(fireball(40));
    auto passing = std::make_shared<sim::EffectDef>();
    passing->solvers.push_back(burstEmitter(10));
    const std::array slots{stage.add({}, effect), stage.add({}, effect), stage.add(there, effect)};
    stage.add({}, passing);
    stage.add(there, passing);
    stage.play(5);
    EXPECT_EQ(stage.world().simulations(), 2u);
    stage.world().setField(wall());
    EXPECT_EQ(stage.world().simulations(), 3u);
    stage.play(40);
    EXPECT_EQ(stage.world().hash(std::array{slots[0]}), stage.world().hash(std::array{slots[1]}));
    EXPECT_NE(stage.world().hash(std::array{slots[0]}), stage.world().hash(std::array{slots[2]}));
    stage.world().setField(nullptr);
    stage.play(5);
}

TEST(CollisionWorld, aDividedSimulationIsWhatEachWouldHaveBeenAlone)
{
    const auto play = [](bool together) {
        Stage stage;
        auto effect = std::make_shared<sim::EffectDef>();
        effect->hasGround = false;
        effect->solvers.push_back(fireball(40));
        sim::InstanceStart there;
        there.placement.position = {-1, 0, 0};
        if (together)
            stage.add({}, effect);
        const sim::Slot slot = stage.add(there, effect);
        stage.play(8);
        stage.world().setField(wall());
        stage.play(20);
        return stage.world().hash(std::array{slot});
    };
    EXPECT_EQ(play(true), play(false));
}
