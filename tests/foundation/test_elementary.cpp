#include "foundation/math/elementary.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

using namespace fx::base;

namespace {
double relative(double got, double want)
{
    return std::abs(got - want) / std::abs(want);
}
} // namespace

TEST(NaturalExp, agreesWithTheLibraryOverTheWholeRange)
{
    for (double x = -700.0; x <= 700.0; x += 0.0137)
        ASSERT_LE(relative(naturalExp(x), std::exp(x)), 1e-15) << x;
}

TEST(NaturalExp, isExactAtZeroAndBoundedAtTheEnds)
{
    EXPECT_EQ(naturalExp(0.0), 1.0);
    EXPECT_EQ(naturalExp(-0.0), 1.0);
    EXPECT_EQ(naturalExp(-1e30), 0.0);
    EXPECT_EQ(naturalExp(-std::numeric_limits<double>::infinity()), 0.0);
    EXPECT_EQ(naturalExp(1e30), naturalExp(709.0));
    EXPECT_TRUE(std::isfinite(naturalExp(1e30)));
    EXPECT_TRUE(std::isnan(naturalExp(std::numeric_limits<double>::quiet_NaN())));
}

TEST(NaturalExp, keepsItsAccuracyForTinyArguments)
{
    for (double x = 1e-18; x < 1e-2; x *= 3.7)
        ASSERT_NEAR(naturalExp(-x), std::exp(-x), 2.3e-16) << x;
}

TEST(NaturalLog, agreesWithTheLibraryOverAllMagnitudes)
{
    for (double x = 2.3e-308; x < 1e308; x *= 1.0371)
        ASSERT_LE(std::abs(naturalLog(x) - std::log(x)), 5e-16 * std::abs(std::log(x))) << x;
}

TEST(NaturalLog, keepsItsRelativeAccuracyNearOne)
{
    EXPECT_EQ(naturalLog(1.0), 0.0);
    for (double d = 1e-15; d < 0.9; d *= 1.31) {
        ASSERT_LE(relative(naturalLog(1.0 + d), std::log(1.0 + d)), 5e-16) << d;
        ASSERT_LE(relative(naturalLog(1.0 - d), std::log(1.0 - d)), 5e-16) << d;
    }
}

TEST(NaturalLog, hasTheLimitsOfALogarithm)
{
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(naturalLog(0.0), -infinity);
    EXPECT_EQ(naturalLog(1e-310), -infinity);
    EXPECT_EQ(naturalLog(infinity), infinity);
    EXPECT_TRUE(std::isnan(naturalLog(-1.0)));
    EXPECT_TRUE(std::isnan(naturalLog(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Power, agreesWithTheLibrary)
{
    for (double x = 1e-30; x < 1e30; x *= 1.73)
        for (const double y : {-2.0 / 3.0, -0.4, 0.3, 0.4, 2.0 / 3.0, 1.0, 1.4, 5.0 / 3.0, 6.15}) {
            const double bound = 1e-15 * (2.0 + std::abs(y * std::log(x)));
            ASSERT_LE(relative(power(x, y), std::pow(x, y)), bound) << x << " to the power " << y;
        }
}

TEST(Power, isExactWhereItCanBe)
{
    EXPECT_EQ(power(0.0, 1.4), 0.0);
    EXPECT_EQ(power(0.0, 0.0), 1.0);
    EXPECT_EQ(power(1.0, -0.4), 1.0);
    EXPECT_EQ(power(1e300, 0.0), 1.0);
    EXPECT_TRUE(std::isfinite(power(1e300, 5.0)));
}

TEST(CubeRoot, agreesWithTheLibraryOverAllMagnitudes)
{
    for (double x = 1e-290; x < 1e290; x *= 1.37) {
        ASSERT_LE(relative(cubeRoot(x), std::cbrt(x)), 1e-15) << x;
        ASSERT_EQ(cubeRoot(-x), -cubeRoot(x)) << x;
    }
}

TEST(CubeRoot, ofNothingIsNothing)
{
    EXPECT_EQ(cubeRoot(0.0), 0.0);
    EXPECT_EQ(cubeRoot(1e-310), 0.0);
}

TEST(SinCosTurns, agreesWithTheLibrary)
{
    for (double t = -3.0; t < 3.0; t += 0.000731) {
        const SinCos got = sinCosTurns(t);
        // Reduced before the library sees it, so that its argument is as exact as ours.
        const double a = 2.0 * std::numbers::pi * (t - std::round(t));
        ASSERT_NEAR(got.sin, std::sin(a), 8e-16) << t;
        ASSERT_NEAR(got.cos, std::cos(a), 8e-16) << t;
    }
}

TEST(SinCosTurns, isExactAtQuarterTurnsHoweverMany)
{
    for (const double whole : {0.0, 5.0, -7.0, 1048576.0}) {
        EXPECT_EQ(sinCosTurns(whole).sin, 0.0);
        EXPECT_EQ(sinCosTurns(whole).cos, 1.0);
        EXPECT_EQ(sinCosTurns(whole + 0.25).sin, 1.0);
        EXPECT_EQ(sinCosTurns(whole + 0.25).cos, 0.0);
        EXPECT_EQ(sinCosTurns(whole + 0.5).cos, -1.0);
        EXPECT_EQ(sinCosTurns(whole + 0.75).sin, -1.0);
    }
}

TEST(SinCosTurns, liesOnTheUnitCircle)
{
    for (double t = 0.0; t < 1.0; t += 0.00117) {
        const SinCos p = sinCosTurns(t);
        ASSERT_NEAR(p.sin * p.sin + p.cos * p.cos, 1.0, 1e-15);
    }
}

TEST(SmoothStep, isFlatOutsideItsEdgesAndHalfInTheMiddle)
{
    EXPECT_EQ(smoothStep(2.0f, 4.0f, 1.0f), 0.0f);
    EXPECT_EQ(smoothStep(2.0f, 4.0f, 5.0f), 1.0f);
    EXPECT_EQ(smoothStep(2.0f, 4.0f, 3.0f), 0.5f);
}
