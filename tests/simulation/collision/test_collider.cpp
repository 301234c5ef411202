#include "simulation/collision/collider.h"

#include "tests/simulation/collision/shapes.h"

using namespace fx;
using namespace fx::test;

namespace {

/// A wall 0.4 m thick around the plane x = 0.
std::shared_ptr<const sim::DistanceField> wallField()
{
    return fieldOf(boxMesh({-0.2f, -3, -3}, {0.2f, 3, 3}), 0.1f);
}

const sim::SurfaceResponse kElastic{0.0f, 1.0f, 0.0f};

} // namespace

TEST(Collider, aWayEndsWhereTheWallBegins)
{
    const auto field = wallField();
    const sim::Collider collider(*field, {});
    const auto hit = collider.sweep({-2, 0.03f, 0.04f}, {2, 0.03f, 0.04f});
    ASSERT_TRUE(hit.found);
    EXPECT_NEAR(-2.0f + 4.0f * hit.share, -0.2f, 0.001f);
    EXPECT_NEAR(hit.normal.x, -1.0f, 1e-5f);
    EXPECT_FALSE(collider.sweep({-2, 0, 0}, {-0.3f, 2, 1}).found);
    EXPECT_FALSE(collider.sweep({-2, 4, 0}, {2, 4, 0}).found); // above it
}

TEST(Collider, noSpeedAndNoAngleLeadsThroughAThinWall)
{
    for (const auto& field :
         {fieldOf(sheetMesh(3.0f), 0.1f), fieldOf(boxMesh({-0.02f, -3, -3}, {0.02f, 3, 3}), 0.1f),
          wallField(), fieldOf(sheetMesh(3.0f), 0.037f)})
    {
        const sim::Collider collider(*field, {});
        for (uint32_t i = 0; i < 2000; ++i) {
            const glm::vec3 u = quasiRandom(i), v = quasiRandom(i + 7000);
            const glm::vec3 from(-0.35f - std::abs(u.x), u.y, u.z);
            const glm::vec3 to(0.3f + 900.0f * v.x * v.x, v.y, v.z);
            glm::vec3 position = to, velocity = 60.0f * (to - from);
            EXPECT_TRUE(collider.settle(from, position, velocity, {0.05f, 0.1f, 0.0f}));
            EXPECT_LT(position.x, 0.0f);
            position = to;
            velocity = 60.0f * (to - from);
            EXPECT_TRUE(collider.bounce(from, position, velocity, kElastic, 1.0f / 60.0f));
            EXPECT_LT(position.x, 0.0f);
        }
    }
}

TEST(Collider, aBounceTurnsTheNormalVelocityAndKeepsTheTangent)
{
    const auto field = wallField();
    const sim::Collider collider(*field, {});
    glm::vec3 position(0.8f, 0.5f, 0.0f), velocity(1.0f, 0.5f, 0.0f);
    ASSERT_TRUE(collider.bounce({-0.7f, 0, 0}, position, velocity, {0.0f, 0.5f, 0.25f}, 1.5f));
    EXPECT_NEAR(velocity.x, -0.5f, 1e-4f);
    EXPECT_NEAR(velocity.y, 0.375f, 1e-4f);
    EXPECT_NEAR(position.x, -0.7f, 0.01f); // half a second there, one back at half the speed
}

TEST(Collider, aWayThatSettlesSlidesAlongTheWall)
{
    const auto field = wallField();
    const sim::Collider collider(*field, {});
    glm::vec3 position(1.0f, 1.5f, 0.0f), velocity(1.0f, 1.5f, 0.0f);
    ASSERT_TRUE(collider.settle({-1, 0, 0}, position, velocity, {0.15f, 0.0f, 0.0f}));
    EXPECT_NEAR(position.x, -0.35f, 1e-3f);
    EXPECT_NEAR(position.y, 1.5f, 0.01f);
    EXPECT_NEAR(velocity.x, 0.0f, 1e-5f);
    EXPECT_EQ(velocity.y, 1.5f);
}

TEST(Collider, nothingIsChangedByAWallThatIsNotMet)
{
    const auto field = wallField();
    const sim::Collider collider(*field, {});
    glm::vec3 position(-1.5f, 0.5f, 0.25f), velocity(1.0f, 2.0f, 3.0f);
    EXPECT_FALSE(collider.settle({-2, 0, 0}, position, velocity, {0.1f, 1.0f, 0.0f}));
    EXPECT_FALSE(collider.bounce({-2, 0, 0}, position, velocity, {0.1f, 1.0f, 0.0f}, 1.0f));
    EXPECT_EQ(position, glm::vec3(-1.5f, 0.5f, 0.25f));
    EXPECT_EQ(velocity, glm::vec3(1.0f, 2.0f, 3.0f));
}

TEST(Collider, whatIsInsideIsPushedOutAndKeepsItsClearance)
{
    const auto field = wallField();
    const sim::Collider collider(*field, {});
    glm::vec3 position(0.1f, 0.5f, 0.0f), velocity(-1.0f, 0.0f, 0.0f);
    ASSERT_TRUE(collider.settle(position, position, velocity, {0.15f, 0.0f, 0.0f}));
    EXPECT_NEAR(position.x, 0.35f, 1e-4f);
    EXPECT_NEAR(velocity.x, 0.0f, 1e-5f);
}

TEST(Collider, speedNeverGrows)
{
    const auto field = fieldOf(sphereMesh(0.7f, 20), 0.05f);
    const sim::Collider collider(*field, {});
    for (uint32_t i = 0; i < 3000; ++i) {
        const glm::vec3 from = 0.9f * quasiRandom(i);
        glm::vec3 velocity = 20.0f * quasiRandom(i + 5000), position = from + velocity / 60.0f;
        const float speed = glm::length(velocity);
        collider.bounce(from, position, velocity, kElastic, 1.0f / 60.0f);
        EXPECT_LE(glm::length(velocity), speed * 1.00001f);
        if (field->distance(from) > 0.0f) {
            EXPECT_GT(field->distance(position), -1e-5f);
        }
    }
}

TEST(Collider, turnedMovedAndScaledInstancesMeetTheSameWall)
{
    const auto field = wallField();
    base::Placement placement;
    placement.position = {-1, 0, 0};
    placement.scale = 2.0f;
    placement.rotation = glm::angleAxis(0.5f * std::numbers::pi_v<float>, glm::vec3(0, 1, 0)); // z to x
    const sim::Collider collider(*field, placement);
    const auto sample = collider.sample({0, 0, 0.1f}); // at x = -0.8 of the world
    EXPECT_NEAR(sample.distance, 0.3f, 1e-5f);
    EXPECT_NEAR(sample.normal.z, -1.0f, 1e-5f);
    const auto hit = collider.sweep({0, 0, 0}, {0, 0, 1});
    ASSERT_TRUE(hit.found);
    EXPECT_NEAR(hit.share, 0.4f, 0.002f);
    EXPECT_NEAR(hit.normal.z, -1.0f, 1e-5f);
}
