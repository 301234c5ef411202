#include "foundation/tasks/task_runner.h"
#include "simulation/particles/collisions/obstacles.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::sim;

namespace {

StepContext still()
{
    StepContext step{};
    step.groundHeight = -std::numeric_limits<float>::infinity();
    return step;
}

ContactLeg straight(const glm::vec3& from, const glm::vec3& to)
{
    return {from, to, to - from, glm::vec3(0.0f), 1.0f};
}

CollisionDef obstacle(ObstacleKind kind, const glm::vec3& size = glm::vec3(1.0f))
{
    CollisionDef def;
    def.kind = kind;
    def.size = size;
    return def;
}

/// What a fine walk along a leg finds first: an independent way.
double shareByWalking(const Obstacle& obstacle, const ContactLeg& leg)
{
    constexpr int kSteps = 200000;
    for (int i = 0; i <= kSteps; ++i) {
        const float s = float(i) / kSteps;
        if (obstacle.clearance(still(), leg.from + s * (leg.to - leg.from)).distance <= 0.0f)
            return double(s);
    }
    return 2.0;
}

std::shared_ptr<FieldGrid> heights(uint32_t n, float (*h)(float x, float z))
{
    auto grid = std::make_shared<FieldGrid>();
    grid->nodes = {n, 1, n};
    grid->low = {-5, 0, -5};
    grid->cell = glm::vec3(10.0f / float(n - 1));
    for (uint32_t z = 0; z < n; ++z)
        for (uint32_t x = 0; x < n; ++x)
            grid->values.push_back(h(-5.0f + grid->cell.x * float(x), -5.0f + grid->cell.z * float(z)));
    return grid;
}

} // namespace

TEST(Obstacles, aPlaneIsMetByTheParabolaItself)
{
    CollisionDef def = obstacle(ObstacleKind::Plane);
    def.axis = {0, 2, 0};
    def.position = {0, 1, 0};
    ContactLeg leg{{0, 11, 0}, {}, {3, 0, 0}, {0, -9.81f, 0}, 5.0f};
    leg.to = leg.at(leg.seconds);
    const LegContact contact = makeObstacle(def)->meet(still(), leg);
    ASSERT_TRUE(contact.found);
    const double t = std::sqrt(20.0 / 9.81);
    EXPECT_NEAR(double(contact.share) * 5.0, t, 1e-6);
    EXPECT_NEAR(contact.place.x, 3.0 * t, 1e-5);
    EXPECT_NEAR(contact.place.y, 1.0, 1e-5);
    EXPECT_EQ(contact.normal, glm::vec3(0, 1, 0));
}

TEST(Obstacles, aPlaneIsMetByAWayThatDipsBelowIt)
{
    ContactLeg leg{{0, 1, 0}, {}, {0, -3, 0}, {0, 6, 0}, 1.0f}; // 1 - 3 t + 3 t^2 is 0.25 at its lowest
    leg.to = leg.at(1.0f);
    CollisionDef def = obstacle(ObstacleKind::Plane);
    def.position.y = 0.26f;
    EXPECT_TRUE(makeObstacle(def)->meet(still(), leg).found);
    def.position.y = 0.24f;
    EXPECT_FALSE(makeObstacle(def)->meet(still(), leg).found);
}

