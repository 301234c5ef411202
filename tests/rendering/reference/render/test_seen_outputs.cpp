/// Whose the medium is that a ray sees, how it moves, and where it begins: cases with known answers.

#include "tests/rendering/reference/render/reference_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace fx::render {
namespace {

namespace channel = reference_channel;

constexpr int kWidth = 48, kHeight = 32;

/// @param depth [1] optical depth through the middle
MediumBlob ballOf(const glm::dvec3& center, double radius, double depth, const glm::dvec3& velocity,
                  uint64_t instance)
{
    MediumBlob blob;
    blob.center = center;
    blob.radius = radius;
    blob.crossSection = depth * radius * radius * std::numbers::pi * 2.0 / 7.0;
    blob.velocity = velocity;
    blob.instance = instance;
    return blob;
}

ReferenceScene sceneOf(std::vector<MediumBlob> blobs, bool isParallel)
{
    ReferenceScene scene;
    scene.blobs = std::move(blobs);
    scene.opaque.isEmpty = true;
    scene.camera = ReferenceCamera::lookAt({0.0, 0.0, 8.0}, glm::dvec3(0.0), {0.0, 1.0, 0.0});
    scene.camera.orthographic = isParallel;
    scene.camera.halfHeight = isParallel ? 1.6 : 0.2;
    return scene;
}

/// @param moved [m] way of the camera since the frame before, `seconds` ago
ReferenceSettings settingsOf(const ReferenceScene& scene, double seconds,
                             const glm::dvec3& moved = glm::dvec3(0.0))
{
    ReferenceSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.outputs = true;
    settings.past = {scene.camera, seconds};
    settings.past.camera.eye -= moved;
    return settings;
}

size_t pixelAt(int right, int up)
{
    return size_t(kHeight / 2 - 1 - up) * kWidth + size_t(kWidth / 2 + right);
}

TEST(SeenOutputs, theFirstDepthIsWhereTheKernelHasPassedAHundredth)
{
    const ReferenceScene scene = sceneOf({ballOf(glm::dvec3(0.0), 1.0, 3.0, glm::dvec3(0.0), 1)}, true);
    const test::Rendered picture(scene, settingsOf(scene, 0.0));
    const double b2 = 2.0 * 0.05 * 0.05, w = std::sqrt(1.0 - b2); // the middle of a pixel of 0.1 m
    const double first = double(picture[channel::FirstDepth][pixelAt(0, 0)]);
    const double u = (first - 8.0) / w;
    const double passed = 0.5 + 15.0 / 16.0 * u * (1.0 - u * u * (2.0 / 3.0 - 0.2 * u * u));
    EXPECT_NEAR(3.0 * std::pow(1.0 - b2, 2.5) * passed, 0.01, 1e-6);
    EXPECT_TRUE(std::isinf(picture[channel::FirstDepth][pixelAt(12, 0)]));
    EXPECT_EQ(picture[channel::InstanceId][pixelAt(12, 0)], 0.0f);
}

TEST(SeenOutputs, theSilhouetteIsWhereTheOpticalDepthIsAHundredth)
{
    const ReferenceScene scene = sceneOf({ballOf(glm::dvec3(0.0), 1.0, 3.0, glm::dvec3(0.0), 5)}, true);
    const test::Rendered picture(scene, settingsOf(scene, 0.0));
    for (int up = -14; up < 14; ++up)
        for (int right = -14; right < 14; ++right) {
            const double b2 = 0.01 * ((right + 0.5) * (right + 0.5) + (up + 0.5) * (up + 0.5));
            const double depth = b2 < 1.0 ? 3.0 * std::pow(1.0 - b2, 2.5) : 0.0;
            EXPECT_EQ(picture[channel::InstanceId][pixelAt(right, up)], depth >= 0.01 ? 5.0f : 0.0f)
                << right << " " << up;
        }
}

TEST(SeenOutputs, motionIsThatOfTheBallAndOfTheCamera)
{
    const ReferenceScene parallel = sceneOf({ballOf(glm::dvec3(0.0), 1.0, 3.0, {2.0, -1.0, 5.0}, 1)}, true);
    const test::Rendered picture(parallel, settingsOf(parallel, 0.1, {0.3, 0.0, 0.0}));
    EXPECT_NEAR(picture[channel::MotionX][pixelAt(0, 0)], 10.0 * (2.0 * 0.1 - 0.3), 1e-5);
    EXPECT_NEAR(picture[channel::MotionY][pixelAt(0, 0)], 10.0 * -1.0 * 0.1, 1e-5);

    const double radius = 0.05; // so small that all of it is at one distance
    const ReferenceScene near = sceneOf({ballOf({0.05, 0.05, 0.0}, radius, 3.0, {1.0, 0.0, 0.0}, 1)}, false);
    const test::Rendered seen(near, settingsOf(near, 0.1));
    EXPECT_NEAR(seen[channel::MotionX][pixelAt(0, 0)], 0.1 / 8.0 / 0.2 * kHeight / 2, 0.01);
}

TEST(SeenOutputs, aThickBallBeforeAnotherHasItsPixels)
{
    const ReferenceScene scene = sceneOf({ballOf({0.0, 0.0, 2.0}, 0.5, 20.0, {1.0, 0.0, 0.0}, 7),
                                          ballOf(glm::dvec3(0.0), 1.4, 5.0, {-1.0, 0.0, 0.0}, 3)},
                                         true);
    const test::Rendered picture(scene, settingsOf(scene, 0.1));
    EXPECT_EQ(picture[channel::InstanceId][pixelAt(0, 0)], 7.0f);
    EXPECT_EQ(picture[channel::InstanceId][pixelAt(7, 0)], 3.0f);
    EXPECT_NEAR(picture[channel::MotionX][pixelAt(0, 0)], 1.0, 1e-4);
    EXPECT_NEAR(picture[channel::MotionX][pixelAt(7, 0)], -1.0, 1e-4);
    // where the one lets as much pass as it takes, what is seen of both moves as their mean
    for (int right = 0; right < 8; ++right) {
        const double b2 = 0.01 * ((right + 0.5) * (right + 0.5) + 0.25),
                     own = b2 < 0.25 ? std::pow(1.0 - b2 / 0.25, 2.5) : 0.0;
        const double front = 1.0 - std::exp(-20.0 * own);
        const double back = std::exp(-20.0 * own) * (1.0 - std::exp(-5.0 * std::pow(1.0 - b2 / 1.96, 2.5)));
        EXPECT_NEAR(picture[channel::MotionX][pixelAt(right, 0)], (front - back) / (front + back), 1e-4)
            << right;
        EXPECT_EQ(picture[channel::InstanceId][pixelAt(right, 0)], front > back ? 7.0f : 3.0f);
    }
}

TEST(SeenOutputs, fourRaysOfAPixelShareItByWhatTheySee)
{
    const ReferenceScene scene = sceneOf({ballOf(glm::dvec3(0.0), 1.0, 3.0, {2.0, 0.0, 0.0}, 4)}, true);
    ReferenceSettings settings = settingsOf(scene, 0.1);
    settings.samples = 2;
    const test::Rendered picture(scene, settings);
    EXPECT_EQ(picture[channel::InstanceId][pixelAt(3, 2)], 4.0f);
    EXPECT_NEAR(picture[channel::MotionX][pixelAt(3, 2)], 2.0, 1e-4);
}

TEST(SeenOutputs, withoutThemAPictureHasNoChannelsForThem)
{
    ReferenceSettings settings;
    EXPECT_EQ(settings.channels(), uint32_t(channel::Count));
    settings.outputs = true;
    EXPECT_EQ(settings.channels(), uint32_t(channel::CountWithOutputs));
}

} // namespace
} // namespace fx::render
