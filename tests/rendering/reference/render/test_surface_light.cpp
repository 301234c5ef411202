/// Light on triangles, behind media and other triangles.

#include "rendering/reference/render/surface_light.h"

#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

constexpr double kPi = std::numbers::pi;

/// [lx] at the origin, on a surface that faces upwards.
double illuminanceOf(const OpaqueScene& scene, const std::vector<MediumBlob>& blobs = {}, int skyRings = 4,
                     const glm::dvec3& normal = {0.0, 1.0, 0.0})
{
    const auto tasks = base::makeSerialRunner();
    MediumView medium;
    medium.build(blobs, glm::dvec3(0.0), *tasks);
    OpaqueView opaque;
    opaque.build(scene, glm::dvec3(0.0), *tasks);
    SceneLights lights;
    lights.build(scene, glm::dvec3(0.0), skyRings);
    return SurfaceLight(medium, opaque, lights).at(glm::dvec3(0.0), normal).x;
}

/// A blob around `center`; 3.5 / pi times `depth` pi / 3.5 through its middle.
MediumBlob blobOfDepth(double depth, const glm::dvec3& center, double radius = 1.0)
{
    MediumBlob blob;
    blob.center = center;
    blob.radius = radius;
    blob.crossSection = depth * kPi / 3.5 * radius * radius;
    return blob;
}

SceneLight lampAt(const glm::dvec3& position, float intensity)
{
    SceneLight lamp;
    lamp.position = position;
    lamp.intensity = glm::vec3(intensity);
    return lamp;
}

TEST(SurfaceLight, aPointBehindABlobGivesItsIntensityOverTheSquareTimesTheTransmittance)
{
    OpaqueScene scene;
    scene.lamps.push_back(lampAt({3.0, 4.0, 0.0}, 50.0f));
    EXPECT_NEAR(illuminanceOf(scene), 50.0 * 0.8 / 25.0, 1e-6);
    for (const double depth : {0.1, 1.0, 5.0}) {
        const MediumBlob between = blobOfDepth(depth, {1.5, 2.0, 0.0});
        EXPECT_NEAR(illuminanceOf(scene, {between}), 50.0 * 0.8 / 25.0 * std::exp(-depth), 1e-6);
        const MediumBlob beyond = blobOfDepth(depth, {4.5, 6.0, 0.0});
        EXPECT_NEAR(illuminanceOf(scene, {beyond}), 50.0 * 0.8 / 25.0, 1e-6);
    }
}

TEST(SurfaceLight, aPointInTheMiddleOfABlobShinesThroughHalfOfIt)
{
    OpaqueScene scene;
    scene.lamps.push_back(lampAt({0.0, 4.0, 0.0}, 50.0f));
    for (const double depth : {0.2, 2.0, 8.0})
        EXPECT_NEAR(illuminanceOf(scene, {blobOfDepth(depth, {0.0, 4.0, 0.0})}),
                    50.0 / 16.0 * std::exp(-0.5 * depth), 1e-6);
}

TEST(SurfaceLight, theSunIsDarkenedByTheMediumOnItsWay)
{
    OpaqueScene scene;
    scene.lighting.groundAlbedo = 0.0f;
    scene.lighting.sunDirection = {0.6f, 0.8f, 0.0f};
    scene.lighting.sunIlluminance = glm::vec3(10.0f);
    EXPECT_NEAR(illuminanceOf(scene), 8.0, 1e-6);
    EXPECT_NEAR(illuminanceOf(scene, {blobOfDepth(1.0, {6.0, 8.0, 0.0})}), 8.0 * std::exp(-1.0), 1e-6);
    EXPECT_NEAR(illuminanceOf(scene, {}, 4, {0.0, -1.0, 0.0}), 0.0, 1e-12);
}

TEST(SurfaceLight, aTriangleHidesALampBehindItOnly)
{
    const std::vector<glm::vec3> roof{{-9, 3, 9}, {9, 3, 9}, {0, 3, -90}};
    const std::vector<glm::vec3> up(3, {0, 1, 0});
    OpaqueScene scene;
    scene.mesh = {glm::dvec3(0.0), roof, up, up};
    scene.lamps.push_back(lampAt({0.0, 2.9, 0.0}, 8.41f));
    EXPECT_NEAR(illuminanceOf(scene), 1.0, 1e-6);
    scene.lamps[0].position.y = 3.1;
    EXPECT_EQ(illuminanceOf(scene), 0.0);
}

TEST(SurfaceLight, anOpenSkyIsExactForEveryNumberOfDirections)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(2.0f);
    scene.lighting.groundAlbedo = 0.5f;
    const glm::dvec3 slanted = glm::normalize(glm::dvec3(0.4, 0.2, -0.6));
    for (const int rings : {1, 3, 8}) {
        EXPECT_NEAR(illuminanceOf(scene, {}, rings), 2.0 * kPi, 1e-12);
        const double above = 0.5 + 0.5 * slanted.y;
        EXPECT_NEAR(illuminanceOf(scene, {}, rings, slanted), kPi * (2.0 * above + 1.0 * (1.0 - above)),
                    1e-12);
    }
}

TEST(SurfaceLight, aLongWallHidesTheShareOfTheSkyThatGeometrySays)
{
    // A wall of height h at distance d hides (1 - d / sqrt(h^2 + d^2)) / 2 of what the ground faces.
    constexpr float kLong = 1e5f;
    const std::vector<glm::vec3> wall{{2, 0, -kLong}, {2, 0, kLong}, {2, 3, -kLong},
                                      {2, 3, -kLong}, {2, 0, kLong}, {2, 3, kLong}};
    const std::vector<glm::vec3> normals(6, {-1, 0, 0});
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(1.0f);
    scene.lighting.groundAlbedo = 0.0f;
    scene.mesh = {glm::dvec3(0.0), wall, normals, normals};
    const double expected = kPi * (1.0 - 0.5 * (1.0 - 2.0 / std::sqrt(13.0)));
    EXPECT_NEAR(illuminanceOf(scene, {}, 4), expected, 0.05 * expected);
    EXPECT_NEAR(illuminanceOf(scene, {}, 24), expected, 0.005 * expected);
}

TEST(SurfaceLight, aShellAroundAPointDimsTheWholeSky)
{
    OpaqueScene scene;
    scene.lighting.skyLuminance = glm::vec3(1.0f);
    scene.lighting.groundAlbedo = 0.0f;
    EXPECT_NEAR(illuminanceOf(scene, {blobOfDepth(3.0, {}, 4.0)}), kPi * std::exp(-1.5), 1e-9);
}

} // namespace
} // namespace fx::render
