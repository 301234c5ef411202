/// Lights inside of media, which flights alone would find with a variance that has no bound.

#include "rendering/reference/path/path_equiangular.h"
#include "rendering/reference/path/path_integrator.h"

#include "tests/rendering/reference/path/path_statistics.h"
#include "tests/rendering/reference/path/path_test_media.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

namespace fx::render {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Equiangular, drawsPlacesWithItsDensity)
{
    const TraceRay ray{{1, 2, 3}, glm::normalize(glm::dvec3(2, -1, 0.5))};
    for (const double offset : {0.0, 1e-9, 0.02, 0.7}) {
        const glm::dvec3 across = glm::normalize(glm::cross(ray.direction, glm::dvec3(0, 1, 0)));
        const Equiangular places(ray, {0.5, 4.0}, {ray.origin + 1.5 * ray.direction + offset * across, 0.0});
        EXPECT_TRUE(places.isNear());
        constexpr int kPlaces = 4000;
        double last = 0.5;
        for (int i = 1; i <= kPlaces; ++i) { // between two of them is the same probability
            const double to = places.parameter(double(i) / kPlaces);
            const double middle = places.parameter((i - 0.5) / kPlaces);
            EXPECT_GE(to, last);
            if (offset > 0.01) {
                EXPECT_NEAR((to - last) * places.density(middle) * kPlaces, 1.0, 5e-3);
            }
            last = to;
        }
        EXPECT_NEAR(last, 4.0, 1e-9);
    }
}

TEST(Equiangular, isNotUsedForLightsFarAway)
{
    const TraceRay ray{{0, 0, 0}, {1, 0, 0}};
    EXPECT_FALSE(Equiangular(ray, {1.0, 2.0}, {{1.5, 4.0, 0.0}, 0.0}).isNear());
    EXPECT_FALSE(Equiangular(ray, {1.0, 2.0}, {{9.0, 0.0, 0.0}, 0.0}).isNear());
    EXPECT_TRUE(Equiangular(ray, {1.0, 2.0}, {{2.5, 0.0, 0.0}, 0.0}).isNear());
}

TEST(PathNearLights, singleScatteringOfAPointInsideOfTheMedium)
{
    const double extinction = 0.8, albedo = 0.7, offset = 0.01;
    const HomogeneousMedium medium({MediumShape::Kind::Slab, {}, {0, 1.5, 0}}, substance(extinction, albedo));
    const SpotPathLight point({0, 0.2, 0}, {0, 1, 0}, glm::dvec3(2.0), kPi, kPi);
    const std::array<const PathLight*, 1> lights{&point};
    PathScene scene;
    scene.medium = &medium;
    scene.lights = lights;
    const TraceRay ray{{offset, 4.0, 0.0}, {0, -1, 0}};
    double expected = 0.0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i) {
        const double y = 1.5 - 3.0 * (i + 0.5) / kSteps;
        const double distance2 = offset * offset + (y - 0.2) * (y - 0.2);
        expected += std::exp(-extinction * (1.5 - y + std::sqrt(distance2))) / distance2;
    }
    expected *= 3.0 / kSteps * 2.0 * albedo * extinction / (4.0 * kPi);
    for (const uint32_t forced : {0u, 1u}) {
        PathIntegrator integrator(scene, {.bounces = 1, .forcedFlights = forced});
        Statistics found;
        for (uint32_t i = 0; i < 4000; ++i) {
            PathSampler sampler(9, 0, i);
            found.add(integrator.trace(ray, 0.0, sampler).luminance.x);
        }
        EXPECT_NEAR(found.mean(), expected, 3.0 * found.error());
        EXPECT_LT(found.variance(), expected * expected); // flights alone: a hundred times as much
    }
}

TEST(PathNearLights, lightOfABallInsideOfSmokeIsThatOfFlightsAlone)
{
    const auto tasks = base::makeSerialRunner();
    const BlobPathMedium medium(someBlobs(60, 0.15, {0.9, 0.7, 0.5}, 0.3), glm::dvec3(0.0), *tasks);
    const BallPathLight ball({0.1, 0.0, 0.2}, glm::dvec3(2.0, 1.5, 1.0), 0.25);
    const SpotPathLight spot({0.0, 1.6, 0.0}, {0, -1, 0}, glm::dvec3(3.0), 0.4, 0.6);
    const std::array<const PathLight*, 2> lights{&ball, &spot};
    PathScene scene;
    scene.medium = &medium;
    scene.lights = lights;
    const TraceRay ray{{-3, 0.2, 0.1}, {1, 0, 0}};
    std::array<Statistics, 2> found;
    for (const FlightEstimator flight : {FlightEstimator::Depth, FlightEstimator::LocalMajorants}) {
        PathIntegrator integrator(scene, {.flight = flight});
        for (uint32_t i = 0; i < (flight == FlightEstimator::Depth ? 20000u : 60000u); ++i) {
            PathSampler sampler(9 + uint64_t(flight), 0, i);
            found[size_t(flight)].add(integrator.trace(ray, 0.0, sampler).luminance.x);
        }
    }
    EXPECT_NEAR(found[0].mean(), found[1].mean(), 3.0 * std::hypot(found[0].error(), found[1].error()));
    EXPECT_LT(2.0 * found[0].variance(), found[1].variance());
}

} // namespace
} // namespace fx::render
