// Shares of the picture, from solid angles that can be computed by hand.
#include "rendering/media/blob_estimate.h"
#include "rendering/stage/stage_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace fx::render;

namespace {

BlobInstance blobAt(float distance, float radius, float heat = 0.0f)
{
    BlobInstance blob{};
    blob.centerRadius = {0.0f, 0.0f, -distance, radius};
    blob.medium.y = heat;
    return blob;
}

} // namespace

TEST(ScreenShare, ofNothingIsNothing)
{
    const CameraGeometry camera = cameraGeometry(perspectiveView({{0, 0, 0}, {0, 0, -1}}, 1.0f, 1.0f, 0.1f));
    EXPECT_EQ(screenShare({}, camera).media, 0.0);
}

TEST(ScreenShare, ofAFarBallIsItsDiskOverThePicture)
{
    const float fov = 1.0f;
    const CameraGeometry camera = cameraGeometry(perspectiveView({{0, 0, 0}, {0, 0, -1}}, fov, 1.0f, 0.1f));
    const double side = 2.0 * 100.0 * std::tan(0.5 * double(fov)); // [m] of the picture at the ball
    const double disk = std::numbers::pi / (side * side);
    const std::vector<BlobInstance> one = {blobAt(100.0f, 1.0f)};
    EXPECT_NEAR(screenShare(one, camera).media, disk, 1e-3 * disk);
    EXPECT_EQ(screenShare(one, camera).hot, 0.0);
    const std::vector<BlobInstance> two = {blobAt(100.0f, 1.0f), blobAt(100.0f, 1.0f, 500.0f)};
    EXPECT_NEAR(screenShare(two, camera).media, 2.0 * disk, 2e-3 * disk);
    EXPECT_NEAR(screenShare(two, camera).hot, disk, 1e-3 * disk);
}

TEST(ScreenShare, neverReachesTheWholePicture)
{
    const CameraGeometry camera = cameraGeometry(perspectiveView({{0, 0, 0}, {0, 0, -1}}, 1.0f, 1.0f, 0.1f));
    const std::vector<BlobInstance> many(5, blobAt(0.5f, 1.0f, 1.0f)); // the eye is inside
    EXPECT_GT(screenShare(many, camera).media, 0.9);
    EXPECT_LT(screenShare(many, camera).media, 1.0);
}
