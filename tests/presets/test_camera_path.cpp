#include "fxsdk/scene_file/camera_path.h"

#include <gtest/gtest.h>

#include <limits>

using namespace fx::scene_file;

namespace {

CameraPath path()
{
    CameraPath camera;
    camera.keys = {{1, {0, 0, 0}, {0, 0, -1}},
                   {2, {4, 0, 0}, {4, 1, -1}},
                   {5, {4, 6, 0}, {0, 0, -9}},
                   {6, {0, 0, 3}, {0, 0, 0}}};
    return camera;
}

glm::dvec3 velocity(const CameraPath& camera, double time, double h)
{
    return (camera.at(time + h).position - camera.at(time).position) / h;
}

} // namespace

TEST(CameraPath, standsStillWithoutKeys)
{
    CameraPath camera;
    camera.position = {1, 2, 3};
    camera.target = {4, 5, 6};
    EXPECT_EQ(camera.at(7).position, camera.position);
    EXPECT_EQ(camera.at(-7).target, camera.target);
}

TEST(CameraPath, passesThroughItsKeys)
{
    const CameraPath camera = path();
    for (const CameraKey& key : camera.keys) {
        EXPECT_LT(glm::length(camera.at(key.time).position - key.position), 1e-12);
        EXPECT_LT(glm::length(camera.at(key.time).target - key.target), 1e-12);
    }
}

TEST(CameraPath, restsBeforeTheFirstAndAfterTheLastKey)
{
    const CameraPath camera = path();
    EXPECT_EQ(camera.at(-100).position, camera.keys.front().position);
    EXPECT_EQ(camera.at(1e9).position, camera.keys.back().position);
    EXPECT_EQ(camera.at(std::numeric_limits<double>::quiet_NaN()).position, camera.keys.front().position);
}

TEST(CameraPath, hasAContinuousVelocityAtEveryKey)
{
    const CameraPath camera = path();
    for (const CameraKey& key : camera.keys)
        EXPECT_LT(glm::length(velocity(camera, key.time, 1e-6) - velocity(camera, key.time, -1e-6)), 1e-4)
            << key.time;
}

TEST(CameraPath, movesUniformlyBetweenInnerKeysOnALine)
{
    CameraPath camera;
    for (const double t : {0.0, 1.0, 3.0, 4.0}) // uneven times, constant speed
        camera.keys.push_back({t, {2 * t, 0, 0}, {2 * t, 0, -1}});
    for (double t = 1; t <= 3; t += 0.125)
        EXPECT_NEAR(camera.at(t).position.x, 2 * t, 1e-12);
}

TEST(CameraPath, worksWithASingleKey)
{
    CameraPath camera;
    camera.keys = {{3, {1, 1, 1}, {0, 0, 0}}};
    EXPECT_EQ(camera.at(0).position, glm::dvec3(1, 1, 1));
    EXPECT_EQ(camera.at(9).position, glm::dvec3(1, 1, 1));
}

TEST(CameraPath, showsItsTargetInTheMiddleOfThePicture)
{
    CameraPath camera;
    camera.position = {1e5, 3, 20};
    camera.target = {1e5 + 2, 5, -4};
    for (const float orthographic : {0.0f, 10.0f}) {
        camera.orthographicHeight = orthographic;
        const glm::vec4 relative(glm::vec3(camera.target - camera.position), 1.0f);
        const glm::vec4 clip = camera.projection(1.5f) * camera.viewRotation(0) * relative;
        EXPECT_NEAR(clip.x / clip.w, 0, 1e-5);
        EXPECT_NEAR(clip.y / clip.w, 0, 1e-5);
        EXPECT_GT(clip.w, 0);
    }
}

TEST(CameraPath, theFieldOfViewReachesFromTheLowerToTheUpperBorder)
{
    CameraPath camera;
    camera.fovYDegrees = 90;
    const glm::vec4 top = camera.projection(2.0f) * glm::vec4(0, 5, -5, 1); // 45 degrees up
    EXPECT_NEAR(top.y / top.w, 1, 1e-6);
    const glm::vec4 side = camera.projection(2.0f) * glm::vec4(10, 0, -5, 1);
    EXPECT_NEAR(side.x / side.w, 1, 1e-6);
    camera.orthographicHeight = 6;
    EXPECT_NEAR((camera.projection(2.0f) * glm::vec4(6, 3, -50, 1)).y, 1, 1e-6);
}
