#include "simulation/gas/gas_thermal.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace fx;
using namespace fx::sim;

namespace {

ThermalFlow rising(float radius, float speed)
{
    ThermalFlow flow;
    flow.up = {0, 1, 0};
    flow.radius = radius;
    flow.speed = speed;
    return flow;
}

/// A ball of gas, evenly filled, all of it moving at `velocity`.
struct Ball
{
    Ball(uint32_t count, float radius, const glm::vec3& center, const glm::vec3& velocity)
        : x(count), y(count), z(count), vx(count, velocity.x), vy(count, velocity.y), vz(count, velocity.z),
          mass(count, 0.25f)
    {
        for (uint32_t i = 0; i < count;) {
            static uint64_t draw = 0;
            const auto u = base::randomUnit4(4, 0, draw++, base::RandomPurpose::Position);
            const glm::vec3 p = 2.0f * glm::vec3(u[0], u[1], u[2]) - 1.0f;
            if (glm::dot(p, p) > 1.0f)
                continue;
            x[i] = center.x + radius * p.x;
            y[i] = center.y + radius * p.y;
            z[i] = center.z + radius * p.z;
            ++i;
        }
    }
    GasView<const float> view()
    {
        GasView<const float> view{};
        view.count = uint32_t(x.size());
        view.x = x.data();
        view.y = y.data();
        view.z = z.data();
        view.vx = vx.data();
        view.vy = vy.data();
        view.vz = vz.data();
        view.mass = mass.data();
        return view;
    }
    std::vector<float> x, y, z, vx, vy, vz, mass;
};

} // namespace

TEST(ThermalFlow, hasTheKnownSpeedsOfHillsVortex)
{
    const ThermalFlow flow = rising(2.0f, 3.0f);
    EXPECT_NEAR(flow.velocity({0, 0, 0}).y, 7.5f, 1e-5f);        // 5/2 U in the middle
    EXPECT_NEAR(flow.velocity({0, 1.9999f, 0}).y, 3.0f, 2e-3f);  // U at the top: it moves with the sphere
    EXPECT_NEAR(flow.velocity({1.9999f, 0, 0}).y, -1.5f, 2e-3f); // down along the rim
    EXPECT_LT(flow.velocity({1.5f, -2.0f, 0}).x, 0.0f);          // in at the foot
    EXPECT_GT(flow.velocity({1.5f, 2.0f, 0}).x, 0.0f);           // out at the top
}

TEST(ThermalFlow, isContinuousAcrossTheSphere)
{
    const ThermalFlow flow = rising(1.0f, 2.0f);
    for (int i = 0; i < 100; ++i) {
        const auto u = base::randomUnit4(6, 0, uint64_t(i), base::RandomPurpose::Direction);
        const glm::vec3 direction = glm::normalize(glm::vec3(u[0], u[1], u[2]) - 0.5f);
        EXPECT_LT(glm::length(flow.velocity(direction * 0.99999f) - flow.velocity(direction * 1.00001f)),
                  5e-4f);
    }
}

TEST(ThermalFlow, hasNoDivergenceInsideOrOutside)
{
    const ThermalFlow flow = rising(1.0f, 2.0f);
    const float step = 1e-2f;
    for (int i = 0; i < 200; ++i) {
        const auto u = base::randomUnit4(6, 1, uint64_t(i), base::RandomPurpose::Position);
        const glm::vec3 p = 4.0f * (glm::vec3(u[0], u[1], u[2]) - 0.5f);
        if (std::abs(glm::length(p) - 1.0f) < 0.05f)
            continue; // differences across the surface
        float divergence = 0;
        for (int a = 0; a < 3; ++a) {
            glm::vec3 offset(0.0f);
            offset[a] = step;
            divergence += (flow.velocity(p + offset)[a] - flow.velocity(p - offset)[a]) / (2.0f * step);
        }
        ASSERT_NEAR(divergence, 0.0f, 5e-3f) << i;
    }
}

TEST(ThermalFlow, noAirPassesTheGround)
{
    ThermalFlow flow = rising(2.0f, 3.0f);
    flow.center = {1.0f, 1.5f, -2.0f}; // the sphere reaches below the ground
    for (float x = -6.0f; x < 6.0f; x += 0.25f)
        EXPECT_EQ(flow.velocityAbove(0.25f, {x, 0.25f, -2.0f}).y, 0.0f) << x;
    EXPECT_LT(flow.velocityAbove(0.25f, {2.5f, 0.25f, -2.0f}).x, 0.0f) << "it blows in over the ground";
    EXPECT_GT(flow.velocityAbove(0.25f, {1.0f, 0.75f, -2.0f}).y, 0.0f) << "and up from there";
}

TEST(ThermalFlow, farGroundAndNoneAreTheSame)
{
    const ThermalFlow flow = rising(2.0f, 3.0f);
    const glm::vec3 place(1.0f, 0.5f, 0.0f);
    const float none = -std::numeric_limits<float>::infinity();
    EXPECT_EQ(flow.velocityAbove(none, place), flow.velocity(place));
    EXPECT_LT(glm::length(flow.velocityAbove(-1000.0f, place) - flow.velocity(place)), 1e-6f);
}

TEST(ThermalFlow, measuresTheBallThatTheGasFills)
{
    Ball gas(4000, 3.0f, {1, 5, 2}, {4, 2, 0});
    const ThermalFlow flow = measureThermal(gas.view(), {0, -9.8f, 0}, {4, 0, 0});
    EXPECT_NEAR(flow.radius, 3.0f, 0.06f);
    EXPECT_NEAR(flow.speed, 2.0f, 1e-4f); // the drift with the wind is no rise
    EXPECT_NEAR(glm::length(flow.center - glm::vec3(1, 5, 2)), 0.0f, 0.1f);
}

TEST(ThermalFlow, doesNotLiftTheCloudThatMakesIt)
{
    Ball gas(500, 3.0f, {0, 5, 0}, {0, 2, 0});
    const ThermalFlow flow = measureThermal(gas.view(), {0, -9.8f, 0}, glm::vec3(0.0f));
    glm::dvec3 sum(0.0);
    for (uint32_t i = 0; i < 500; ++i)
        sum += glm::dvec3(flow.circulation({gas.x[i], gas.y[i], gas.z[i]}));
    EXPECT_LT(glm::length(sum) / 500.0, 1e-5);
}

TEST(ThermalFlow, heavyParticlesDecideWhereTheCloudIs)
{
    Ball gas(200, 1.0f, {0, 0, 0}, {0, 1, 0});
    gas.x[0] = 100.0f;
    gas.mass[0] = 1e6f;
    EXPECT_NEAR(measureThermal(gas.view(), {0, -9.8f, 0}, glm::vec3(0.0f)).center.x, 100.0f, 0.01f);
}

TEST(ThermalFlow, aFallingCloudAndOneWithoutGravityMakeNone)
{
    Ball falling(50, 1, {}, {0, -2, 0});
    Ball floating(50, 1, {}, {0, 2, 0});
    EXPECT_FALSE(measureThermal(falling.view(), {0, -9.8f, 0}, glm::vec3(0.0f)).active());
    EXPECT_FALSE(measureThermal(floating.view(), glm::vec3(0.0f), glm::vec3(0.0f)).active());
}