TEST(Obstacles, aSphereIsMetAtTheRootOfItsEquation)
{
    const auto solid = makeObstacle(obstacle(ObstacleKind::Sphere, glm::vec3(2.0f)));
    // At height 1 the sphere begins at x = -sqrt(3).
    const LegContact contact = solid->meet(still(), straight({-10, 1, 0}, {10, 1, 0}));
    ASSERT_TRUE(contact.found);
    EXPECT_NEAR(double(contact.share), (10.0 - std::sqrt(3.0)) / 20.0, 1e-7);
    EXPECT_NEAR(glm::length(contact.place), 2.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(contact.normal, contact.place), 2.0f, 1e-6f);
    EXPECT_FALSE(solid->meet(still(), straight({-10, 2.001f, 0}, {10, 2.001f, 0})).found);
    EXPECT_FALSE(solid->meet(still(), straight({-10, 1, 0}, {-1.8f, 1, 0})).found);
    EXPECT_FALSE(solid->meet(still(), straight({10, 1, 0}, {20, 1, 0})).found) << "behind";

    CollisionDef def = obstacle(ObstacleKind::Sphere, glm::vec3(2.0f));
    def.isHollow = true;
    const LegContact exit = makeObstacle(def)->meet(still(), straight({0, 1, 0}, {10, 1, 0}));
    ASSERT_TRUE(exit.found);
    EXPECT_NEAR(double(exit.share), std::sqrt(3.0) / 10.0, 1e-7);
    EXPECT_LT(exit.normal.x, -0.8f);
    EXPECT_FALSE(makeObstacle(def)->meet(still(), straight({0, 1, 0}, {1.7f, 1, 0})).found);
}

TEST(Obstacles, aBoxIsMetWhereItsFaceIs)
{
    CollisionDef def = obstacle(ObstacleKind::Box, {1, 2, 3});
    def.position = {10, 0, 0};
    const auto box = makeObstacle(def);
    const LegContact contact = box->meet(still(), straight({0, 1, 1}, {20, 1.5f, 2}));
    ASSERT_TRUE(contact.found);
    EXPECT_NEAR(double(contact.share), 9.0 / 20.0, 1e-7);
    EXPECT_EQ(contact.normal, glm::vec3(-1, 0, 0));
    EXPECT_FALSE(box->meet(still(), straight({0, 2.1f, 0}, {20, 2.1f, 0})).found);
    EXPECT_FALSE(box->meet(still(), straight({12, 0, 0}, {20, 0, 0})).found);

    def.axis = {1, 0, 0}; // +Y onto +X: the half extent 2 lies along x
    const LegContact turned = makeObstacle(def)->meet(still(), straight({0, 0.5f, 0}, {20, 0.5f, 0}));
    ASSERT_TRUE(turned.found);
    EXPECT_NEAR(double(turned.share), 8.0 / 20.0, 1e-6);

    def.axis = {0, 1, 0};
    def.isHollow = true;
    const LegContact exit = makeObstacle(def)->meet(still(), straight({10, 0, 0}, {20, 0, 0}));
    ASSERT_TRUE(exit.found);
    EXPECT_NEAR(double(exit.share), 0.1, 1e-7);
    EXPECT_EQ(exit.normal, glm::vec3(-1, 0, 0));
}

TEST(Obstacles, aSheetOfAMillimeterStopsEveryWayThroughIt)
{
    const auto sheet = makeObstacle(obstacle(ObstacleKind::Box, {10, 0.0005f, 10}));
    for (const float seconds : {1e-4f, 1e-3f, 1.0f / 60.0f, 1.0f, 10.0f})
        for (int i = 0; i < 100; ++i) {
            const float way = 1e4f * seconds, part = (float(i) + 0.5f) / 100.0f;
            const LegContact contact =
                sheet->meet(still(), straight({0, part * way, 1}, {0, (part - 1.0f) * way, 1}));
            ASSERT_TRUE(contact.found) << seconds << " " << i;
            EXPECT_NEAR(contact.place.y, 0.0005f, 1e-6f * way + 1e-6f);
        }
}

TEST(Obstacles, heightsAreMetWhereAFineWalkMeetsThem)
{
    CollisionDef def = obstacle(ObstacleKind::HeightField);
    def.position = {0, 1, 0};
    def.heights = heights(21, [](float x, float z) { return std::sin(x) * std::cos(0.7f * z); });
    const auto land = makeObstacle(def);
    int met = 0;
    for (int i = 0; i < 60; ++i) {
        const float a = 0.37f * float(i);
        const ContactLeg leg =
            straight({4.5f * std::sin(a), 2.5f, 4.5f * std::cos(3.0f * a)},
                     {4.9f * std::cos(2.0f * a), -0.5f + 0.04f * float(i), 4.9f * std::sin(a)});
        const LegContact contact = land->meet(still(), leg);
        const double want = shareByWalking(*land, leg);
        ASSERT_EQ(contact.found, want <= 1.0) << i;
        if (contact.found) {
            ++met;
            EXPECT_NEAR(double(contact.share), want, 1e-4) << i;
            EXPECT_GT(contact.normal.y, 0.3f);
        }
    }
    EXPECT_GT(met, 30);
}

