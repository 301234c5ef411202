#include "ray_cases.h"
#include "rendering/reference/integral/accuracy_cases.h"

#include <gtest/gtest.h>

namespace fx::render {
namespace {

constexpr double kCreated = 2e-4; ///< what no scheme may add to a furnace

TEST(Furnace, ofTheDefaultSchemeIsWithinAThousandth)
{
    IntegralSettings settings;
    settings.scheme = defaultScheme();
    for (const FurnaceError& error : {furnaceError<float>(settings), furnaceError<double>(settings)}) {
        EXPECT_LE(error.largest, 1e-3) << error.atDepth << ' ' << error.atBlobs;
        EXPECT_LE(error.excess, kCreated);
    }
}

TEST(Furnace, ofTheHighSchemeIsWithinATenThousandthInFloatAndFiftyThousandthInDouble)
{
    IntegralSettings settings;
    settings.scheme = highScheme();
    const FurnaceError inFloat = furnaceError<float>(settings);
    EXPECT_LE(inFloat.largest, 1e-4) << inFloat.atDepth << ' ' << inFloat.atBlobs;
    EXPECT_LE(inFloat.excess, kCreated);
    const FurnaceError inDouble = furnaceError<double>(settings);
    EXPECT_LE(inDouble.largest, 2e-5) << inDouble.atDepth << ' ' << inDouble.atBlobs;
}

TEST(Furnace, ofHalfTheCapIsThreeTimesBetter)
{
    EXPECT_LE(furnaceError<double>(settingsOf("gauss-5-cap-0.5")).largest, 3e-4);
}

TEST(Furnace, ofThePositiveSchemeIsExactBeyondRounding)
{
    EXPECT_LE(furnaceError<double>(settingsOf("positive-8")).largest, 1e-12);
    EXPECT_LE(furnaceError<float>(settingsOf("positive-8")).largest, 1e-5);
}

TEST(Furnace, ofOtherKernelsHoldsTheSameBounds)
{
    for (const uint32_t degree : {3u, 4u}) {
        EXPECT_LE(furnaceError<double>(settingsOf("gauss-5", degree)).largest, 1e-3) << degree;
        EXPECT_LE(furnaceError<double>(settingsOf("gauss-8", degree)).largest, 2e-5) << degree;
        EXPECT_LE(furnaceError<float>(settingsOf("gauss-8", degree)).largest, 1e-4) << degree;
    }
}

TEST(Furnace, withoutTheCapCreatesLight)
{
    const FurnaceError error = furnaceError<double>(settingsOf("gauss-5-cap-inf"));
    EXPECT_GT(error.excess, 1.0); // more than twice the light that there is
}

TEST(Furnace, ofThePublishedSchemeGoesDark)
{
    EXPECT_GT(furnaceError<double>(settingsOf("paper-1")).largest, 0.99);
}

TEST(Furnace, isAsBrightWhetherTheRayEndsEarlyOrNot)
{
    IntegralSettings stopping, going;
    going.scheme.stopDepth = kInfinity;
    for (const double depth : {10.0, 31.0, 60.0, 300.0, 1e5})
        for (uint64_t seed = 0; seed < 10; ++seed) {
            const std::vector<RayBlob<double>> blobs = randomRay(16, depth, seed);
            const RayLight<double> a = integrate(stopping, blobs), b = integrate(going, blobs);
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(a.radiance[c] / b.radiance[c], 1.0, 1e-12) << depth;
            EXPECT_EQ((b.flags & kRayStopped), 0u);
        }
}

TEST(Furnace, beyondSixtyFourPartsIsFlaggedAndStillWithinBounds)
{
    const std::vector<RayBlob<double>> blobs = {{2.0, 1.0, 1.0, 1e6, {1.0, 0.5, 0.0}, 0}};
    const RayLight<double> light = integrate(settingsOf("gauss-5"), blobs);
    EXPECT_NE(light.flags & kRayFallback, 0u);
    EXPECT_NEAR(light.radiance[0], 1.0, 1e-12);
    EXPECT_NEAR(light.radiance[1], 0.5, 1e-12);
    EXPECT_EQ(light.radiance[2], 0.0);
    EXPECT_EQ(integrate(settingsOf("gauss-5"), randomRay(4, 10.0, 1)).flags & kRayFallback, 0u);
}

} // namespace
} // namespace fx::render
