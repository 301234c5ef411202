// A slab of medium with a linear source, against quadrature of its definition.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

/// Light of the source s + s1 x in even medium of depth d, by 20000 midpoint steps.
double quadrature(double d, double s, double s1)
{
    constexpr int kSteps = 20000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double x = (i + 0.5) / kSteps - 0.5;
        sum += (s + s1 * x) * d * std::exp(-d * (x + 0.5)) / kSteps;
    }
    return sum;
}

/// The same from integrals and moments.
template <class T>
T fromMoments(T d, T e, T md, T me)
{
    if constexpr (std::is_same_v<T, float>)
        return fx::formula::fxSlabLight(d, e, fx::formula::fxSlabSlope(d, e, md, me));
    else
        return fx::formula64::fxSlabLight(d, e, fx::formula64::fxSlabSlope(d, e, md, me));
}

} // namespace

TEST(SlabLight, aLinearSourceIsTheIntegralForAnyDepth)
{
    for (double d = 1e-6; d < 50.0; d *= 1.7)
        for (const double s1 : {-1.9, -0.7, 0.0, 0.4, 2.0}) {
            const double exact = quadrature(d, 1.0, s1); // e = s d, me = s1 d/12
            EXPECT_NEAR(fromMoments(d, d, 0.0, s1 * d / 12.0), exact, 2e-6 * exact) << d << ' ' << s1;
            EXPECT_NEAR(fromMoments(float(d), float(d), 0.0f, float(s1 * d / 12.0)), exact, 2e-5 * exact)
                << d << ' ' << s1;
        }
}

TEST(SlabLight, anEvenSourceIsItselfTimesTheOpacityWhereverTheMediumLies)
{
    for (const double md : {-0.4, 0.0, 0.3})
        EXPECT_NEAR(fromMoments(2.0, 3.0 * 2.0, md * 2.0, 3.0 * md * 2.0), 3.0 * -std::expm1(-2.0), 1e-12);
}

TEST(SlabLight, aThinSlabIsAPolynomialThatNothingIsDividedBy)
{
    for (const double d : {0.05, 0.01, 1e-6})
        for (const double s1 : {-1.9, 0.0, 1.3}) {
            const double exact = quadrature(d, 1.0, s1);
            const double thin = fx::formula64::fxSlabThinLight(d, d, 0.0, s1 * d / 12.0);
            EXPECT_NEAR(thin, exact, 2e-6 * exact) << d << ' ' << s1;
        }
    // without a medium, and where rims of a field make all signs turn round
    EXPECT_EQ(fx::formula64::fxSlabThinLight(0.0, 5.0, 0.0, 0.2), 5.0);
    EXPECT_NEAR(fx::formula64::fxSlabThinLight(-0.01, -0.03, 0.0, 0.0), 3.0 * -std::expm1(0.01), 1e-9);
}

TEST(SlabLight, whatEmitsWithoutHidingAddsUp)
{
    EXPECT_EQ(fromMoments(0.0, 5.0, 0.0, 0.2), 5.0);
    EXPECT_EQ(fromMoments(0.0, 0.0, 0.0, 0.0), 0.0);
}

TEST(SlabLight, theSourceIsNowhereNegative)
{
    for (const double me : {-0.5, 0.5}) // all light at one face
        for (double d = 0.01; d < 30.0; d *= 2.0) {
            const double light = fromMoments(d, 1.0, 0.0, me);
            EXPECT_GE(light, 0.0);
            EXPECT_LE(light, 1.0);
        }
}

TEST(SlabLight, lightAtTheNearFaceIsSeenAndAtTheFarOneHidden)
{
    EXPECT_GT(fromMoments(3.0, 1.0, 0.0, -0.1), fromMoments(3.0, 1.0, 0.0, 0.1));
}

TEST(KernelMoment, itIsTheIntegralOfTheDensityTimesThePlace)
{
    double sum = 0.0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) { // midpoint rule from -1
        const double u = -1.0 + 2.0 * (i + 0.5) / kSteps;
        const double q = 1.0 - u * u;
        sum += u * 15.0 / 16.0 * q * q * 2.0 / kSteps;
        if (i % 1000 == 999) {
            const double end = -1.0 + 2.0 * (i + 1) / kSteps;
            EXPECT_NEAR(fx::formula64::fxKernelMoment(end), sum, 1e-8);
            EXPECT_NEAR(double(fx::formula::fxKernelMoment(float(end))), sum, 1e-7);
        }
    }
}
