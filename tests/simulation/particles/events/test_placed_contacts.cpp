// When and where the contact function of the host is asked.
#include "simulation/particles/collisions/collision_op.h"
#include "tests/simulation/particles/events/moved.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;

namespace {

/// A floor at world height 0 that keeps how high the highest question about it was.
struct Floor
{
    int asked = 0;
    double highest = -1e9;

    static int meet(void* user, const double from[3], const double to[3], float* outShare, float outNormal[3])
    {
        Floor& floor = *static_cast<Floor*>(user);
        ++floor.asked;
        floor.highest = std::max(floor.highest, from[1]);
        if (to[1] >= 0.0 || from[1] < to[1])
            return 0;
        *outShare = from[1] > 0.0 ? float(from[1] / (from[1] - to[1])) : 0.0f;
        outNormal[0] = outNormal[2] = 0.0f;
        outNormal[1] = 1.0f;
        return 1;
    }
};

/// Sprites that fall and ask the host.
std::shared_ptr<EffectDef> hail(bool inWorld)
{
    auto def = burstEmitter(16);
    def->appearance.kind = AppearanceKind::Sprite;
    def->inWorld = inWorld;
    CollisionDef collision;
    collision.kind = ObstacleKind::Hook;
    def->modules = {makeCollisionOp(std::array{collision})};
    return linkedEffect(std::move(def));
}

InstanceStart startAt(double y)
{
    InstanceStart start;
    start.placement = at(0, y);
    return start;
}

/// A world whose state another one restores.
class TwoWorlds : public testing::Test
{
protected:
    TwoWorlds() { static_cast<void>(schema.add(base::kParticleKind)); }

    Floor floor;
    base::SnapshotSchema schema;
    base::HostMemory memory;
    std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();
    std::shared_ptr<EffectDef> effect = hail(false);
    World world{&schema, tasks.get(), &memory}, other{&schema, tasks.get(), &memory};
    StateBuffer state{&memory};
};

} // namespace

TEST(PlacedContacts, aHookIsNotAskedAboutTheTimeBeforeItWasThere)
{
    for (const bool inWorld : {false, true}) {
        Floor floor;
        Stage stage;
        const Slot slot = stage.add(startAt(5), hail(inWorld));
        World& world = stage.world();
        world.step(std::array{slot}, 0, kStep);
        world.hide(slot);
        world.passTime(30 * kStep);
        world.setContact({&floor, &Floor::meet});
        world.passTime(40 * kStep);
        uint64_t budget = 1u << 20;
        StepCounters counters;
        ASSERT_TRUE(world.catchUp(slot, CatchUp::Replay, kStep, budget, counters));
        EXPECT_EQ(floor.asked, 10 * 16);
        // After 30 steps from 5 m, to half a step: 3.77 m.
        EXPECT_NEAR(floor.highest, 5.0 - 0.5 * 9.80665 * 0.25, 0.05);
    }
}

TEST_F(TwoWorlds, aStateOfInstancesThatShareIsRestoredWhereAHookIs)
{
    const std::array<World::Entry, 3> entries{
        {{effect, startAt(5)}, {effect, startAt(50)}, {effect, startAt(5)}}};
    std::array<Slot, 3> slots{}, restored{};
    for (size_t i = 0; i < slots.size(); ++i)
        slots[i] = world.add(effect, entries[i].start);
    for (int i = 0; i < 20; ++i)
        world.step(slots, i * kStep, kStep);
    ASSERT_EQ(world.simulations(), 1u);
    world.save(slots, state);
    for (World* each : {&world, &other})
        each->setContact({&floor, &Floor::meet});
    StateReader reader(state.bytes());
    other.restore(entries, reader, restored);
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    other.setNow(20 * kStep);
    EXPECT_EQ(other.simulations(), 2u);
    for (int i = 20; i < 120; ++i) {
        world.step(slots, i * kStep, kStep);
        other.step(restored, i * kStep, kStep);
    }
    EXPECT_EQ(world.hash(slots), other.hash(restored));
    EXPECT_NE(other.hash(std::array{restored[0]}), other.hash(std::array{restored[1]})); // 50 m: not yet down
}

TEST_F(TwoWorlds, statesWhoseInstancesDifferInMoreThanTheirPlacesAreRefused)
{
    std::array<World::Entry, 2> entries{{{effect, startAt(5)}, {effect, startAt(50)}}};
    std::array<Slot, 2> slots{}, restored{};
    for (size_t i = 0; i < slots.size(); ++i)
        slots[i] = world.add(effect, entries[i].start);
    world.save(slots, state);
    other.setContact({&floor, &Floor::meet});
    entries[1].start.seed = 7;
    StateReader reader(state.bytes());
    other.restore(entries, reader, restored);
    EXPECT_FALSE(reader.ok());
}
