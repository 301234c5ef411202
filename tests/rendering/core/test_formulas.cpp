// The formula texts as C++: exact limits, integrals over space, and an independent quadrature.
#include "foundation/random/philox.h"
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Random number in [low, high), one stream a test.
class Uniform
{
public:
    double operator()(double low, double high)
    {
        const auto words = fx::base::randomUnit4(7, 0, index_++, fx::base::RandomPurpose::Attributes);
        return low + (high - low) * double(words[0]);
    }

private:
    uint64_t index_ = 0;
};

/// Optical depth of the quartic blob by 2000 midpoint steps: written from the definition of the kernel.
double quadrature(double sigma, double r, double h, double tc, double t0, double t1)
{
    const double from = std::max(t0, tc - r);
    const double to = std::min(t1, tc + r);
    const int steps = 2000;
    double sum = 0.0;
    for (int i = 0; i < steps && to > from; ++i) {
        const double t = from + (to - from) * (i + 0.5) / steps;
        const double q2 = (h * h + (t - tc) * (t - tc)) / (r * r);
        if (q2 < 1.0)
            sum += (1.0 - q2) * (1.0 - q2) * (to - from) / steps;
    }
    return sigma * 105.0 / (32.0 * kPi * r * r * r) * sum;
}

} // namespace

TEST(SpherePath, throughTheCenterIsTheDiameter)
{
    EXPECT_DOUBLE_EQ(fx::formula64::fxSpherePath(2.0, 0.0, 10.0, 0.0, kFar), 4.0);
}

TEST(SpherePath, aRayThatMissesHasNoPath)
{
    EXPECT_EQ(fx::formula64::fxSpherePath(2.0, 2.0, 10.0, 0.0, kFar), 0.0);
    EXPECT_EQ(fx::formula64::fxSpherePath(2.0, 3.0, 10.0, 0.0, kFar), 0.0);
}

TEST(SpherePath, theEyeInsideSeesOnlyWhatIsInFront)
{
    EXPECT_DOUBLE_EQ(fx::formula64::fxSpherePath(2.0, 0.0, 0.0, 0.5, kFar), 1.5);
}

TEST(SpherePath, overTheDiscItGivesTheVolumeOfTheBall)
{
    const double r = 1.7;
    double volume = 0.0;
    const int rings = 20000;
    for (int i = 0; i < rings; ++i) {
        const double h = r * (i + 0.5) / rings;
        volume += fx::formula64::fxSpherePath(r, h, 5.0, 0.0, kFar) * 2.0 * kPi * h * (r / rings);
    }
    EXPECT_NEAR(volume, 4.0 / 3.0 * kPi * r * r * r, 1e-4);
}

TEST(SpherePath, keepsItsRelativeAccuracyUpToTheRim)
{
    const float r = 1000.0f;
    const float h = 999.99994f; // one step below r
    const double exact = 2.0 * std::sqrt((double(r) - double(h)) * (double(r) + double(h)));
    EXPECT_NEAR(fx::formula::fxSpherePath(r, h, 0.0f, -1e6f, 1e6f) / exact, 1.0, 1e-6);
}

TEST(UniformBall, holdsItsCrossSection)
{
    const double r = 0.8;
    const double sigma = 2.5;
    double sum = 0.0;
    const int rings = 20000;
    for (int i = 0; i < rings; ++i) {
        const double h = r * (i + 0.5) / rings;
        sum += fx::formula64::fxUniformBallOpticalDepth(sigma, r, h, 5.0, 0.0, kFar) * 2.0 * kPi * h *
               (r / rings);
    }
    EXPECT_NEAR(sum, sigma, 1e-4);
}

TEST(KernelOpticalDepth, throughTheCenterIsThreeAndAHalfCrossSectionsPerDisc)
{
    EXPECT_NEAR(fx::formula64::fxKernelOpticalDepth(2.0, 0.5, 0.0, 3.0, 0.0, kFar), 3.5 / kPi * 2.0 / 0.25,
                1e-12);
}

TEST(KernelOpticalDepth, overTheDiscItHoldsItsCrossSection)
{
    const double r = 0.8;
    const double sigma = 2.5;
    double sum = 0.0;
    const int rings = 20000;
    for (int i = 0; i < rings; ++i) {
        const double h = r * (i + 0.5) / rings;
        sum += fx::formula64::fxKernelOpticalDepth(sigma, r, h, 5.0, 0.0, kFar) * 2.0 * kPi * h * (r / rings);
    }
    EXPECT_NEAR(sum, sigma, 1e-6);
}

TEST(KernelOpticalDepth, isZeroOutsideAndAtTheRim)
{
    EXPECT_EQ(fx::formula::fxKernelOpticalDepth(1.0f, 1.0f, 1.0f, 0.0f, -9.0f, 9.0f), 0.0f);
    EXPECT_EQ(fx::formula::fxKernelOpticalDepth(1.0f, 1.0f, 5.0f, 0.0f, -9.0f, 9.0f), 0.0f);
    EXPECT_EQ(fx::formula::fxKernelOpticalDepth(1.0f, 1.0f, 0.2f, 0.0f, 4.0f, 9.0f), 0.0f);
}

