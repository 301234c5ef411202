// What simpler forms of the ray integral would do: each must miss a bound that the integrator keeps.
#include "ray_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace fx::render {
namespace {

TEST(NaiveForms, thatForgetBlobsWhoseBeginningIsBehindTheCameraJump)
{
    // The integrator's step is below 1e-5 for a camera that moves by a millionth of the radius.
    const RayBlob<double> blob{5.0, 4.0, 2.0, 0.4, {1.0, 1.0, 1.0}, 0};
    const auto seenFrom = [&](double nearest, bool isForgetful) {
        RayWindow<double> window = openWindow<double>();
        window.nearest = nearest;
        std::vector<RayBlob<double>> blobs;
        if (!isForgetful || blob.center - std::sqrt(blob.chord2) >= nearest)
            blobs.push_back(blob);
        return integrate(settingsOf("gauss-5"), blobs, window).radiance[0];
    };
    EXPECT_LT(std::fabs(seenFrom(3.0 - 1e-6, false) - seenFrom(3.0 + 1e-6, false)), 1e-5);
    EXPECT_GT(std::fabs(seenFrom(3.0 - 1e-6, true) - seenFrom(3.0 + 1e-6, true)), 0.1);
}

TEST(NaiveForms, withLinearAttenuationAreNotTheSumOfTheirPieces)
{
    const std::vector<RayBlob<double>> blobs = randomRay(12, 4.0, 21);
    const auto missing = [&](const char* name) {
        RayIntegrator<double> integrator(settingsOf(name));
        const double whole = integrator.integrate(blobs, openWindow<double>()).radiance[1];
        double worst = 0.0;
        for (double cut = 2.0; cut < 12.0; cut += 0.05) {
            RayWindow<double> front = openWindow<double>(), back = openWindow<double>();
            front.farthest = back.nearest = cut;
            const RayLight<double> a = integrator.integrate(blobs, front);
            const RayLight<double> b = integrator.integrate(blobs, back);
            worst =
                std::max(worst, std::fabs((a.radiance[1] + a.transmittance * b.radiance[1]) / whole - 1.0));
        }
        return worst;
    };
    EXPECT_LT(missing("gauss-8"), 1e-5);
    EXPECT_GT(missing("paper-1"), 1e-4);
}

TEST(NaiveForms, thatSumInTheOrderOfTheirInputDependOnIt)
{
    std::vector<RayBlob<float>> blobs = blobsAs<float>(randomRay(64, 3.0, 8));
    const auto naiveDepth = [&] {
        float sum = 0.0f;
        for (const RayBlob<float>& b : blobs)
            sum += b.extinction * b.chord2 * b.chord2 / (b.radius * b.radius * b.radius * b.radius) *
                   std::sqrt(b.chord2) * float(16.0 / 15.0);
        return sum;
    };
    const float naive = naiveDepth();
    const RayLight<float> light = integrate(settingsOf("gauss-5"), blobs);
    int moved = 0;
    for (int i = 0; i < 63; ++i) {
        std::rotate(blobs.begin(), blobs.begin() + 1, blobs.end());
        moved += naiveDepth() != naive ? 1 : 0;
        EXPECT_EQ(integrate(settingsOf("gauss-5"), blobs).opticalDepth, light.opticalDepth);
        EXPECT_EQ(integrate(settingsOf("gauss-5"), blobs).radiance, light.radiance);
    }
    EXPECT_GT(moved, 10);
}

TEST(NaiveForms, thatDoNotScaleLengthsLeaveTheRangeOfAFloat)
{
    // radius 1e-12: the integrator gives the light of any other unit, see doesNotDependOnTheUnitOfLength
    const float radius = 1e-12f;
    EXPECT_TRUE(std::isinf(1.0f / (radius * radius * radius * radius)));
    const float large = 1e6f;
    EXPECT_TRUE(std::isinf(large * large * large * large * large * large * large * large));
}

TEST(NaiveForms, thatDivideSourceByExtinctionHaveNoValueWhereThereIsNoMedium)
{
    const std::vector<RayBlob<float>> nothing = {{1.0f, 0.25f, 0.5f, 0.0f, {1.0f, 1.0f, 1.0f}, 0}};
    const float emission = nothing[0].extinction * nothing[0].source[0];
    EXPECT_TRUE(std::isnan(emission / nothing[0].extinction));
    for (const char* name : {"gauss-5", "paper-1", "positive-8", "march-0.1", "adaptive-0.01"})
        EXPECT_EQ(integrate(settingsOf(name), nothing).radiance[0], 0.0f) << name;
}

TEST(NaiveForms, thatNeverStopWorkForLightThatNobodySees)
{
    std::vector<RayBlob<float>> blobs;
    for (uint32_t i = 0; i < 400; ++i)
        blobs.push_back({float(i), 0.25f, 0.5f, 5.0f, {1.0f, 1.0f, 1.0f}, i});
    IntegralSettings going = settingsOf("gauss-5");
    going.scheme.stopDepth = kInfinity;
    RayIntegrator<float> stops(settingsOf("gauss-5")), goes(going);
    const RayLight<float> a = stops.integrate(blobs, openWindow<float>());
    const RayLight<float> b = goes.integrate(blobs, openWindow<float>());
    EXPECT_NEAR(a.radiance[0] / b.radiance[0], 1.0f, 1e-6f);
    EXPECT_LT(10 * stops.work().nodes, goes.work().nodes);
}

} // namespace
} // namespace fx::render
