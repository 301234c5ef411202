#include "simulation/particles/collisions/collision_op.h"
#include "simulation/particles/event_record.h"
#include "tests/simulation/particles/modules/tile_stage.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

ParticleEvent eventOf(base::Ticks tick, uint32_t emitter, uint64_t index, EventKind kind)
{
    return {tick, index, emitter, kind, glm::vec3(0.0f), glm::vec3(0.0f)};
}

/// Makes events of all contacts.
class Listener final : public ContactListener
{
public:
    explicit Listener(EventList& out) : out_(out) {}
    void touch(const TileContext& context, const Tile& tile, uint32_t i, const TileContact& contact) override
    {
        out_.add(collisionOf(context, tile, i, contact));
    }

private:
    EventList& out_;
};

/// Ticks of the contacts of drops from different heights, when time is cut into steps of `step`.
std::vector<base::Ticks> contacts(base::Ticks step)
{
    CollisionDef plane;
    plane.restitution = 0.5f;
    const auto op = makeCollisionOp(std::span(&plane, 1));
    TileStage stage(20);
    for (uint32_t i = 0; i < 20; ++i) {
        stage.place(i, {0, 1.0f + 0.1f * float(i), 0}, {});
        stage.tile->indexLow[i] = i;
    }
    std::vector<base::Ticks> ticks;
    stage.step.stepTicks = step;
    for (base::Ticks now = 0; now < kTicksPerSecond * 8 / 10; now += step) {
        std::array<ParticleEvent, 64> room;
        EventList list(room);
        Listener listener(list);
        stage.context.listener = &listener;
        stage.context.end = now + step;
        stage.begin(float(base::toSeconds(step)));
        stage.fly({0, -9.81f, 0});
        stage.run(*op);
        list.sort();
        for (const ParticleEvent& event : list.events()) {
            EXPECT_GE(event.tick, now);
            EXPECT_LT(event.tick, now + step);
            EXPECT_EQ(event.kind, EventKind::Collision);
            ticks.push_back(event.tick);
        }
    }
    return ticks;
}

} // namespace

TEST(EventList, isAnsweredInTheOrderOfTickEmitterIndexAndKind)
{
    std::array<ParticleEvent, 8> room;
    EventList list(room);
    list.add(eventOf(5, 1, 3, EventKind::Death));
    list.add(eventOf(5, 1, 3, EventKind::Collision));
    list.add(eventOf(5, 0, 9, EventKind::Death));
    list.add(eventOf(2, 7, 0, EventKind::Birth));
    list.add(eventOf(5, 1, 2, EventKind::Death));
    list.sort();
    const auto events = list.events();
    ASSERT_EQ(events.size(), 5u);
    EXPECT_EQ(events[0].tick, 2);
    EXPECT_EQ(events[1].emitter, 0u);
    EXPECT_EQ(events[2].index, 2u);
    EXPECT_EQ(events[3].kind, EventKind::Collision);
    EXPECT_EQ(events[4].kind, EventKind::Death);
}

TEST(EventList, whatFindsNoRoomIsCounted)
{
    std::array<ParticleEvent, 2> room, more;
    EventList list(room), other(more);
    for (uint64_t i = 0; i < 3; ++i)
        other.add(eventOf(0, 0, i, EventKind::Birth));
    list.append(other);
    list.append(other);
    EXPECT_EQ(list.events().size(), 2u);
    EXPECT_EQ(list.dropped(), 4u);
}

TEST(EventList, aContactBelongsToTheStepThatSawIt)
{
    EXPECT_EQ(contactTick(100, 10, 0.0f), 100);
    EXPECT_EQ(contactTick(100, 10, 0.55f), 105);
    EXPECT_EQ(contactTick(100, 10, 1.0f), 109);
    EXPECT_EQ(contactTick(100, 1, 0.9f), 100);
    EXPECT_EQ(contactTick(100, 10, std::nanf("")), 100);
}

TEST(EventList, contactsAreWhereFreeFallTouchesForAnyStep)
{
    for (const int rate : {10, 30, 60, 144, 1000}) {
        const std::vector<base::Ticks> ticks = contacts(kTicksPerSecond / rate);
        ASSERT_EQ(ticks.size(), 20u) << rate;
        for (size_t i = 0; i < 20; ++i)
            EXPECT_NEAR(base::toSeconds(ticks[i]), std::sqrt(2.0 * (1.0 + 0.1 * double(i)) / 9.81), 2e-5)
                << rate;
    }
}

TEST(EventList, whatIsKilledHasACollisionAndADeathAtTheSurface)
{
    CollisionDef ball;
    ball.kind = ObstacleKind::Sphere;
    ball.response = ContactResponse::Kill;
    TileStage stage(1);
    stage.place(0, {-5, 0, 0}, {10, 0, 0});
    stage.step.stepTicks = kTicksPerSecond;
    stage.context.end = 3 * kTicksPerSecond;
    stage.begin(1.0f);
    stage.fly();
    std::array<ParticleEvent, 4> room;
    EventList list(room);
    Listener listener(list);
    stage.context.listener = &listener;
    stage.run(*makeCollisionOp(std::span(&ball, 1)));
    ASSERT_NE(stage.tile->flags[0] & tile_flag::Killed, 0u);
    list.add(killOf(stage.context, *stage.tile, 0));
    ASSERT_EQ(list.events().size(), 2u);
    EXPECT_TRUE(list.events()[0].isLast);
    EXPECT_NEAR(list.events()[0].speed, 10.0f, 1e-4f);
    for (const ParticleEvent& event : list.events()) {
        EXPECT_NEAR(base::toSeconds(event.tick), 2.4, 1e-6);
        EXPECT_NEAR(event.position.x, -1.0f, 1e-5f);
        EXPECT_FLOAT_EQ(event.velocity.x, 10.0f);
    }
    EXPECT_EQ(list.events()[1].kind, EventKind::Death);
}
