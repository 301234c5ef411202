#include "simulation/particles/collisions/collision_op.h"
#include "tests/foundation/every_set.h"
#include "tests/simulation/particles/modules/tile_stage.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;

namespace {

const glm::vec3 kGravity(0.0f, -9.81f, 0.0f);

CollisionDef obstacle(ObstacleKind kind, float restitution, float friction = 0.0f)
{
    CollisionDef def;
    def.kind = kind;
    def.restitution = restitution;
    def.friction = friction;
    return def;
}

std::unique_ptr<TileOp> opOf(std::vector<CollisionDef> defs)
{
    return makeCollisionOp(defs);
}

void step(TileStage& stage, const TileOp& op, float seconds, const glm::vec3& gravity = kGravity)
{
    stage.begin(seconds);
    stage.fly(gravity);
    stage.run(op);
}

} // namespace

TEST(ContactPath, aDropRisesToTheSquareOfTheRestitutionForAnyStep)
{
    const auto op = opOf({obstacle(ObstacleKind::Plane, 0.7f)});
    for (const float seconds : {1.0f / 240.0f, 1.0f / 60.0f, 0.1f, 0.37f}) {
        TileStage stage;
        stage.place(0, {0, 2, 0}, {1, 0, 0});
        float highest = 0;
        bool bounced = false;
        for (double t = 0; t < 1.35; t += double(seconds)) { // up to the second bounce
            step(stage, *op, seconds);
            bounced = bounced || (stage.tile->flags[0] & tile_flag::Hit) != 0;
            if (bounced) // height that the energy above the plane reaches
                highest =
                    std::max(highest, stage.position().y + stage.velocity().y * stage.velocity().y / 19.62f);
            if (stage.tile->flags[0] & tile_flag::Hit)
                highest = stage.position().y + stage.velocity().y * stage.velocity().y / 19.62f;
        }
        EXPECT_NEAR(highest, 2.0f * 0.7f * 0.7f, 1e-4f) << seconds;
        EXPECT_FLOAT_EQ(stage.velocity().x, 1.0f);
    }
}

TEST(ContactPath, theContactIsWhereFreeFallTouches)
{
    const auto op = opOf({obstacle(ObstacleKind::Plane, 0.5f)});
    TileStage stage;
    stage.place(0, {0, 1, 0}, {});
    step(stage, *op, 1.0f);
    EXPECT_NEAR(stage.tile->contact[0], std::sqrt(2.0 / 9.81), 1e-6);
    EXPECT_EQ(stage.tile->flags[0], uint32_t(tile_flag::Hit | tile_flag::Collided));
}

TEST(ContactPath, whatRestsStaysAndSlidesWithoutSinking)
{
    const auto op = opOf({obstacle(ObstacleKind::Plane, 0.0f)});
    TileStage stage;
    stage.place(0, {0, 0.01f, 0}, {2, 0, 0});
    for (int i = 0; i < 600; ++i)
        step(stage, *op, 1.0f / 60.0f);
    EXPECT_NEAR(stage.position().y, 0.0f, 1e-4f);
    EXPECT_GE(stage.position().y, 0.0f);
    EXPECT_NEAR(stage.position().x, 20.0f, 1e-2f);
    EXPECT_NEAR(stage.velocity().y, 0.0f, 1e-3f);
}

TEST(ContactPath, frictionTakesItsShareOfTheTangentialSpeed)
{
    const auto op = opOf({obstacle(ObstacleKind::Plane, 1.0f, 0.25f)});
    TileStage stage;
    stage.place(0, {0, 1, 0}, {4, -10, 0});
    step(stage, *op, 0.15f, glm::vec3(0.0f));
    EXPECT_FLOAT_EQ(stage.velocity().x, 3.0f);
    EXPECT_FLOAT_EQ(stage.velocity().y, 10.0f);
}

TEST(ContactPath, nothingTunnelsThroughAMillimeterAtAnySpeedAndStep)
{
    CollisionDef sheet = obstacle(ObstacleKind::Box, 0.3f);
    sheet.size = {1e6f, 0.0005f, 1e6f};
    const auto op = opOf({sheet});
    for (const float seconds : {1e-5f, 1e-3f, 1.0f / 60.0f, 0.5f, 3.0f}) {
        TileStage stage(200);
        for (uint32_t i = 0; i < 200; ++i)
            stage.place(i, {0, 0.001f + 0.01f * float(i), 0}, {100, -1e4f, 3});
        for (int k = 0; k < 200; ++k) {
            step(stage, *op, seconds);
            for (uint32_t i = 0; i < 200; ++i)
                ASSERT_GE(stage.position(i).y, 0.0004f) << seconds << " " << k << " " << i;
        }
    }
}

