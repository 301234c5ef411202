// One ball of gas, drawn by GL into a float target, against the exact integral in double precision, pixel by
// pixel.
#include "rendering/frame/view_block.h"
#include "rendering/reference/blob_medium/blob_medium.h"
#include "view_fixture.h"

#include <glm/matrix.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kFar = std::numeric_limits<double>::infinity();
const render::CameraPose kPose{{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}};

/// World ray of a pixel, by inverting the matrices in double: independent of the renderer's own rays.
render::Ray pixelRay(const render::CameraView& camera, int x, int y)
{
    const glm::dmat4 inverse = glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
    const double nx = 2.0 * (x + 0.5) / kWidth - 1.0;
    const double ny = 2.0 * (y + 0.5) / kHeight - 1.0;
    const auto point = [&](double depth) {
        const glm::dvec4 p = inverse * glm::dvec4(nx, ny, depth, 1.0);
        return glm::dvec3(p) / p.w;
    };
    const bool reversed = camera.depth == render::DepthConvention::Reversed;
    const glm::dvec3 nearPoint = point(reversed ? 1.0 : -1.0);
    const glm::dvec3 direction = glm::normalize(point(reversed ? 0.5 : 0.5) - nearPoint);
    return {camera.origin + nearPoint, direction}; // starts at the near plane
}

/// Exact opacity of `medium` before `end` [m] of axis distance.
double exactOpacity(const render::BlobMedium& medium, const render::CameraView& camera, int x, int y,
                    double planeDistance)
{
    const render::Ray ray = pixelRay(camera, x, y);
    const glm::dvec3 forward(-camera.view[0][2], -camera.view[1][2], -camera.view[2][2]);
    const glm::dvec3 eye = kPose.position;
    const double already = glm::dot(ray.origin - eye, forward);
    const double end =
        std::isinf(planeDistance) ? 1e9 : (planeDistance - already) / glm::dot(ray.direction, forward);
    return -std::expm1(-medium.opticalDepth(ray, 0.0, end));
}

class ViewExactness : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
    }

    /// Largest error of alpha and of light, relative to the largest exact value.
    double error(const TestBlob& blob, const render::CameraView& camera, double planeDistance = kFar)
    {
        setPicture(std::vector<float>(size_t(kWidth) * kHeight * 4, 0.0f));
        const auto snapshot = snapshotOf({blob});
        const Picture picture = render(snapshot, camera);
        const render::BlobMedium medium(
            {{glm::dvec3(blob.center), double(blob.radius), double(blob.crossSection), glm::dvec3(1.0)}});
        double worst = 0.0;
        double most = 0.0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const double exact = exactOpacity(medium, camera, x, y, planeDistance);
                worst = std::max({worst, std::abs(double(picture.at(x, y)[3]) - exact),
                                  std::abs(double(picture.at(x, y)[0]) - exact)});
                most = std::max(most, exact);
            }
        EXPECT_GT(most, 0.05) << "the ball must be in the picture";
        return worst / most;
    }

    render::CameraView camera(float fov = 1.0f,
                              render::DepthConvention depth = render::DepthConvention::Standard)
    {
        return render::perspectiveView(kPose, fov, float(kWidth) / kHeight, 0.1f, depth);
    }
};

} // namespace

TEST_F(ViewExactness, aBallInTheMiddleIsExact)
{
    EXPECT_LT(error({{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f}, camera()), 1e-5);
}

TEST_F(ViewExactness, theEyeInsideTheBallIsExact)
{
    EXPECT_LT(error({{0.3f, 0.2f, 5.5f}, 1.5f, 3.0f, 1.0f}, camera()), 1e-5);
}

TEST_F(ViewExactness, aBallCutByTheNearPlaneIsExact)
{
    auto view = render::perspectiveView(kPose, 1.0f, float(kWidth) / kHeight, 2.0f);
    EXPECT_LT(error({{0.3f, 0.2f, 3.9f}, 0.6f, 0.6f, 1.0f}, view), 1e-5);
}

TEST_F(ViewExactness, aBallCutByAPlaneIsExact)
{
    const float distance = 5.8f;
    setDepth(std::vector<float>(size_t(kWidth) * kHeight,
                                1.0f - 0.1f / distance)); // clip 1 - 2 n/d, stored (clip + 1)/2
    const float stored = 1.0f - 0.1f / distance;
    EXPECT_LT(error({{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f}, camera(), 0.1 / (1.0 - double(stored))), 1e-5);
}

TEST_F(ViewExactness, aBallInTheCornerAt45DegreesIsExact)
{
    const float fov = 1.8f; // the corner is 56 degrees off the axis
    EXPECT_LT(error({{5.1f, 3.2f, 0.0f}, 1.0f, 2.0f, 1.0f}, camera(fov)), 1e-5);
}

TEST_F(ViewExactness, anOrthographicViewIsExact)
{
    const auto view = render::orthographicView(kPose, 5.0f, float(kWidth) / kHeight, 0.1f, 20.0f);
    EXPECT_LT(error({{1.0f, 0.4f, 0.0f}, 1.5f, 3.0f, 1.0f}, view), 1e-5);
}

TEST_F(ViewExactness, reversedInfiniteDepthIsExact)
{
    const auto view = camera(1.0f, render::DepthConvention::Reversed);
    EXPECT_LT(error({{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f}, view), 1e-5);
    const float stored = 0.1f / 5.8f;
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, stored));
    EXPECT_LT(error({{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f}, view, 0.1 / double(stored)), 1e-5);
}

TEST_F(ViewExactness, reversedDepthOfZeroIsTheSkyAndOccludesNothing)
{
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, 0.0f));
    EXPECT_LT(error({{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f}, camera(1.0f, render::DepthConvention::Reversed)),
              1e-5);
}

TEST_F(ViewExactness, theOtherFormsAreNotTheKernel)
{
    const TestBlob blob{{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f};
    view_->settings().form = render::BillboardForm::Constant;
    EXPECT_GT(error(blob, camera()), 0.02);
    view_->settings().form = render::BillboardForm::Planar;
    EXPECT_LT(error(blob, camera()), 1e-5)
        << "a whole ball in front of everything: the card has its full depth";
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, 1.0f - 0.1f / 5.8f));
    EXPECT_GT(error(blob, camera(), 5.8), 0.2) << "but a card cannot be cut in half";
}
