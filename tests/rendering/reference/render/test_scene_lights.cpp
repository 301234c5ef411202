/// Light of sun, sky and lamps where nothing stands in its way.

#include "rendering/reference/render/scene_lights.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kPi = std::numbers::pi;

SceneLights lightsOf(const OpaqueScene& scene, int skyRings = 4)
{
    SceneLights lights;
    lights.build(scene, glm::dvec3(0.0), skyRings);
    return lights;
}

OpaqueScene lampAt(const glm::dvec3& position, float intensity, float radius = 0.0f)
{
    OpaqueScene scene;
    SceneLight lamp;
    lamp.position = position;
    lamp.intensity = glm::vec3(intensity);
    lamp.radius = radius;
    scene.lamps.push_back(lamp);
    return scene;
}

/// [lx] of a surface with the normal `normal`.
double illuminance(const OpaqueScene& scene, const glm::dvec3& point, const glm::dvec3& normal)
{
    std::vector<ArrivingLight> arriving;
    lightsOf(scene).appendLamp(0, point, 0.3, arriving);
    double sum = 0.0;
    for (const ArrivingLight& light : arriving) {
        EXPECT_NEAR(glm::length(light.direction), 1.0, 1e-12);
        sum += light.illuminance.x * std::max(0.0, glm::dot(normal, light.direction));
    }
    return sum;
}

TEST(SceneLights, directionsOfAConeIntegratePolynomialsExactly)
{
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    for (const double height : {1e-12, 0.02, 1.0, 2.0}) {
        std::vector<ArrivingLight> cone;
        appendCone(axis, height, 3, 5, 0.4, cone);
        ASSERT_EQ(cone.size(), 15u);
        double solidAngle = 0.0, squares = 0.0;
        glm::dvec3 mean(0.0);
        for (const ArrivingLight& light : cone) {
            solidAngle += light.solidAngle;
            mean += light.solidAngle * light.direction;
            const double c = glm::dot(light.direction, axis);
            squares += light.solidAngle * c * c;
        }
        const double rim = 1.0 - height;
        EXPECT_NEAR(solidAngle / (2.0 * kPi * height), 1.0, 1e-12);
        // integrals of c and c^2 from the rim to 1; the mean direction is the axis
        EXPECT_NEAR(glm::length(mean - axis * kPi * height * (1.0 + rim)), 0.0, 1e-12);
        EXPECT_NEAR(squares, 2.0 * kPi / 3.0 * height * (1.0 + rim + rim * rim), 1e-12);
    }
}

TEST(SceneLights, aPointObeysTheInverseSquareLaw)
{
    for (const double distance : {1e-3, 1.0, 300.0}) {
        const OpaqueScene scene = lampAt({0.0, distance, 0.0}, 7.0f);
        EXPECT_NEAR(illuminance(scene, {}, {0, 1, 0}) * distance * distance, 7.0, 1e-12);
        EXPECT_NEAR(illuminance(scene, {}, {0.8, 0.6, 0}) * distance * distance, 4.2, 1e-12);
    }
}

TEST(SceneLights, aBallGivesIntensityOverSquaredDistanceAtEveryDistance)
{
    const glm::dvec3 away = glm::normalize(glm::dvec3(-1.0, 0.4, 0.2));
    for (const double distance : {0.51, 0.8, 3.0, 4000.0}) {
        const OpaqueScene scene = lampAt(distance * away, 7.0f, 0.5f);
        EXPECT_NEAR(illuminance(scene, {}, away) * distance * distance, 7.0, 1e-9) << distance;
    }
}

TEST(SceneLights, lightOfABallComesFromTheNearSideOfItsSurface)
{
    const OpaqueScene scene = lampAt({0.0, 3.0, 0.0}, 7.0f, 0.5f);
    std::vector<ArrivingLight> arriving;
    lightsOf(scene).appendLamp(0, {}, 0.0, arriving);
    for (const ArrivingLight& light : arriving) {
        const glm::dvec3 place = light.direction * light.distance;
        EXPECT_NEAR(glm::length(place - scene.lamps[0].position), 0.5, 1e-12);
        EXPECT_LT(place.y, 3.0);
    }
}

TEST(SceneLights, insideABallItsShellIsSeenInAllDirections)
{
    const OpaqueScene scene = lampAt({0.5, 0.1, 1.2}, 3.0f, 2.0f);
    EXPECT_NEAR(illuminance(scene, {}, {0, 1, 0}), kPi * 3.0 / (kPi * 4.0), 1e-9);
    std::vector<ArrivingLight> arriving;
    lightsOf(scene).appendLamp(0, {}, 0.0, arriving);
    for (const ArrivingLight& light : arriving)
        EXPECT_NEAR(glm::length(light.direction * light.distance - scene.lamps[0].position), 2.0, 1e-12);
}