TEST(ContactPath, nothingLeavesAHollowSphereOrBox)
{
    CollisionDef ball = obstacle(ObstacleKind::Sphere, 0.9f);
    ball.isHollow = true;
    ball.size = glm::vec3(2.0f);
    CollisionDef box = obstacle(ObstacleKind::Box, 0.9f);
    box.isHollow = true;
    box.size = {1, 1.2f, 1.4f};
    box.axis = {1, 2, 3};
    const auto op = opOf({ball, box});
    TileStage stage(256);
    for (uint32_t i = 0; i < 256; ++i)
        stage.place(i, {0.3f * std::sin(float(i)), 0.2f, 0},
                    40.0f * glm::vec3(std::cos(float(i)), std::sin(3.0f * float(i)), 1));
    for (int k = 0; k < 300; ++k) {
        step(stage, *op, 1.0f / 30.0f);
        for (uint32_t i = 0; i < 256; ++i)
            ASSERT_LT(glm::length(stage.position(i)), 2.0f) << k << " " << i;
    }
}

TEST(ContactPath, theObstacleThatComesFirstDecides)
{
    CollisionDef kill = obstacle(ObstacleKind::Plane, 0);
    kill.response = ContactResponse::Kill;
    kill.position.y = -1.0f;
    for (const bool killFirst : {false, true}) {
        std::vector<CollisionDef> defs{obstacle(ObstacleKind::Plane, 0.5f), kill};
        if (killFirst)
            std::swap(defs[0], defs[1]);
        TileStage stage;
        stage.place(0, {0, 1, 0}, {0, -100, 0});
        step(stage, *opOf(defs), 0.1f);
        EXPECT_EQ(stage.tile->flags[0] & tile_flag::Killed, 0u);
        EXPECT_GT(stage.position().y, 0.0f);
    }
}

TEST(ContactPath, killAndStickEndTheWayAtTheContact)
{
    for (const ContactResponse response : {ContactResponse::Kill, ContactResponse::Stick}) {
        CollisionDef ball = obstacle(ObstacleKind::Sphere, 0.5f);
        ball.size = glm::vec3(1.0f);
        ball.response = response;
        const auto op = opOf({ball});
        TileStage stage;
        stage.place(0, {-5, 0, 0}, {10, 0, 0});
        step(stage, *op, 1.0f, glm::vec3(0.0f));
        EXPECT_NEAR(stage.position().x, -1.0f, 1e-5f);
        EXPECT_NEAR(stage.tile->contact[0], 0.4f, 1e-6f);
        const uint32_t want = response == ContactResponse::Kill ? tile_flag::Killed : tile_flag::Stuck;
        EXPECT_EQ(stage.tile->flags[0], want | tile_flag::Hit | tile_flag::Collided);
        EXPECT_EQ(op->keepsFlags(), response == ContactResponse::Stick);
    }
}

TEST(ContactPath, whatBeginsInsideIsPutOutside)
{
    CollisionDef ball = obstacle(ObstacleKind::Sphere, 0.5f);
    ball.size = glm::vec3(1.0f);
    const auto op = opOf({ball, obstacle(ObstacleKind::Plane, 0.5f)});
    TileStage stage(2);
    stage.place(0, {0.5f, 0.4f, 0}, {});
    stage.place(1, {7, -3, 0}, {});
    step(stage, *op, 0.01f);
    EXPECT_GE(glm::length(stage.position(0)), 1.0f);
    EXPECT_GE(stage.position(1).y, 0.0f);
}

TEST(ContactPath, rowsThatAreFarAreLeftAsTheyAreBitForBit)
{
    CollisionDef ball = obstacle(ObstacleKind::Sphere, 0.5f);
    ball.position = {100, 0, 0};
    const auto op = opOf({ball, obstacle(ObstacleKind::Plane, 0.5f)});
    TileStage stage(50), free(50);
    for (uint32_t i = 0; i < 50; ++i)
        for (TileStage* s : {&stage, &free})
            s->place(i, {float(i), 10.1f, 0.3f}, {1, 0.2f * float(i), 0});
    step(stage, *op, 0.1f);
    free.begin(0.1f);
    free.fly(kGravity);
    for (uint32_t i = 0; i < 50; ++i)
        ASSERT_EQ(stage.position(i), free.position(i));
}

TEST(ContactPath, givesTheSameBitsWithEveryInstructionSet)
{
    CollisionDef ball = obstacle(ObstacleKind::Sphere, 0.6f, 0.1f);
    ball.size = glm::vec3(1.0f);
    const auto op = opOf({ball, obstacle(ObstacleKind::Plane, 0.5f, 0.2f)});
    const auto play = [&] {
        TileStage stage(256);
        for (uint32_t i = 0; i < 256; ++i)
            stage.place(i, {std::sin(float(i)), 2.0f + 0.01f * float(i), std::cos(float(i))},
                        {0.1f, -1, 0.2f});
        for (int k = 0; k < 200; ++k)
            step(stage, *op, 1.0f / 60.0f);
        std::vector<float> all(stage.tile->x, stage.tile->x + 256);
        all.insert(all.end(), stage.tile->vy, stage.tile->vy + 256);
        return all;
    };
    const std::vector<float> want = play();
    test::everySet([&](base::InstructionSet) { EXPECT_EQ(play(), want); });
}

TEST(ContactPath, tellsWhetherItDependsOnTheHostsGeometry)
{
    EXPECT_TRUE(opOf({obstacle(ObstacleKind::Scene, 0)})->collides());
    EXPECT_FALSE(opOf({obstacle(ObstacleKind::Ground, 0)})->collides());
}
