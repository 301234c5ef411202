#include "rendering/reference/path/path_lights.h"

#include "tests/rendering/reference/path/path_statistics.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace fx::render {
namespace {

constexpr double kPi = std::numbers::pi;

/// Illuminance of a surface at `position` that faces `normal`.
Statistics illuminance(const PathLight& light, const glm::dvec3& position, const glm::dvec3& normal)
{
    Statistics statistics;
    for (uint32_t i = 0; i < 4096; ++i) {
        const LightSample sample = light.sample(position, PathSampler(4, 0, i).pair());
        EXPECT_NEAR(glm::length(sample.direction), 1.0, 1e-12);
        statistics.add(sample.illuminance.x * std::max(0.0, glm::dot(normal, sample.direction)));
    }
    return statistics;
}

TEST(PathLights, theSunGivesItsIlluminanceWhateverItsSize)
{
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, 0.8, -0.2));
    for (const double radius : {0.0, 0.00465, 0.2, 1.2}) {
        const Statistics facing = illuminance(SunLight(direction, glm::dvec3(5.0), radius), {}, direction);
        EXPECT_NEAR(facing.mean(), 5.0, 3.0 * facing.error() + 1e-12) << radius;
    }
}

TEST(PathLights, aBallGivesIntensityOverSquaredDistanceAtEveryDistance)
{
    const BallPathLight ball({1.0, 2.0, 3.0}, glm::dvec3(7.0), 0.5);
    for (const double distance : {0.51, 0.8, 3.0, 4000.0}) {
        const glm::dvec3 away = glm::normalize(glm::dvec3(-1.0, 0.4, 0.2));
        const Statistics facing = illuminance(ball, glm::dvec3(1.0, 2.0, 3.0) + distance * away, -away);
        EXPECT_NEAR(facing.mean() * distance * distance / 7.0, 1.0,
                    3.0 * facing.error() * distance * distance / 7.0 + 1e-9)
            << distance;
    }
}

TEST(PathLights, insideABallItsShellIsSeenInAllDirections)
{
    const BallPathLight ball({}, glm::dvec3(3.0), 2.0);
    const Statistics facing = illuminance(ball, {0.5, 0.1, 1.2}, {0, 1, 0});
    EXPECT_NEAR(facing.mean(), kPi * 3.0 / (kPi * 4.0), 3.0 * facing.error());
}

TEST(PathLights, aSpotShinesInItsConeOnly)
{
    const SpotPathLight spot({0, 4, 0}, {0, -1, 0}, glm::dvec3(9.0), 0.3, 0.6);
    EXPECT_NEAR(illuminance(spot, {}, {0, 1, 0}).mean(), 9.0 / 16.0, 1e-12);
    EXPECT_EQ(illuminance(spot, {0, 8, 0}, {0, -1, 0}).mean(), 0.0);
    EXPECT_EQ(illuminance(spot, {4.0 * std::tan(0.61), 0, 0}, {0, 1, 0}).mean(), 0.0);
    const double inner = spot.sample({4.0 * std::tan(0.31), 0, 0}, {}).illuminance.x;
    const double outer = spot.sample({4.0 * std::tan(0.59), 0, 0}, {}).illuminance.x;
    EXPECT_GT(inner, outer);
    EXPECT_GT(outer, 0.0);
    const SpotPathLight point({0, 4, 0}, {0, -1, 0}, glm::dvec3(9.0), kPi, kPi);
    EXPECT_NEAR(illuminance(point, {0, 7, 0}, {0, -1, 0}).mean(), 1.0, 1e-12);
}

} // namespace
} // namespace fx::render