TEST(SceneLights, aSpotShinesInItsConeOnly)
{
    OpaqueScene scene = lampAt({0, 4, 0}, 9.0f);
    scene.lamps[0].innerAngle = 0.3f;
    scene.lamps[0].outerAngle = 0.6f;
    // [lx] at an angle to the axis, of a surface that faces the lamp, times the squared distance
    const auto at = [&](double angle) {
        const glm::dvec3 to(-std::sin(angle), std::cos(angle), 0.0);
        return illuminance(scene, glm::dvec3(0, 4, 0) - 5.0 * to, to) * 25.0;
    };
    EXPECT_NEAR(at(0.0), 9.0, 1e-12);
    EXPECT_NEAR(at(0.2999), 9.0, 1e-6);
    EXPECT_NEAR(at(std::acos(0.5 * (std::cos(0.3) + std::cos(0.6)))), 4.5, 1e-5);
    EXPECT_NEAR(at(std::acos(0.25 * std::cos(0.3) + 0.75 * std::cos(0.6))), 9.0 * 0.15625, 1e-5);
    EXPECT_GT(at(0.599), 0.0);
    EXPECT_EQ(at(0.6001), 0.0);
    EXPECT_EQ(at(kPi), 0.0);
    scene.lamps[0].innerAngle = scene.lamps[0].outerAngle; // a hard edge
    EXPECT_NEAR(at(0.5999), 9.0, 1e-12);
    EXPECT_EQ(at(0.6001), 0.0);
}

TEST(SceneLights, theSkyIsWhatASurfaceUnderItSees)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(2.0f);
    scene.lighting.sunIlluminance = glm::vec3(30.0f);
    scene.lighting.sunDirection = {0.0f, 1.0f, 0.0f};
    scene.lighting.groundAlbedo = 0.25f;
    for (const int rings : {1, 2, 5}) {
        const SceneLights lights = lightsOf(scene, rings);
        std::vector<ArrivingLight> sky;
        lights.appendSky({0.1, 0.5}, 1, sky);
        EXPECT_EQ(sky.size(), size_t(4 * rings * rings));
        double up = 0.0, down = 0.0, all = 0.0;
        for (const ArrivingLight& light : sky) {
            up += light.illuminance.x * std::max(0.0, light.direction.y);
            down += light.illuminance.x * std::max(0.0, -light.direction.y);
            all += light.solidAngle;
        }
        EXPECT_NEAR(all, 4.0 * kPi, 1e-12);
        EXPECT_NEAR(up, 2.0 * kPi, 1e-12);
        EXPECT_NEAR(down, 0.25 * (30.0 + 2.0 * kPi), 1e-6);
        EXPECT_NEAR(lights.ground().x, 0.25 * (30.0 / kPi + 2.0), 1e-6);
    }
}

TEST(SceneLights, aGlowingGroupIsFiniteInsideItsExtent)
{
    OpaqueScene scene;
    scene.lights.push_back({glm::dvec3(0.0, 3.0, 0.0), glm::vec3(90.0f), 0.5f});
    std::vector<ArrivingLight> arriving;
    lightsOf(scene).appendLamp(0, {}, 0.0, arriving);
    ASSERT_EQ(arriving.size(), 1u);
    EXPECT_NEAR(arriving[0].illuminance.x, 90.0 / 9.25, 1e-12);
    EXPECT_NEAR(arriving[0].distance, 2.5, 1e-12);
    EXPECT_LE(illuminance(scene, {0.0, 3.0 - 1e-9, 0.0}, {0, 1, 0}), 90.0 / 0.25);
}

TEST(SceneLights, theCourseOfALampHasItsEdges)
{
    OpaqueScene scene = lampAt({0, 4, 0}, 9.0f);
    scene.lamps[0].innerAngle = scene.lamps[0].outerAngle = 0.5f;
    const TraceRay ray{{-10.0, 1.0, 0.0}, {1, 0, 0}};
    SceneLights::Course course;
    lightsOf(scene).course(0, ray, course);
    EXPECT_NEAR(course.nearest, 10.0, 1e-12);
    EXPECT_NEAR(course.distance, 3.0, 1e-12);
    const double edge = 3.0 * std::tan(0.5);
    ASSERT_EQ(course.cuts.size(), 5u); // the nearest place, and both edges twice
    EXPECT_NEAR(course.cuts.front(), 10.0 - edge, 1e-6);
    EXPECT_NEAR(course.cuts.back(), 10.0 + edge, 1e-6);
    scene = lampAt({0, 4, 0}, 9.0f, 5.0f);
    lightsOf(scene).course(0, ray, course);
    ASSERT_EQ(course.cuts.size(), 3u);
    EXPECT_NEAR(course.cuts.front(), 6.0, 1e-12); // 3-4-5
    EXPECT_NEAR(course.cuts.back(), 14.0, 1e-12);
    EXPECT_NEAR(course.distance, 5.0, 1e-12);
}

} // namespace
} // namespace fx::render
