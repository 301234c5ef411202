// Isolated balls of gas, drawn by GL, against the reference renderer's picture of the same snapshot.
#include "rendering/reference/render/reference_renderer.h"
#include "tests/rendering/view/view_fixture.h"

#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 64;

class AgainstBillboards : public ViewTest
{
protected:
    /// Largest difference of light and opacity, relative to the largest value.
    double difference(const std::vector<TestBlob>& blobs, const glm::dvec3& placement)
    {
        const glm::dvec3 eye = placement + glm::dvec3(0.0, 0.0, 6.0);
        makeTargets(kWidth, kHeight);
        setPicture(std::vector<float>(size_t(kWidth) * kHeight * 4, 0.0f));
        const auto snapshot = snapshotOf(blobs, placement);
        const Picture drawn = render(snapshot, render::perspectiveView({eye, placement, {0.0f, 1.0f, 0.0f}},
                                                                       1.0f, float(kWidth) / kHeight, 0.1f));
        render::ReferenceScene scene;
        scene.blobs = render::mediumOf({&snapshot, nullptr}, 1.0).blobs;
        scene.opaque.isEmpty = true;
        scene.camera = render::ReferenceCamera::lookAt(eye, placement, {0.0, 1.0, 0.0});
        scene.camera.halfHeight = std::tan(0.5);
        render::ReferenceSettings settings;
        settings.width = kWidth;
        settings.height = kHeight;
        settings.exposure = 1.0 / (1.2 * std::exp2(double(kEv100)));
        settings.integral.scheme = render::highScheme();
        const auto tasks = base::makeSerialRunner();
        render::ReferenceRenderer renderer;
        EXPECT_TRUE(renderer.build(scene, settings, *tasks).ok());
        EXPECT_TRUE(renderer.render(nullptr, {}).ok());
        return worst(drawn, renderer);
    }

private:
    static double worst(const Picture& drawn, const render::ReferenceRenderer& renderer)
    {
        double most = 0.0;
        double difference = 0.0;
        for (const uint32_t channel : {0u, 3u})
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x) {
                    const double exact =
                        double(renderer.pixels(channel)[size_t((kHeight - 1 - y) * kWidth + x)]);
                    difference = std::max(difference, std::abs(exact - double(drawn.at(x, y)[channel])));
                    most = std::max(most, exact);
                }
        EXPECT_GT(most, 0.3);
        return difference / most;
    }
};

} // namespace

TEST_F(AgainstBillboards, anIsolatedBlobIsTheSamePicture)
{
    EXPECT_LT(difference({{{0.3f, -0.2f, 0.1f}, 1.5f, 3.0f, 1.0f}}, glm::dvec3(0.0)), 1e-4);
}

TEST_F(AgainstBillboards, soAreTwoThatDoNotOverlapAHundredKilometresAway)
{
    EXPECT_LT(difference({{{0.1f, 0.0f, 0.0f}, 1.0f, 2.0f, 1.0f}, {{0.2f, 0.3f, -3.0f}, 1.2f, 3.0f, 0.5f}},
                         {1e5, 2e5, -1e5}),
              1e-4);
}

TEST_F(AgainstBillboards, overlappingBlobsAreNot)
{
    EXPECT_GT(difference({{{0.1f, 0.0f, 0.0f}, 1.5f, 6.0f, 1.0f}, {{0.2f, 0.1f, -0.2f}, 1.5f, 6.0f, 0.0f}},
                         glm::dvec3(0.0)),
              1e-2); // drawn one after the other; the reference is what shows it
}
