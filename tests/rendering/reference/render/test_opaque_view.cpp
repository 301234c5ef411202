/// What stands behind the medium: triangles, their light, and the background.

#include "rendering/reference/render/opaque_view.h"

#include "rendering/reference/trace/ray_query.h"
#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

/// Triangles that own their columns.
struct Triangles
{
    std::vector<glm::vec3> positions, normals, colors;

    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
    {
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        for (const glm::vec3& p : {a, b, c}) {
            positions.push_back(p);
            normals.push_back(normal);
            colors.emplace_back(0.5f);
        }
    }
    OpaqueMesh mesh() const { return {glm::dvec3(0.0), positions, normals, colors}; }
};

/// A horizontal square at `height`.
void addFloor(Triangles& triangles, float height, float size)
{
    triangles.add({-size, height, size}, {size, height, size}, {size, height, -size});
    triangles.add({-size, height, size}, {size, height, -size}, {-size, height, -size});
}

OpaqueSample look(const OpaqueScene& scene, const glm::dvec3& eye, const glm::dvec3& direction)
{
    OpaqueView view;
    view.build(scene, eye, *base::makeSerialRunner());
    const TraceRay ray{glm::dvec3(0.0), glm::normalize(direction)};
    RayHits hits;
    RayHits scratch;
    findHits(view.tree(), ray, 0.0, 1e30, hits);
    return view.sample(ray, 0.5, 0.5, hits, 0.0, scratch);
}

TEST(OpaqueView, aRayEndsAtTheNearestTriangle)
{
    Triangles triangles;
    addFloor(triangles, 0.0f, 10.0f);
    addFloor(triangles, 1.0f, 0.5f);
    OpaqueScene scene;
    scene.mesh = triangles.mesh();
    EXPECT_NEAR(look(scene, {0.1, 3.0, 0.2}, {0.0, -1.0, 0.0}).distance, 2.0, 1e-12);
    EXPECT_NEAR(look(scene, {2.0, 3.0, 0.2}, {0.0, -1.0, 0.0}).distance, 3.0, 1e-12);
    EXPECT_TRUE(std::isinf(look(scene, {2.0, 3.0, 0.2}, {0.0, 1.0, 0.0}).distance));
}

TEST(OpaqueView, tracingTrianglesFindsWhatTestingAllOfThemFinds)
{
    test::Chance chance(6);
    Triangles triangles;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 at(chance.inCube());
        const float size = i % 10 == 0 ? 1.0f : 0.1f;
        triangles.add(at, at + size * glm::vec3(chance.inCube()), at + size * glm::vec3(chance.inCube()));
    }
    TriangleScene scene;
    scene.build(triangles.mesh(), glm::dvec3(0.0), *base::makeSerialRunner());
    RayHits hits;
    RayHits all;
    int met = 0;
    for (uint32_t i = 0; i < scene.tree().count(); ++i) {
        all.reserve(1);
        all.place[i] = i;
        all.enter[i] = -1e30;
        all.setSize(i + 1);
    }
    for (int i = 0; i < 500; ++i) {
        const TraceRay ray{2.0 * chance.inCube(), chance.direction()};
        const SurfaceHit expected = scene.nearest(ray, all, 0.0);
        const SurfaceHit found = scene.trace(ray, 0.0, hits);
        EXPECT_EQ(found.distance, expected.distance);
        EXPECT_EQ(found.triangle, expected.triangle);
        met += found.isHit() ? 1 : 0;
    }
    EXPECT_GT(met, 50);
}

TEST(OpaqueView, sunlightFallsWithTheCosineAndIsBlocked)
{
    Triangles triangles;
    addFloor(triangles, 0.0f, 10.0f);
    OpaqueScene scene;
    scene.lighting.sunDirection = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f));
    scene.lighting.sunIlluminance = {100.0f, 100.0f, 100.0f};
    scene.lighting.groundAlbedo = 0.0f;
    scene.mesh = triangles.mesh();
    const double expected = 0.5 / std::numbers::pi * 100.0 * std::sqrt(0.5);
    EXPECT_NEAR(look(scene, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}).luminance.x, expected, 1e-5 * expected);
    addFloor(triangles, 2.0f, 2.5f); // seen from below it stands between the point and the sun
    scene.mesh = triangles.mesh();
    EXPECT_EQ(look(scene, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}).luminance.x, 0.0);
}

TEST(OpaqueView, aWhiteSurfaceUnderAUniformSkyIsAsBrightAsTheSky)
{
    Triangles triangles;
    addFloor(triangles, 0.0f, 10.0f);
    for (glm::vec3& color : triangles.colors)
        color = glm::vec3(1.0f);
    OpaqueScene scene;
    scene.mesh = triangles.mesh();
    scene.lighting.skyLuminance = {3.0f, 4.0f, 5.0f};
    const glm::dvec3 seen = look(scene, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}).luminance;
    EXPECT_NEAR(seen.x, 3.0, 1e-6);
    EXPECT_NEAR(seen.z, 5.0, 1e-6);
}

