/// Paths of one bounce and the reference renderer's single scattering are two independent ways to the same
/// picture: for each kind of light, on media and on surfaces, each shaded by the other.

#include "rendering/reference/path/path_renderer.h"

#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fx::render {
namespace {

constexpr int kWidth = 24, kHeight = 16;

/// 60 blobs of smoke that nothing lights.
ReferenceScene darkSmoke()
{
    ReferenceScene scene = test::blobScene(60, 2.0);
    for (MediumBlob& blob : scene.blobs) {
        blob.albedo = {0.9, 0.7, 0.4};
        blob.anisotropy = blob.center.x > 0.0 ? 0.5 : 0.0;
        blob.source = glm::dvec3(0.0);
        blob.fireShare = 0.0;
    }
    scene.opaque.lighting.groundAlbedo = 0.0f;
    return scene;
}

/// A square below the blobs, which is all that a picture of it shows.
struct Floor
{
    explicit Floor(ReferenceScene& scene)
    {
        scene.opaque.isEmpty = false;
        scene.opaque.mesh = {glm::dvec3(0.0), positions, normals, colors};
    }
    std::vector<glm::vec3> positions{{-90, -1.2f, -90}, {-90, -1.2f, 90}, {90, -1.2f, -90},
                                     {90, -1.2f, -90},  {-90, -1.2f, 90}, {90, -1.2f, 90}};
    std::vector<glm::vec3> normals = std::vector<glm::vec3>(6, {0, 1, 0});
    std::vector<glm::vec3> colors = std::vector<glm::vec3>(6, {0.8f, 0.6f, 0.3f});
};

SceneLight lampAt(const glm::dvec3& position)
{
    SceneLight lamp;
    lamp.position = position;
    lamp.intensity = {3.0f, 2.5f, 2.0f};
    return lamp;
}

/// Whether nearly all pixels differ by no more than three errors of the mean, and their sum hardly.
/// @param around [pixel] the middle of the picture that is not compared
void expectSame(const ReferenceScene& scene, uint32_t paths, int samples = 5, int skyRings = 4,
                double around = 0.0)
{
    const auto tasks = base::makeSerialRunner();
    PathPictureSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.samples = paths;
    settings.sunRadius = 0.0;
    settings.path.bounces = 1;
    PathRenderer traced;
    ASSERT_TRUE(traced.build(scene, settings, *tasks).ok());
    ASSERT_TRUE(traced.render(nullptr, {}).ok());
    ReferenceSettings exact;
    exact.width = kWidth;
    exact.height = kHeight;
    exact.samples = samples;
    exact.skyRings = skyRings;
    exact.scattering = ScatteringMode::Single;
    const test::Rendered expected(scene, exact);
    size_t compared = 0, agreeing = 0;
    double difference = 0.0, light = 0.0, variance = 0.0;
    for (uint32_t channel = 0; channel < 3; ++channel)
        for (size_t i = 0; i < size_t(kWidth * kHeight); ++i) {
            const double wanted = expected[reference_channel::Color + channel][i];
            const double found = traced.pixels(channel)[i];
            const double error2 = traced.pixels(path_channel::Variance + channel)[i];
            const double x = double(i % kWidth) + 0.5 - 0.5 * kWidth;
            const double y = double(i / kWidth) + 0.5 - 0.5 * kHeight;
            if (x * x + y * y < around * around)
                continue;
            difference += found - wanted;
            light += wanted;
            variance += error2;
            if (expected[reference_channel::Color + 3][i] < 0.02f)
                continue; // where next to no path collides, its error is not known either
            ++compared;
            agreeing += std::abs(found - wanted) <= 3.0 * std::sqrt(error2) + 2e-3 * wanted;
        }
    EXPECT_GT(compared, 350u);
    EXPECT_GE(double(agreeing), 0.99 * double(compared)) << compared;
    // channels of a pixel share their paths
    EXPECT_NEAR(difference / light, 0.0, 3.0 * std::sqrt(3.0 * variance) / light + 1e-3);
}

TEST(PathAgainstReference, aPointBesideMedia)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lamps = {lampAt({1.2, 1.1, 0.6})};
    expectSame(scene, 1024);
}

TEST(PathAgainstReference, aPointInsideMedia)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lamps = {lampAt({0.0, 0.0, 0.0})};
    expectSame(scene, 2048, 5, 4, 2.5); // next to the point the luminance of paths has no finite variance
}

TEST(PathAgainstReference, aBallBesideMedia)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lamps = {lampAt({1.2, 1.1, 0.6})};
    scene.opaque.lamps[0].radius = 0.7f;
    expectSame(scene, 1024, 3);
}

TEST(PathAgainstReference, aBallInsideMedia)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lamps = {lampAt({0.05, 0.1, 0.0})};
    scene.opaque.lamps[0].radius = 0.3f;
    expectSame(scene, 1024, 5);
}

TEST(PathAgainstReference, shiningParticlesInsideMedia)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lights = {{{0.1, -0.1, 0.0}, {3.0f, 2.0f, 1.0f}, 0.25f},
                           {{1.4, 1.0, 0.0}, {4.0f, 4.0f, 9.0f}, 0.1f}};
    scene.opaque.particleLights = scene.opaque.lights;
    expectSame(scene, 1024);
}

TEST(PathAgainstReference, aSpotThroughMedia)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lamps = {lampAt({1.2, 1.1, 0.6})};
    scene.opaque.lamps[0].direction = glm::normalize(glm::vec3(-1.2f, -1.1f, -0.6f));
    scene.opaque.lamps[0].innerAngle = 0.25f;
    scene.opaque.lamps[0].outerAngle = 0.4f;
    expectSame(scene, 2048);
}

TEST(PathAgainstReference, aSkyAboveBrightGround)
{
    ReferenceScene scene = darkSmoke();
    scene.opaque.lighting.skyLuminance = {1.0f, 2.0f, 3.0f};
    scene.opaque.lighting.groundAlbedo = 0.3f;
    expectSame(scene, 1024, 3);
}

TEST(PathAgainstReference, allLightsWithSurfacesThatShadeAndAreShaded)
{
    ReferenceScene scene = darkSmoke();
    const Floor floor(scene);
    scene.opaque.lighting.sunDirection = glm::normalize(glm::vec3(0.4f, 0.8f, -0.2f));
    scene.opaque.lighting.sunIlluminance = glm::vec3(3.0f, 2.5f, 2.0f);
    scene.opaque.lighting.skyLuminance = {0.3f, 0.4f, 0.5f};
    scene.opaque.lamps = {lampAt({1.5, 1.2, 0.6}), lampAt({-1.6, -0.2, 0.9}), lampAt({0.0, 2.0, 0.3})};
    scene.opaque.lamps[1].radius = 0.3f;
    scene.opaque.lamps[2].innerAngle = 0.2f;
    scene.opaque.lamps[2].outerAngle = 0.5f;
    scene.camera = ReferenceCamera::lookAt({0.5, 2.5, 4.0}, {0.0, -0.6, 0.0}, {0.0, 1.0, 0.0});
    scene.camera.halfHeight = 0.4;
    expectSame(scene, 256, 3, 5);
}

} // namespace
} // namespace fx::render