TEST(KernelOpticalDepth, equalsQuadratureForThreeHundredClippedRays)
{
    Uniform uniform;
    for (int i = 0; i < 300; ++i) {
        const double r = uniform(0.1, 4.0);
        const double h = uniform(0.0, r);
        const double tc = uniform(-2.0, 8.0);
        const double t0 = uniform(0.0, tc + r);
        const double t1 = t0 + uniform(0.0, 2.5 * r);
        const double exact = quadrature(1.0, r, h, tc, t0, t1);
        const double most = 3.5 / (kPi * r * r);
        EXPECT_NEAR(fx::formula64::fxKernelOpticalDepth(1.0, r, h, tc, t0, t1), exact, 2e-6 * most);
        EXPECT_NEAR(
            fx::formula::fxKernelOpticalDepth(1.0f, float(r), float(h), float(tc), float(t0), float(t1)),
            exact, 4e-6 * most);
    }
}

TEST(KernelOpticalDepth, cuttingTheRayAnywhereLeavesTheSum)
{
    Uniform uniform;
    const double whole = fx::formula64::fxKernelOpticalDepth(1.0, 1.0, 0.3, 2.0, 0.0, kFar);
    for (int i = 0; i < 1000; ++i) {
        const double cut = uniform(0.5, 3.5);
        const double parts = fx::formula64::fxKernelOpticalDepth(1.0, 1.0, 0.3, 2.0, 0.0, cut) +
                             fx::formula64::fxKernelOpticalDepth(1.0, 1.0, 0.3, 2.0, cut, kFar);
        EXPECT_NEAR(parts, whole, 1e-14);
    }
}

TEST(KernelQuantile, isWhereTheGivenShareOfTheChordHasBeenPassed)
{
    for (int i = 0; i <= 2000; ++i) {
        const double f = i / 2000.0;
        const double u = fx::formula64::fxKernelQuantile(f);
        EXPECT_LE(std::abs(u), 1.0);
        // the ball of radius 1 cut at u, as the optical depth has it
        const double passed =
            quadrature(1.0, 1.0, 0.0, 0.0, -1.0, u) / quadrature(1.0, 1.0, 0.0, 0.0, -1.0, 1.0);
        EXPECT_NEAR(passed, f, 2e-6);
        EXPECT_NEAR(double(fx::formula::fxKernelPassed(float(u))), passed, 1e-5);
        EXPECT_NEAR(double(fx::formula::fxKernelQuantile(float(f))), u, 2e-4);
    }
}

TEST(KernelQuantile, isOddAboutTheMiddleAndNeverTurnsBack)
{
    double last = -1.0;
    for (int i = 0; i <= 1000; ++i) {
        const double u = fx::formula64::fxKernelQuantile(i / 1000.0);
        EXPECT_GE(u, last);
        EXPECT_NEAR(u, -fx::formula64::fxKernelQuantile(1.0 - i / 1000.0), 1e-9);
        last = u;
    }
    EXPECT_EQ(fx::formula64::fxKernelQuantile(0.5), 0.0);
    EXPECT_NEAR(fx::formula64::fxKernelQuantile(-3.0), fx::formula64::fxKernelQuantile(0.0), 0.0);
    EXPECT_NEAR(fx::formula64::fxKernelQuantile(7.0), fx::formula64::fxKernelQuantile(1.0), 0.0);
}

TEST(KernelOpticalDepth, growsWithTheLengthOfTheRay)
{
    double before = 0.0;
    for (int i = 0; i <= 400; ++i) {
        const double now = fx::formula64::fxKernelOpticalDepth(1.0, 1.0, 0.4, 2.0, 0.0, 0.01 * i);
        EXPECT_GE(now, before);
        before = now;
    }
}

TEST(DetailNoise, staysInItsRangeAndHasNoMean)
{
    Uniform uniform;
    double sum = 0.0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
        const float x = float(uniform(-50.0, 50.0));
        const float y = float(uniform(-50.0, 50.0));
        const float z = float(uniform(-50.0, 50.0));
        const float n = fx::formula::fxDetailNoise(x, y, z);
        EXPECT_LE(std::abs(n), 1.0f);
        sum += double(n);
    }
    EXPECT_NEAR(sum / count, 0.0, 0.02);
}

TEST(DetailNoise, isContinuous)
{
    for (int i = 0; i < 2000; ++i) {
        const float x = 0.013f * float(i);
        const float step =
            fx::formula::fxDetailNoise(x + 1e-3f, 0.3f, 0.7f) - fx::formula::fxDetailNoise(x, 0.3f, 0.7f);
        EXPECT_LT(std::abs(step), 0.06f);
    }
}
