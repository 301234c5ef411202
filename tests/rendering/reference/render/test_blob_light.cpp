/// Light that arrives at the centers of blobs.

#include "rendering/reference/render/blob_light.h"

#include "rendering/optics/phase.h"
#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

MediumBlob blobAt(const glm::dvec3& center, double radius, double crossSection)
{
    MediumBlob blob;
    blob.center = center;
    blob.radius = radius;
    blob.crossSection = crossSection;
    blob.albedo = {1.0, 0.5, 0.0};
    return blob;
}

OpaqueScene underSky(float luminance, float groundAlbedo)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(luminance);
    scene.lighting.groundAlbedo = groundAlbedo;
    return scene;
}

/// By blob, in the order of the list.
std::vector<glm::vec3> lightOf(const std::vector<MediumBlob>& blobs, const OpaqueScene& scene)
{
    const auto tasks = base::makeTbbRunner(2);
    MediumView medium;
    medium.build(blobs, glm::dvec3(0.0), *tasks);
    OpaqueView opaque;
    opaque.build(scene, glm::dvec3(0.0), *tasks);
    SceneLights lights;
    lights.build(scene, glm::dvec3(0.0), 1);
    const std::vector<glm::vec3> byPlace = lightAtCenters(medium, opaque, lights, *tasks);
    std::vector<glm::vec3> light(byPlace.size());
    for (uint32_t place = 0; place < byPlace.size(); ++place)
        light[medium.tree().ballAt(place)] = byPlace[place];
    return light;
}

TEST(BlobLight, aThinBlobUnderAnEvenSkyOverWhiteGroundScattersTheSky)
{
    const auto light = lightOf({blobAt({0.0, 0.0, -5.0}, 1.0, 1e-9)}, underSky(80.0f, 1.0f));
    EXPECT_NEAR(light[0].x, 80.0f, 1e-4f);
    EXPECT_NEAR(light[0].y, 40.0f, 1e-4f);
    EXPECT_EQ(light[0].z, 0.0f);
}

TEST(BlobLight, overBlackGroundItIsHalf)
{
    const auto light = lightOf({blobAt({0.0, 0.0, -5.0}, 1.0, 1e-9)}, underSky(80.0f, 0.0f));
    EXPECT_NEAR(light[0].x, 40.0f, 1e-4f);
}

TEST(BlobLight, aBlobDimsWhatReachesItsOwnCenter)
{
    for (const double crossSection : {0.1, 1.0, 10.0}) {
        const auto light = lightOf({blobAt({0.0, 0.0, -5.0}, 1.0, crossSection)}, underSky(80.0f, 1.0f));
        const double half = 0.5 * 3.5 / std::numbers::pi * crossSection;
        EXPECT_NEAR(light[0].x, 80.0 * std::exp(-half), 1e-4);
    }
}

TEST(BlobLight, aShellAroundABlobDimsAllDirections)
{
    // as seen from its center a large ball is even
    const auto light = lightOf({blobAt({0.0, 0.0, -5.0}, 0.1, 1e-9), blobAt({0.0, 0.0, -5.0}, 4.0, 16.0)},
                               underSky(80.0f, 1.0f));
    EXPECT_NEAR(light[0].x, 80.0 * std::exp(-0.5 * 3.5 / std::numbers::pi), 1e-4);
}

TEST(BlobLight, sunLampsAndGlowingGasComeWithTheirPhaseAndShadows)
{
    OpaqueScene scene = underSky(0.0f, 0.0f);
    scene.lighting.sunDirection = {0.0f, 0.8f, 0.6f};
    scene.lighting.sunIlluminance = glm::vec3(100.0f);
    MediumBlob blob = blobAt({0.0, 0.0, -10.0}, 1.0, 1e-9);
    blob.anisotropy = 0.4;
    const double sun = 100.0 * double(henyeyGreenstein(-0.6f, 0.4f));
    EXPECT_NEAR(lightOf({blob}, scene)[0].x, sun, 1e-4 * sun);
    scene.lights.push_back({glm::dvec3(0.0, 3.0, -10.0), glm::vec3(90.0f), 0.5f});
    const double fire = 90.0 / 9.25 * double(henyeyGreenstein(0.0f, 0.4f));
    EXPECT_NEAR(lightOf({blob}, scene)[0].x, sun + fire, 1e-4 * (sun + fire));
    SceneLight point;
    point.position = {0.0, 3.0, -10.0};
    point.intensity = glm::vec3(18.0f);
    scene.lamps.push_back(point);
    const double lamp = 18.0 / 9.0 * double(henyeyGreenstein(0.0f, 0.4f));
    EXPECT_NEAR(lightOf({blob}, scene)[0].x, sun + fire + lamp, 1e-4 * (sun + fire + lamp));
    const std::vector<glm::vec3> roof{{-9, 2, 9}, {9, 2, 9}, {0, 2, -90}};
    const std::vector<glm::vec3> up(3, {0, 1, 0});
    scene.mesh = {glm::dvec3(0.0), roof, up, up};
    EXPECT_EQ(lightOf({blob}, scene)[0].x, 0.0f);
}

TEST(BlobLight, whereNothingShinesThereIsNoLight)
{
    EXPECT_TRUE(lightOf({blobAt({0.0, 0.0, -5.0}, 1.0, 1.0)}, OpaqueScene{}).empty());
}

TEST(BlobLight, inAWhiteFurnaceAThinCloudOfAlbedoOneDisappears)
{
    test::Chance chance(3);
    ReferenceScene scene;
    for (int i = 0; i < 20; ++i) {
        MediumBlob blob = blobAt(glm::dvec3(0.0, 0.0, -5.0) + chance.inCube(), 0.6, 1e-4);
        blob.albedo = glm::dvec3(1.0);
        scene.blobs.push_back(blob);
    }
    scene.opaque = underSky(1.0f, 1.0f);
    scene.opaque.background.luminance = scene.opaque.background.horizon = glm::vec3(1.0f);
    ReferenceSettings settings = test::smallSettings();
    settings.scattering = ScatteringMode::Centers;
    const test::Rendered picture(scene, settings);
    for (size_t i = 0; i < picture[0].size(); ++i) {
        const float depth = picture[reference_channel::OpticalDepth][i];
        EXPECT_NEAR(picture[0][i], 1.0f, 0.02f * depth + 1e-6f); // scattering twice is what is left out
        EXPECT_NEAR(picture[reference_channel::Smoke][i], depth, 0.05f * depth + 1e-7f);
    }
}

} // namespace
} // namespace fx::render