TEST(Obstacles, flatHeightsAreAPlaneThatEndsAtTheBorder)
{
    CollisionDef def = obstacle(ObstacleKind::HeightField);
    def.heights = heights(6, [](float, float) { return 2.0f; });
    def.margin = 0.5f;
    const auto land = makeObstacle(def);
    const LegContact contact = land->meet(still(), straight({-4, 12.5f, 4.9f}, {4, -7.5f, -4.9f}));
    ASSERT_TRUE(contact.found);
    EXPECT_NEAR(double(contact.share), 0.5, 1e-6);
    EXPECT_EQ(contact.normal, glm::vec3(0, 1, 0));
    EXPECT_FALSE(land->meet(still(), straight({5.1f, 10, 0}, {5.1f, -10, 0})).found);
    EXPECT_FALSE(land->meet(still(), straight({-20, 4, 0}, {20, 4, 0})).found);
}

TEST(Obstacles, aMeshIsMetThroughItsField)
{
    const std::vector<glm::vec3> corners{{-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}};
    const std::vector<uint32_t> indices{0, 2, 1, 0, 3, 2};
    const auto runner = base::makeSerialRunner();
    const auto field = DistanceField::build({glm::dvec3(0.0), corners, indices}, 0.1f, *runner,
                                            std::pmr::new_delete_resource());
    ASSERT_TRUE(field.ok()) << field.status().message();
    CollisionDef def = obstacle(ObstacleKind::Mesh);
    def.field = *field;
    def.position = {0, 3, 0};
    const LegContact contact = makeObstacle(def)->meet(still(), straight({0.3f, 13, 0}, {0.3f, -7, 0}));
    ASSERT_TRUE(contact.found);
    EXPECT_NEAR(contact.place.y, 3.0f, 0.01f);
    EXPECT_NEAR(contact.normal.y, 1.0f, 1e-3f);
}

TEST(Obstacles, groundSceneAndHookAreThereWhenTheHostGaveThem)
{
    for (const ObstacleKind kind : {ObstacleKind::Ground, ObstacleKind::Scene, ObstacleKind::Hook})
        EXPECT_FALSE(makeObstacle(obstacle(kind))->isThere(still()));
    StepContext step = still();
    step.groundHeight = -2.0f;
    EXPECT_TRUE(makeObstacle(obstacle(ObstacleKind::Ground))->isThere(step));
    EXPECT_FLOAT_EQ(makeObstacle(obstacle(ObstacleKind::Ground))->clearance(step, {0, 1, 0}).distance, 3.0f);

    const ContactHook half{nullptr, [](void*, const float*, const float*, float* share, float* normal) {
                               *share = 0.5f;
                               normal[2] = 7.0f;
                               return 1;
                           }};
    step.contactHook = &half;
    const auto hook = makeObstacle(obstacle(ObstacleKind::Hook));
    const LegContact contact = hook->meet(step, straight({0, 0, 4}, {0, 0, 0}));
    ASSERT_TRUE(hook->isThere(step) && contact.found);
    EXPECT_EQ(contact.place, glm::vec3(0, 0, 2));
    EXPECT_EQ(contact.normal, glm::vec3(0, 0, 1));
    const ContactHook nonsense{nullptr, [](void*, const float*, const float*, float* share, float*) {
                                   *share = std::nanf("");
                                   return 1;
                               }};
    step.contactHook = &nonsense;
    EXPECT_FALSE(hook->meet(step, straight({0, 0, 4}, {0, 0, 0})).found);
}
