// Which rays the texels of small layers have, what a frame is estimated to cost, and how the size follows.
#include "rendering/media/blob_estimate.h"
#include "rendering/stage/stage_camera.h"
#include "rendering/view/layer_grid.h"
#include "rendering/view/layer_scale_control.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

using namespace fx::render;

namespace {

constexpr int kWidth = 101, kHeight = 62; // no multiples of 4
const CameraPose kPose{{1.0, 2.0, 7.0}, {0.0, 0.5, 0.0}, {0.1f, 1.0f, 0.0f}};

struct EyeRay
{
    glm::vec3 origin, direction;
};

/// As viewRay() of shaders/shared/view_block.glsl.
EyeRay rayOf(const ViewBlock& view, float x, float y)
{
    const float nx = x / view.rayDirectionX.w * 2.0f - 1.0f;
    const float ny = y / view.rayDirectionY.w * 2.0f - 1.0f;
    return {glm::vec3(view.rayOrigin) + nx * glm::vec3(view.rayOriginX) + ny * glm::vec3(view.rayOriginY),
            glm::normalize(glm::vec3(view.rayDirection) + nx * glm::vec3(view.rayDirectionX) +
                           ny * glm::vec3(view.rayDirectionY))};
}

/// Largest distance between the rays of texels and those of the middles of their blocks.
float rayError(const CameraView& camera, int divisor)
{
    const LayerGrid grid = makeLayerGrid(camera, kWidth, kHeight, divisor);
    const ViewBlock full = makeViewBlock(camera, kWidth, kHeight);
    float worst = 0.0f;
    for (int y = 0; y < grid.height; ++y)
        for (int x = 0; x < grid.width; ++x) {
            const float size = float(divisor);
            const EyeRay a = rayOf(grid.view, float(x) + 0.5f, float(y) + 0.5f);
            const EyeRay b = rayOf(full, (float(x) + 0.5f) * size, (float(y) + 0.5f) * size);
            worst =
                std::max({worst, glm::length(a.origin - b.origin), glm::length(a.direction - b.direction)});
        }
    return worst;
}

BlobInstance ball(const glm::vec3& center, float radius)
{
    BlobInstance blob{};
    blob.centerRadius = {center, radius};
    return blob;
}

/// Eye at the origin, looking along -z, 90 degrees in both directions.
CameraGeometry straightAhead()
{
    return cameraGeometry(perspectiveView({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, std::acos(0.0f), 1.0f, 0.1f));
}

using Estimates = std::array<uint64_t, 3>;

} // namespace

TEST(LayerGrid, texelsLookThroughTheMiddlesOfTheirBlocks)
{
    const float aspect = float(kWidth) / kHeight;
    CameraView views[] = {perspectiveView(kPose, 1.0f, aspect, 0.1f),
                          orthographicView(kPose, 5.0f, aspect, 0.1f, 50.0f),
                          perspectiveView(kPose, 1.0f, aspect, 0.1f)};
    views[2].upperLeftOrigin = true;
    for (const CameraView& view : views)
        for (const int divisor : {2, 4})
            EXPECT_LT(rayError(view, divisor), 4e-6f);
}

TEST(LayerGrid, ofFullSizeIsThePictureBitForBit)
{
    const CameraView camera = perspectiveView(kPose, 1.0f, 1.6f, 0.1f);
    const LayerGrid grid = makeLayerGrid(camera, kWidth, kHeight, 1);
    const ViewBlock full = makeViewBlock(camera, kWidth, kHeight);
    EXPECT_EQ(std::memcmp(&grid.view, &full, sizeof full), 0);
    EXPECT_EQ(grid.width, kWidth);
    EXPECT_EQ(grid.height, kHeight);
}

TEST(FragmentEstimate, aBallOnTheAxisCoversTheSquareOfItsTangents)
{
    const BlobInstance blob = ball({0.0f, 0.0f, -10.0f}, 2.0f);
    const double slope = 2.0 / std::sqrt(96.0); // of the tangent: radius / sqrt(distance^2 - radius^2)
    const double side = slope * 500.0;
    const auto estimate = estimateFragments({&blob, 1}, straightAhead(), 500, 500);
    EXPECT_NEAR(double(estimate[0]), side * side, 1e-5 * side * side + 1.0);
    EXPECT_NEAR(double(estimate[1]), side * side / 4, 1e-5 * side * side + 1.0);
    EXPECT_NEAR(double(estimate[2]), side * side / 16, 1e-5 * side * side + 1.0);
}

TEST(FragmentEstimate, aBallAroundTheEyeCoversTheWindowAndOneBesideItNothing)
{
    const BlobInstance around = ball({0.1f, 0.0f, 0.2f}, 2.0f);
    EXPECT_EQ(estimateFragments({&around, 1}, straightAhead(), 640, 480)[0], 640u * 480u);
    const BlobInstance beside = ball({20.0f, 0.0f, -10.0f}, 1.0f);
    EXPECT_EQ(estimateFragments({&beside, 1}, straightAhead(), 640, 480)[0], 0u);
}

TEST(FragmentEstimate, smallBlobsAreWidenedToTheTexel)
{
    const std::vector<BlobInstance> sparks(1000, ball({0.0f, 0.0f, -10.0f}, 0.046f)); // 2.3 pixels across
    const auto estimate = estimateFragments(sparks, straightAhead(), 500, 500);
    EXPECT_NEAR(double(estimate[0]), 5290.0, 10.0);
    EXPECT_NEAR(double(estimate[1]), 5290.0, 10.0); // not a quarter: each is still 2.3 texels across
    EXPECT_NEAR(double(estimate[2]), 5290.0, 10.0);
}

TEST(LayerScaleControl, withoutABudgetDoesWhatIsAsked)
{
    LayerScaleControl control;
    for (const int asked : {1, 4, 2, 1})
        EXPECT_EQ(control.choose({1u << 30, 1u << 28, 1u << 26}, asked, 0, false), asked);
}

TEST(LayerScaleControl, takesTheFirstSizeThatIsAffordableAtOnce)
{
    LayerScaleControl control;
    EXPECT_EQ(control.choose({100, 25, 6}, 1, 100, false), 1);
    EXPECT_EQ(control.choose({101, 26, 7}, 1, 100, false), 2);
    EXPECT_EQ(control.choose({900, 225, 57}, 1, 100, false), 4);
    EXPECT_EQ(control.choose({9000, 2250, 570}, 1, 100, false), 4) << "there is nothing smaller";
}

TEST(LayerScaleControl, growsOneStepAfterCalmFramesOnly)
{
    LayerScaleControl control;
    const Estimates dear{900, 225, 57}, cheap{40, 10, 3}, close{90, 23, 6};
    EXPECT_EQ(control.choose(dear, 1, 100, false), 4);
    for (uint32_t frame = 1; frame < LayerScaleControl::kCalmFrames; ++frame)
        EXPECT_EQ(control.choose(cheap, 1, 100, false), 4);
    EXPECT_EQ(control.choose(cheap, 1, 100, false), 2);
    for (int frame = 0; frame < 500; ++frame) // 90 of 100 leave too little room to go back
        EXPECT_EQ(control.choose(close, 1, 100, false), 2);
    EXPECT_EQ(control.choose(close, 1, 100, true), 1) << "a cut forgets the past";
}

TEST(LayerScaleControl, doesNotFlickerAroundTheBudget)
{
    LayerScaleControl control;
    int changes = 0;
    int last = 1;
    for (int frame = 0; frame < 1000; ++frame) {
        const uint64_t full = frame % 2 == 0 ? 70 : 130; // each second frame is too dear
        const int divisor = control.choose({full, full / 4, full / 16}, 1, 100, false);
        changes += divisor != last ? 1 : 0;
        last = divisor;
    }
    EXPECT_EQ(changes, 1);
    EXPECT_EQ(last, 2);
}

TEST(LayerScaleControl, neverDrawsLargerThanAsked)
{
    LayerScaleControl control;
    for (int frame = 0; frame < 100; ++frame)
        EXPECT_EQ(control.choose({1, 1, 1}, 2, 100, false), 2);
    EXPECT_EQ(control.choose({1, 1, 1}, 4, 100, false), 4);
}
