// Clouds of hot gas that rise, and what they draw up after them.
#include "simulation/gas/gas_solver.h"
#include "tests/simulation/gas_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

struct Moment
{
    double height, radius; // [m]
};

/// A cloud that keeps its heat and meets no drag but that of the air which it takes in, every half second.
std::vector<Moment> thermal(float rolling)
{
    auto def = fireball(400);
    def->radiation = def->drag = def->braking = def->curlStrength = 0.0f;
    def->rolling = rolling;
    const double from = double(def->position.y);
    Stage stage;
    stage.add({}, std::move(def));
    std::vector<Moment> way;
    for (int i = 0; i < 20; ++i) {
        stage.play(30);
        const CloudShape shape = shapeOf(stage);
        way.push_back({shape.center.y - from, shape.radius});
    }
    return way;
}

double widening(const Moment& from, const Moment& to)
{
    return (to.radius - from.radius) / (to.height - from.height);
}

/// Dust that lies on the ground around the axis, light enough to follow the air.
std::unique_ptr<sim::EmitterDef> dust(float updraft)
{
    auto def = burstEmitter(400);
    def->shape = sim::EmitterShape::Box;
    def->position = {0.0f, 0.3f, 0.0f};
    def->size = {3.0f, 0.2f, 3.0f};
    def->forces.gravity = 0.0f;
    def->forces.drag = 20.0f;
    def->forces.bounce = 0.0f;
    def->forces.updraft = updraft;
    return def;
}

struct Spread
{
    double beside = 0, highest = 0; // [m] mean distance from the axis of what is below 1 m, largest height
};

Spread spreadOfDust(float updraft, bool withGas = true)
{
    Stage stage;
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(dust(updraft));
    if (withGas) {
        auto gas = fireball(200);
        gas->position = {0, 3, 0};
        effect->solvers.push_back(std::move(gas));
    }
    stage.add({}, effect);
    stage.play(120);
    const base::SnapshotGroup& group = stage.look().group(0);
    Spread spread;
    double low = 0;
    for (uint32_t i = 0; i < group.count(); ++i) {
        const glm::dvec3 p(CloudShape::row(group, blob::PositionX, i));
        EXPECT_GE(p.y, 0.0);
        spread.highest = std::max(spread.highest, p.y);
        if (p.y < 1.0) {
            spread.beside += std::hypot(p.x, p.z);
            ++low;
        }
    }
    spread.beside /= std::max(low, 1.0);
    return spread;
}

} // namespace

TEST(RisingCloud, drawsDustInOverTheGroundAndUp)
{
    const Spread drawn = spreadOfDust(1.0f), left = spreadOfDust(0.0f);
    EXPECT_LT(drawn.beside, 0.8 * left.beside);
    EXPECT_GT(drawn.highest, 3.0);
    EXPECT_LT(left.highest, 0.6);
}

TEST(RisingCloud, dustWithoutGasStaysWhereItIs)
{
    const Spread alone = spreadOfDust(1.0f, false), left = spreadOfDust(0.0f, false);
    EXPECT_EQ(alone.beside, left.beside);
    EXPECT_EQ(alone.highest, left.highest);
}

TEST(RisingCloud, dustAroundItHasTheSameBitsWithinAnyBudgetAndAfterARestore)
{
    const auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(dust(0.8f));
    effect->solvers.push_back(fireball(100));
    Stage whole, divided;
    const std::vector<sim::Slot> slots{whole.add({}, effect)}, others{divided.add({}, effect)};
    sim::StateBuffer saved(&whole.memory());
    for (int i = 0; i < 40; ++i) {
        if (i == 20)
            whole.world().save(slots, saved);
        whole.step();
        divided.world().beginStep(others, i * kStep, kStep);
        sim::StepCounters counters;
        for (bool isDone = false; !isDone;) {
            base::WorkBudget little(300);
            isDone = divided.world().proceed(little, counters);
        }
    }
    EXPECT_EQ(whole.world().hash(slots), divided.world().hash(others));

    Stage restored;
    std::vector<sim::Slot> again(1);
    const sim::World::Entry entry{effect, {}};
    sim::StateReader reader(saved.bytes());
    restored.world().restore(std::span(&entry, 1), reader, again);
    ASSERT_TRUE(reader.status().ok()) << reader.status().message();
    for (int i = 20; i < 40; ++i)
        restored.world().step(again, i * kStep, kStep);
    EXPECT_EQ(whole.world().hash(slots), restored.world().hash(again));
}

// Morton, Taylor, Turner 1956: a thermal takes in air at a quarter of its speed, so that its radius grows by
// a quarter of its rise, and the square of its height above a virtual origin grows evenly with time.
TEST(RisingCloud, widensByAQuarterOfItsRise)
{
    const std::vector<Moment> way = thermal(0.0f);
    EXPECT_NEAR(widening(way[9], way[19]), 0.25, 0.04);
    EXPECT_NEAR(widening(way[9], way[14]), widening(way[14], way[19]), 0.08);
}

TEST(RisingCloud, risesAsTheSquareRootOfTime)
{
    const std::vector<Moment> way = thermal(0.0f);
    const double origin = way[19].height - way[19].radius / 0.25;
    const auto square = [&](size_t i) { return std::pow(way[i].height - origin, 2.0); };
    const double first = square(14) - square(9), second = square(19) - square(14);
    EXPECT_NEAR(first / second, 1.0, 0.15);
}

TEST(RisingCloud, turningOverWidensItMore)
{
    const std::vector<Moment> way = thermal(1.0f);
    EXPECT_GT(widening(way[9], way[19]), 0.4);
    EXPECT_LT(widening(way[9], way[19]), 0.8);
}
