// World space where the time of the instance is not that of the steps: parts of steps, pauses, stops; and
// wind in the space that the particles keep to.
#include "tests/simulation/particles/events/moved.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;

namespace {

/// World x of all particles, ascending.
std::vector<double> sortedX(Stage& stage)
{
    std::vector<double> x;
    for (const glm::dvec3& p : worldPositions(stage.look()))
        x.push_back(p.x);
    std::sort(x.begin(), x.end());
    return x;
}

/// [m] widest gap between neighbors.
double widestGap(const std::vector<double>& x)
{
    double widest = 0;
    for (size_t i = 1; i < x.size(); ++i)
        widest = std::max(widest, x[i] - x[i - 1]);
    return widest;
}

/// One sprite, born in the first step, that the air takes along at once.
std::unique_ptr<EmitterDef> feather()
{
    auto def = dropper(0);
    def->emission.rate = 0;
    def->emission.bursts = {{0, 1}};
    def->forces.drag = 1000;
    return def;
}

} // namespace

TEST(MovedSteps, birthsLieEvenlyHoweverManyPartsAStepHas)
{
    for (const uint32_t parts : {1u, 4u, 16u})
        for (const uint32_t turns : {1u, 2u}) { // twice as fast is twice the parts and the births
            Stage stage;
            auto effect = linkedEffect(dropper(600));
            effect->subSteps = parts;
            InstanceStart start;
            start.rate = turns * kNormalRate;
            const Slot slot = stage.add(start, effect);
            stage.step(1); // begins at the origin
            for (int i = 1; i <= 30; ++i) {
                stage.world().setPlacement(slot, at(0.2 * i));
                stage.step();
            }
            const std::vector<double> x = sortedX(stage);
            ASSERT_GE(x.size(), 299u * turns);
            for (size_t i = 1; i < x.size(); ++i)
                ASSERT_NEAR(x[i] - x[i - 1], 0.02 / turns, 2e-5) << parts << " parts, birth " << i;
        }
}

TEST(MovedSteps, theInheritedVelocityIsThatOfTheStepHoweverManyPartsItHas)
{
    for (const uint32_t parts : {1u, 4u}) {
        Stage stage;
        auto def = dropper(2400);
        def->inheritVelocity = 1;
        auto effect = linkedEffect(std::move(def));
        effect->subSteps = parts;
        const Slot slot = stage.add({}, effect);
        stage.step(1);
        stage.world().setPlacement(slot, at(0.1)); // 6 m/s
        stage.step(kStep - 1);
        for (const double x : sortedX(stage)) // all go with the instance
            EXPECT_NEAR(x, 0.1, 1e-5) << parts;
    }
}

TEST(MovedSteps, nothingIsBornAlongTheWayOfSkippedTime)
{
    Stage stage;
    auto def = dropper(600);
    def->inheritVelocity = 1;
    const Slot slot = stage.add({}, std::move(def));
    stage.play(2);
    World& world = stage.world();
    world.hide(slot);
    world.passTime(stage.now() + 30 * kStep);
    world.setPlacement(slot, at(50));
    uint64_t budget = 1000;
    StepCounters counters;
    ASSERT_TRUE(world.catchUp(slot, CatchUp::Skip, kStep, budget, counters));
    world.show(slot);
    world.step(std::array{slot}, stage.now() + 30 * kStep, kStep);
    const std::vector<double> x = sortedX(stage);
    EXPECT_EQ(x.size(), 30u);
    for (const double at : x)
        EXPECT_TRUE(at == 0.0 || at == 50.0) << at;
}

TEST(MovedSteps, nothingIsBornAlongTheWayOfAnInstanceWhoseTimeStands)
{
    for (const bool hidden : {false, true}) {
        Stage stage;
        auto def = dropper(600);
        def->inheritVelocity = 1;
        const Slot slot = stage.add({}, std::move(def));
        stage.play(2);
        World& world = stage.world();
        base::Ticks now = stage.now();
        world.setRate(slot, 0);
        if (hidden)
            world.hide(slot);
        for (int i = 1; i <= 10; ++i, now += kStep) {
            world.setPlacement(slot, at(5.0 * i));
            if (hidden)
                world.passTime(now + kStep);
            else
                world.step(std::array{slot}, now, kStep);
        }
        world.setRate(slot, kNormalRate);
        uint64_t budget = 1000;
        StepCounters counters;
        if (hidden) {
            ASSERT_TRUE(world.catchUp(slot, CatchUp::Replay, kStep, budget, counters));
            world.show(slot);
        }
        world.step(std::array{slot}, now, kStep);
        const std::vector<double> x = sortedX(stage);
        EXPECT_EQ(x.size(), 30u);
        for (const double at : x)
            EXPECT_TRUE(at == 0.0 || at == 50.0) << at;
    }
}

TEST(MovedSteps, nothingIsBornAlongAMoveThatAJumpInTimeFollows)
{
    Stage stage;
    auto def = dropper(600);
    def->modules = {std::make_shared<Idle>()}; // no closed form: the jump takes steps
    const Slot slot = stage.add({}, std::move(def));
    stage.play(2);
    stage.world().setPlacement(slot, at(50));
    StepCounters counters;
    stage.world().seekTo(slot, 4 * kStep, kStep, counters);
    const std::vector<double> x = sortedX(stage);
    EXPECT_EQ(x.size(), 40u);
    EXPECT_EQ(widestGap(x), 50.0);
}

TEST(MovedSteps, windOfTheWorldKeepsItsSpeedWhenTheInstanceGrowsAndThatOfThePresetIsThatOfWhereItBegan)
{
    for (const bool ofHost : {true, false})
        for (const float first : {1.0f, 0.5f})
            for (const float turn : {0.0f, 1.0f}) {
                Stage stage;
                auto effect = linkedEffect(feather());
                InstanceStart start;
                start.placement = turnedAboutZ(0.0f);
                start.placement.scale = first;
                if (ofHost)
                    start.parameters.wind = {3, 0, 0};
                else
                    effect->wind = {3, 0, 0};
                const Slot slot = stage.add(start, effect);
                stage.step();
                const double before = sortedX(stage)[0];
                base::Placement grown = turnedAboutZ(turn);
                grown.scale = 2;
                stage.world().setPlacement(slot, grown);
                stage.play(60);
                const double along = ofHost ? 1.0 : double(first);
                EXPECT_NEAR(sortedX(stage)[0] - before, 3.0 * along, 0.02) << ofHost << first << turn;
            }
}

TEST(MovedSteps, windOfTheWorldIsTheSameBitForBitHoweverTheInstanceTurns)
{
    const auto play = [](float turn) {
        Stage stage;
        InstanceStart start;
        start.parameters.wind = {3, 1, -2};
        auto def = feather();
        def->forces.drag = 0.7f;
        def->forces.gravity = 1;
        const Slot slot = stage.add(start, std::move(def));
        stage.step();
        for (int i = 1; i <= 40; ++i) {
            stage.world().setPlacement(slot, turnedAboutZ(turn * float(i)));
            stage.step();
        }
        return worldPositions(stage.look());
    };
    EXPECT_EQ(play(0.1f), play(0.0f));
}
