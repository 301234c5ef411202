#include "ray_cases.h"

#include <gtest/gtest.h>

namespace fx::render {
namespace {

TEST(ReferenceIntegral, ofBlobsThatAllEmitOneIsTheOpacity)
{
    for (const double depth : {1e-3, 1.0, 10.0, 1000.0})
        for (const uint32_t degree : {2u, 3u, 4u}) {
            std::vector<RayBlob<double>> blobs = randomRay(9, depth, 5, degree);
            double sum = 0.0;
            for (RayBlob<double>& blob : blobs) {
                blob.source = {1.0, 1.0, 1.0};
                sum += fullDepth(blob, degree);
            }
            EXPECT_NEAR(trueLight(blobs, settingsOf("gauss-5", degree))[1] / -std::expm1(-sum), 1.0, 1e-14);
        }
}

TEST(ReferenceIntegral, ofDisjointBlobsIsOneBehindTheOther)
{
    const std::vector<RayBlob<double>> blobs = {{1.0, 0.25, 0.5, 3.0, {1.0, 0.5, 0.0}, 0},
                                                {4.0, 1.0, 1.0, 1.0, {0.0, 0.5, 2.0}, 1}};
    const double front = fullDepth(blobs[0]), back = fullDepth(blobs[1]);
    RayWindow<double> window = openWindow<double>();
    window.background = {0.0, 0.0, 7.0};
    const std::array<double, 3> light = trueLight(blobs, {}, window);
    const double passed = std::exp(-front);
    EXPECT_NEAR(light[0], 1.0 - passed, 1e-15);
    EXPECT_NEAR(light[1], 0.5 * (1.0 - passed * std::exp(-back)), 1e-15);
    EXPECT_NEAR(light[2], 2.0 * passed * (1.0 - std::exp(-back)) + 7.0 * passed * std::exp(-back), 1e-14);
}

TEST(ReferenceIntegral, ofAThinBlobInTheProductModelIsTheIntegralOfTheKernelSquared)
{
    // integral of (1 - u^2)^4 over [-1, 1] = 256/315
    const std::vector<RayBlob<double>> blobs = {{1.0, 4.0, 2.0, 1e-9, {3.0, 1.0, 1.0}, 0}};
    const double expected = 1e-9 * 3.0 * 2.0 * 256.0 / 315.0;
    EXPECT_NEAR(trueLight(blobs, settingsOf("gauss-5", 2, SourceModel::Product))[0] / expected, 1.0, 1e-8);
}

TEST(ReferenceIntegral, doesNotChangeWithItsTolerance)
{
    const std::vector<RayBlob<double>> blobs = randomRay(12, 5.0, 17);
    const std::array<double, 3> loose = trueLight(blobs, {}, openWindow<double>(), 1e-12);
    const std::array<double, 3> tight = trueLight(blobs, {}, openWindow<double>(), 1e-26);
    for (size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(loose[c] / tight[c], 1.0, 1e-11);
}

} // namespace
} // namespace fx::render
