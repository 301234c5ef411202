#include "rendering/reference/path/path_integrator.h"
#include "rendering/reference/path/path_lights.h"

#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

/// Luminance after one scattering of a ray that passes the origin at the distance `b`.
Statistics scatteredOnce(const PathMedium& medium, const PathLight& light, double b)
{
    const std::array<const PathLight*, 1> lights{&light};
    PathScene scene;
    scene.medium = &medium;
    scene.lights = lights;
    PathIntegrator integrator(scene, {.bounces = 1});
    Statistics result;
    for (uint32_t i = 0; i < 20000; ++i) {
        PathSampler sampler(3, 0, i);
        result.add(integrator.trace({{b, 0.0, -5.0}, {0.0, 0.0, 1.0}}, 0.0, sampler).luminance.x);
    }
    return result;
}

/// The same for a point in the middle of a ball of radius 1 whose optical depth from the middle is known: the
/// integral of extinction, both transmittances and 1 / r^2, in steps of the angle at the light.
template <class Extinction, class Depth>
double pointInTheMiddle(double b, double scattered, const Extinction& extinction, const Depth& depthTo)
{
    constexpr int kSteps = 20000;
    const double half = std::sqrt(1.0 - b * b);
    const double rim = std::atan(half / b);
    double sum = 0.0, depth = 0.0, before = -half;
    for (int k = 0; k < kSteps; ++k) {
        const double s = b * std::tan(rim * (2.0 * (k + 0.5) / kSteps - 1.0));
        depth += extinction(std::sqrt(b * b + 0.25 * (s + before) * (s + before))) * (s - before);
        before = s;
        const double r = std::sqrt(b * b + s * s);
        sum += extinction(r) * std::exp(-depth - depthTo(r));
    }
    return sum * 2.0 * rim / kSteps / b * scattered / (4.0 * kPi);
}

TEST(PathLights, aPointInTheMiddleOfAHomogeneousBallLightsItAsTheRadialIntegralSays)
{
    const SpotPathLight point({}, {0, -1, 0}, glm::dvec3(6.0), kPi, kPi);
    for (const double extinction : {0.3, 2.0, 6.0}) {
        const HomogeneousMedium medium({MediumShape::Kind::Ball, {}, {1, 0, 0}}, substance(extinction, 0.8));
        const Statistics result = scatteredOnce(medium, point, 0.4);
        const double expected = pointInTheMiddle(
            0.4, 6.0 * 0.8, [&](double) { return extinction; }, [&](double r) { return extinction * r; });
        EXPECT_NEAR(result.mean(), expected, 3.0 * result.error() + 1e-4 * expected);
    }
}

TEST(PathLights, aPointInTheMiddleOfABlobLightsItAsTheRadialIntegralSays)
{
    const SpotPathLight point({}, {0, -1, 0}, glm::dvec3(6.0), kPi, kPi);
    const auto tasks = base::makeSerialRunner();
    for (const double crossSection : {0.2, 2.0, 8.0}) {
        MediumBlob blob;
        blob.radius = 1.0;
        blob.crossSection = crossSection;
        blob.albedo = glm::dvec3(0.8);
        const BlobPathMedium medium({{blob}}, glm::dvec3(0.0), *tasks);
        const double peak = 105.0 * crossSection / (32.0 * kPi);
        const auto extinction = [&](double r) { return peak * (1.0 - r * r) * (1.0 - r * r); };
        const auto depthTo = [&](double r) {
            return peak * (r - 2.0 / 3.0 * r * r * r + 0.2 * std::pow(r, 5.0));
        };
        const Statistics result = scatteredOnce(medium, point, 0.4);
        const double expected = pointInTheMiddle(0.4, 6.0 * 0.8, extinction, depthTo);
        EXPECT_NEAR(result.mean(), expected, 3.0 * result.error() + 1e-4 * expected);
    }
}

TEST(PathLights, aPointAboveASurfaceObeysTheInverseSquareLawAndBeersLaw)
{
    const std::vector<glm::vec3> positions{{-9, 0, -9}, {-9, 0, 9}, {9, 0, -9}};
    const std::vector<glm::vec3> normals(3, {0, 1, 0}), colors(3, glm::vec3(0.5f));
    const auto tasks = base::makeSerialRunner();
    TriangleScene triangles;
    triangles.build({glm::dvec3(0.0), positions, normals, colors}, glm::dvec3(0.0), *tasks);
    const HomogeneousMedium medium({MediumShape::Kind::Ball, {-1.0, 2.0, 0.0}, {0.5, 0, 0}},
                                   substance(1.3, 0.0));
    for (const double height : {1.5, 4.0, 40.0}) {
        // the surface at the origin sees the point through a ball of diameter 1 or past it
        const glm::dvec3 to = glm::normalize(glm::dvec3(-1.0, 2.0, 0.0));
        const SpotPathLight point(height / to.y * to, {0, -1, 0}, glm::dvec3(6.0), kPi, kPi);
        const std::array<const PathLight*, 1> lights{&point};
        PathScene scene;
        scene.medium = &medium;
        scene.triangles = &triangles;
        scene.mesh = {glm::dvec3(0.0), positions, normals, colors};
        scene.lights = lights;
        PathIntegrator integrator(scene, {.bounces = 1});
        PathSampler sampler(1, 0, 0);
        const PathResult seen = integrator.trace({{0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}}, 0.0, sampler);
        const double distance = height / to.y;
        const double passed = distance > std::sqrt(5.0) + 0.5 ? std::exp(-1.3) : 1.0;
        const double expected = 0.5 / kPi * 6.0 * to.y / (distance * distance) * passed;
        EXPECT_NEAR(seen.luminance.x, expected, 1e-5 * expected) << height;
    }
}

TEST(PathLights, aLightOfASceneBecomesThePointBallOrSpotThatItDescribes)
{
    SceneLight light;
    light.position = {100.0, 4.0, 0.0};
    light.intensity = glm::vec3(9.0f);
    const glm::dvec3 eye(100.0, 0.0, 0.0);
    EXPECT_NEAR(illuminance(*makePathLight(light, eye), {}, {0, 1, 0}).mean(), 9.0 / 16.0, 1e-12);
    EXPECT_NEAR(illuminance(*makePathLight(light, eye), {0, 8, 0}, {0, -1, 0}).mean(), 9.0 / 16.0, 1e-12);
    light.outerAngle = light.innerAngle = 0.5f;
    EXPECT_NEAR(illuminance(*makePathLight(light, eye), {}, {0, 1, 0}).mean(), 9.0 / 16.0, 1e-12);
    EXPECT_EQ(illuminance(*makePathLight(light, eye), {0, 8, 0}, {0, -1, 0}).mean(), 0.0);
    light.outerAngle = light.innerAngle = SceneLight{}.innerAngle;
    light.radius = 2.0f;
    const Statistics ball = illuminance(*makePathLight(light, eye), {}, {0, 1, 0});
    EXPECT_NEAR(ball.mean(), 9.0 / 16.0, 3.0 * ball.error());
    EXPECT_GT(ball.error(), 0.0);
}

} // namespace
} // namespace fx::render
