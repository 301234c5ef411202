/// Light that is scattered once, against cases that can be worked out by hand.

#include "rendering/reference/render/scattered_light.h"

#include "rendering/optics/phase.h"
#include "rendering/reference/blob_medium/blob_medium.h"
#include "rendering/reference/trace/ray_query.h"
#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

MediumBlob blobAt(const glm::dvec3& center, double radius, double crossSection)
{
    MediumBlob blob;
    blob.center = center;
    blob.radius = radius;
    blob.crossSection = crossSection;
    blob.albedo = {1.0, 0.5, 0.0};
    return blob;
}

/// Light along -Z from the origin.
ScatteredLight::Layers scatteredBy(const std::vector<MediumBlob>& blobs, const OpaqueScene& scene,
                                   double end = kInf)
{
    const auto tasks = base::makeSerialRunner();
    MediumView medium;
    medium.build(blobs, glm::dvec3(0.0), *tasks);
    OpaqueView opaque;
    opaque.build(scene, glm::dvec3(0.0), *tasks);
    const TraceRay ray{glm::dvec3(0.0), {0.0, 0.0, -1.0}};
    RayHits hits;
    findHits(medium.tree(), ray, 0.0, end, hits);
    return ScatteredLight(medium, opaque).along(ray, hits, 0.0, end);
}

OpaqueScene underSun(const glm::vec3& direction)
{
    OpaqueScene scene;
    scene.lighting.sunDirection = direction;
    scene.lighting.sunIlluminance = {100.0f, 100.0f, 100.0f};
    return scene;
}

TEST(ScatteredLight, aThinBlobScattersItsOpticalDepthTimesTheAlbedo)
{
    MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-4);
    blob.anisotropy = 0.4;
    const auto light = scatteredBy({blob}, underSun({0.0f, 0.8f, 0.6f}));
    const double depth = 3.5 / std::numbers::pi * 1e-4;
    const double expected = 100.0 * depth * double(henyeyGreenstein(-0.6f, 0.4f));
    EXPECT_NEAR(light[1].x, expected, 3e-4 * expected);
    EXPECT_NEAR(light[1].y, 0.5 * expected, 3e-4 * expected);
    EXPECT_EQ(light[1].z, 0.0);
    EXPECT_EQ(light[0], glm::dvec3(0.0));
}

TEST(ScatteredLight, theSunBehindTheEyeMeetsTheSameMediumGoingAndComing)
{
    // Both ways have the optical depth x: the integral of exp(-2 x) dx = (1 - exp(-2 tau)) / 2.
    for (const double crossSection : {0.1, 1.0, 5.0}) {
        const auto light =
            scatteredBy({blobAt({0.0, 0.0, -10.0}, 1.0, crossSection)}, underSun({0.0f, 0.0f, 1.0f}));
        const double depth = 3.5 / std::numbers::pi * crossSection;
        const double expected = 100.0 / (4.0 * std::numbers::pi) * 0.5 * (1.0 - std::exp(-2.0 * depth));
        EXPECT_NEAR(light[1].x, expected, 2e-3 * expected) << depth;
    }
}

TEST(ScatteredLight, lookingIntoTheSunEveryPathHasTheWholeDepth)
{
    const double depth = 3.5 / std::numbers::pi * 2.0;
    const auto light = scatteredBy({blobAt({0.0, 0.0, -10.0}, 1.0, 2.0)}, underSun({0.0f, 0.0f, -1.0f}));
    const double expected = 100.0 / (4.0 * std::numbers::pi) * depth * std::exp(-depth);
    EXPECT_NEAR(light[1].x, expected, 1e-3 * expected);
}

TEST(ScatteredLight, aBlobCastsItsShadowOnAnother)
{
    const MediumBlob lit = blobAt({0.0, 0.0, -10.0}, 0.1, 1e-6);
    const MediumBlob between = blobAt({0.0, 5.0, -10.0}, 1.0, 2.0);
    const auto open = scatteredBy({lit}, underSun({0.0f, 1.0f, 0.0f}));
    const auto shaded = scatteredBy({lit, between}, underSun({0.0f, 1.0f, 0.0f}));
    const double depth = 3.5 / std::numbers::pi * 2.0;
    EXPECT_NEAR(shaded[1].x / open[1].x, std::exp(-depth),
                0.03 * std::exp(-depth)); // off its middle it is thinner
}

TEST(ScatteredLight, trianglesCastShadowsAndEndTheRay)
{
    const std::vector<glm::vec3> roof{{-9, 3, 9}, {9, 3, 9}, {0, 3, -90}};
    const std::vector<glm::vec3> up(3, {0, 1, 0});
    OpaqueScene scene = underSun({0.0f, 1.0f, 0.0f});
    const MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-4);
    EXPECT_GT(scatteredBy({blob}, scene)[1].x, 0.0);
    EXPECT_NEAR(scatteredBy({blob}, scene, 10.0)[1].x, 0.5 * scatteredBy({blob}, scene)[1].x, 1e-4);
    scene.mesh = {glm::dvec3(0.0), roof, up, up};
    EXPECT_EQ(scatteredBy({blob}, scene)[1].x, 0.0);
}

TEST(ScatteredLight, aGlowingGroupIsALightOfItsDistance)
{
    OpaqueScene scene;
    scene.lights.push_back({glm::dvec3(0.0, 3.0, -10.0), glm::vec3(90.0f), 0.5f});
    const MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 0.01, 1e-9);
    const double depth = 3.5 / std::numbers::pi * 1e-9 / 1e-4;
    const double expected = 90.0 / (9.0 + 0.25) / (4.0 * std::numbers::pi) * depth;
    EXPECT_NEAR(scatteredBy({blob}, scene)[1].x, expected, 1e-3 * expected);
}

/// Summed in small steps, every shadow by looking at every blob.
double marchedScattering(const std::vector<MediumBlob>& blobs, const glm::dvec3& sun, double begin,
                         double end)
{
    std::vector<Blob> same;
    for (const MediumBlob& blob : blobs)
        same.push_back({blob.center, blob.radius, blob.crossSection, {}});
    const BlobMedium medium(same);
    const Ray ray{glm::dvec3(0.0), {0.0, 0.0, -1.0}};
    const int steps = 1500;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double t = begin + (end - begin) * (k + 0.5) / steps;
        const glm::dvec3 point = ray.direction * t;
        const double depth = medium.opticalDepth(ray, 0.0, t) + medium.opticalDepth({point, sun}, 0.0, 1e3);
        sum += medium.extinctionAt(point) * std::exp(-depth);
    }
    return sum * (end - begin) / steps * 100.0 / (4.0 * std::numbers::pi);
}

TEST(ScatteredLight, manyOverlappingBlobsAreWithinTheBoundOfAFineSum)
{
    test::Chance chance(8);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, 0.8, 0.4));
    for (const double crossSection : {0.02, 0.2, 1.0}) {
        std::vector<MediumBlob> blobs;
        for (int i = 0; i < 60; ++i)
            blobs.push_back(blobAt(glm::dvec3(0.0, 0.0, -10.0) + 1.2 * chance.inCube(),
                                   chance.between(0.3, 0.9), crossSection * chance()));
        const double expected = marchedScattering(blobs, sun, 7.5, 12.5);
        EXPECT_NEAR(scatteredBy(blobs, underSun(glm::vec3(sun)))[1].x, expected, 2e-3 * expected);
    }
}

} // namespace
} // namespace fx::render