TEST(OpaqueView, whatFacesDownSeesTheLightThatTheGroundReflects)
{
    Triangles triangles;
    addFloor(triangles, 5.0f, 10.0f);
    for (glm::vec3& normal : triangles.normals)
        normal = -normal;
    OpaqueScene scene;
    scene.mesh = triangles.mesh();
    scene.lighting.sunDirection = {0.0f, 1.0f, 0.0f};
    scene.lighting.sunIlluminance = glm::vec3(30.0f);
    scene.lighting.skyLuminance = glm::vec3(4.0f);
    scene.lighting.groundAlbedo = 0.25f;
    const double ground = 0.25 * (30.0 / std::numbers::pi + 4.0);
    EXPECT_NEAR(look(scene, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}).luminance.x, 0.5 * ground, 1e-6);
}

TEST(OpaqueView, pointsBallsAndSpotsLightItPastOtherTriangles)
{
    Triangles triangles;
    addFloor(triangles, 0.0f, 10.0f);
    OpaqueScene scene;
    scene.lighting.groundAlbedo = 0.0f;
    scene.mesh = triangles.mesh();
    SceneLight lamp;
    lamp.position = {3.0, 4.0, 0.0};
    lamp.intensity = glm::vec3(50.0f);
    lamp.direction = {1.0f, 0.0f, 0.0f};
    scene.lamps = {lamp};
    const auto light = [&] { return look(scene, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}).luminance.x; };
    const double expected = 0.5 / std::numbers::pi * 50.0 * 0.8 / 25.0;
    EXPECT_NEAR(light(), expected, 1e-5 * expected);
    scene.lamps[0].radius = 1.0f;
    EXPECT_NEAR(light(), expected, 1e-5 * expected);
    scene.lamps[0].radius = 0.0f;
    scene.lamps[0].innerAngle = scene.lamps[0].outerAngle = 0.3f;
    EXPECT_EQ(light(), 0.0) << "its cone goes elsewhere";
    scene.lamps[0].direction = {-0.6f, -0.8f, 0.0f};
    EXPECT_NEAR(light(), expected, 1e-5 * expected);
    addFloor(triangles, 2.0f, 2.5f);
    scene.mesh = triangles.mesh();
    EXPECT_EQ(light(), 0.0);
}

TEST(OpaqueView, backgroundImagesFillTheViewOrSurroundTheEye)
{
    const std::vector<glm::vec3> image{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0},
                                       {5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {8, 0, 0}};
    OpaqueScene scene;
    scene.background.image = image;
    scene.background.width = 4;
    scene.background.height = 2;
    OpaqueView view;
    RayHits hits;
    view.build(scene, glm::dvec3(0.0), *base::makeSerialRunner());
    const TraceRay ray{glm::dvec3(0.0), {0.0, 0.0, -1.0}};
    EXPECT_DOUBLE_EQ(view.sample(ray, 0.125, 0.25, hits, 0.0, hits).luminance.x, 1.0);
    EXPECT_DOUBLE_EQ(view.sample(ray, 0.875, 0.75, hits, 0.0, hits).luminance.x, 8.0);
    scene.background.panorama = true;
    EXPECT_NEAR(look(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}).luminance.x, 4.5, 1e-9); // -Z is the middle
    EXPECT_NEAR(look(scene, glm::dvec3(0.0), {0.0, 1.0, -1e-9}).luminance.x, 2.5, 1e-6);
}

TEST(OpaqueView, surfacesHideTheMediumBehindThem)
{
    ReferenceScene scene = test::blobScene(40, 3.0);
    scene.opaque.isEmpty = false;
    Triangles triangles;
    triangles.add({-50, -50, 0}, {50, -50, 0}, {0, 80, 0});
    scene.opaque.mesh = triangles.mesh();
    const test::Rendered cut(scene);
    for (auto i = scene.blobs.begin(); i != scene.blobs.end();)
        i = i->center.z < -i->radius ? scene.blobs.erase(i) : i + 1;
    const test::Rendered without(scene);
    scene.opaque = {};
    const test::Rendered open(scene);
    double difference = 0.0;
    for (size_t i = 0; i < cut[0].size(); ++i) {
        EXPECT_NEAR(cut[0][i], without[0][i], 1e-6);
        difference +=
            double(open[reference_channel::OpticalDepth][i] - cut[reference_channel::OpticalDepth][i]);
    }
    EXPECT_GT(difference, 1.0);
}

} // namespace
} // namespace fx::render
