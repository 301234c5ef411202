// Media in slabs across each ray: exact where one ball stands alone, and without an order where they overlap.
#include "rendering/reference/integral/reference_integral.h"
#include "tests/rendering/view/view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 96, kHeight = 64;
const render::CameraPose kPose{{0.0, 0.0, 6.0}, {0.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f}};

class Slabs : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kWidth, kHeight);
        view_->settings().slabs = 16;
    }

    Picture drawn(const std::vector<TestBlob>& blobs, const render::CameraView& camera,
                  render::Composition composition = render::Composition::Slabs)
    {
        view_->settings().composition = composition;
        setPicture(std::vector<float>(size_t(kWidth) * kHeight * 4, 0.0f));
        return render(snapshotOf(blobs), camera);
    }

    /// Of a picture in slabs against the same drawn one over the other.
    double difference(const std::vector<TestBlob>& blobs, const render::CameraView& camera)
    {
        const Picture slabs = drawn(blobs, camera);
        const Picture sorted = drawn(blobs, camera, render::Composition::Sorted);
        EXPECT_GT(*std::max_element(sorted.texels.begin(), sorted.texels.end()), 0.05f)
            << "the ball must be in the picture";
        return maxDifference(slabs, sorted);
    }

    render::CameraView camera(float nearDistance = 0.1f)
    {
        return render::perspectiveView(kPose, 1.0f, float(kWidth) / kHeight, nearDistance);
    }
};

/// Balls within a ball of radius 1.
std::vector<TestBlob> cloud(size_t count, float radius, float opticalDepth)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> side(-1.0f, 1.0f), share(0.0f, 1.0f);
    std::vector<TestBlob> blobs;
    while (blobs.size() < count) {
        const glm::vec3 p(side(random), side(random), side(random));
        if (glm::dot(p, p) > 1.0f)
            continue;
        TestBlob blob;
        blob.center = p;
        blob.radius = radius;
        blob.crossSection = opticalDepth * 3.14159265f * radius * radius / 3.5f;
        blob.emission = share(random);
        blobs.push_back(blob);
    }
    return blobs;
}

const TestBlob kBall{{0.1f, -0.2f, 0.0f}, 1.5f, 3.0f, 1.0f};

} // namespace

TEST_F(Slabs, aBallThatStandsAloneIsExact)
{
    EXPECT_LT(difference({kBall}, camera()), 2e-5);
    view_->settings().slabs = 6;
    EXPECT_LT(difference({kBall}, camera()), 2e-5);
}

TEST_F(Slabs, theEyeMayBeInsideABall)
{
    EXPECT_LT(difference({{{0.3f, 0.2f, 5.5f}, 1.5f, 3.0f, 1.0f}}, camera()), 2e-5);
}

TEST_F(Slabs, theNearPlaneCutsABall)
{
    EXPECT_LT(difference({{{0.3f, 0.2f, 3.9f}, 0.6f, 0.6f, 1.0f}}, camera(2.0f)), 2e-5);
}

TEST_F(Slabs, anOpaqueSurfaceCutsABall)
{
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, 1.0f - 0.1f / 5.8f));
    EXPECT_LT(difference({kBall}, camera()), 2e-5);
}

namespace {

/// Exact light along the ray of each pixel of a parallel view that is 3 m high, rows from the bottom.
std::vector<double> exactLight(const std::vector<TestBlob>& blobs)
{
    const auto exponential = [](double x) { return std::exp(x); };
    const auto root = [](double x) { return std::sqrt(x); };
    std::vector<double> lights;
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const double x = (i % kWidth + 0.5 - 0.5 * kWidth) * 3.0 / kHeight;
        const double y = (i / kWidth + 0.5 - 0.5 * kHeight) * 3.0 / kHeight;
        std::vector<render::RayBlob<double>> met;
        for (const TestBlob& blob : blobs) {
            const double dx = double(blob.center.x) - x, dy = double(blob.center.y) - y,
                         r = double(blob.radius);
            const double chord2 = r * r - dx * dx - dy * dy;
            const double e = double(blob.emission);
            if (chord2 > 0.0)
                met.push_back({6.0 - double(blob.center.z),
                               chord2,
                               r,
                               double(blob.crossSection) * 1.04445431404056 / (r * r * r),
                               {e, e, e},
                               uint32_t(met.size())});
        }
        render::ReferenceIntegral<double, decltype(exponential)> integral(
            met, {0.0, std::numeric_limits<double>::infinity(), {}}, 2, false, 1e-9, root, exponential);
        lights.push_back(integral.light()[0]);
    }
    return lights;
}

} // namespace

TEST_F(Slabs, ballsThatOverlapAreTheIntegralThroughTheirSum)
{
    const std::vector<TestBlob> blobs = cloud(100, 0.4f, 0.3f);
    const std::vector<double> exact = exactLight(blobs);
    const double brightest = *std::max_element(exact.begin(), exact.end());
    const auto view = render::orthographicView(kPose, 3.0f, float(kWidth) / kHeight, 0.0f, 20.0f);
    const auto p99 = [&](const Picture& picture) {
        std::vector<double> errors;
        for (size_t i = 0; i < exact.size(); ++i)
            if (exact[i] > 1e-3 * brightest)
                errors.push_back(std::abs(double(picture.texels[4 * i]) / exact[i] - 1.0));
        std::sort(errors.begin(), errors.end());
        return errors[errors.size() * 99 / 100];
    };
    EXPECT_LT(p99(drawn(blobs, view)), 1e-3);
    view_->settings().slabs = 6;
    EXPECT_LT(p99(drawn(blobs, view)), 0.02);
    EXPECT_GT(p99(drawn(blobs, view, render::Composition::Sorted)), 0.03)
        << "the control: one over the other is not the integral";
}

TEST_F(Slabs, noOrderOfBallsIsSeen)
{
    std::vector<TestBlob> blobs = cloud(270, 0.3f, 0.5f);
    const Picture first = drawn(blobs, camera());
    const float brightest = *std::max_element(first.texels.begin(), first.texels.end());
    std::mt19937 random(1);
    double most = 0.0;
    for (int i = 0; i < 100; ++i) {
        std::shuffle(blobs.begin(), blobs.end(), random);
        most = std::max(most, maxDifference(drawn(blobs, camera()), first));
    }
    EXPECT_LT(most, double(brightest) / 1023.0);
}
