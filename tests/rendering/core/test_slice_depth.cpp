// The depth between two light slices, against media whose depth is known everywhere.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using fx::formula64::fxSliceDepth;

namespace {

/// Largest error of the depth between planes of a medium. @param depth up to x, for x from 0 to 1
/// @param isLinear a straight line instead of the formula
template <class Depth>
double worstError(const Depth& depth, int slabs, bool isLinear)
{
    const auto between = [&](int k) {
        return k < 0 || k >= slabs ? 0.0 : depth(double(k + 1) / slabs) - depth(double(k) / slabs);
    };
    double worst = 0.0;
    for (int k = 0; k < slabs; ++k)
        for (int i = 0; i <= 16; ++i) {
            const double x = i / 16.0;
            const double inside =
                isLinear ? x * between(k) : fxSliceDepth(between(k - 1), between(k), between(k + 1), x);
            worst = std::max(worst, std::abs(depth(double(k) / slabs) + inside - depth((k + x) / slabs)));
        }
    return worst;
}

/// A ball with the quartic kernel, radius 0.4, in the middle: the depth along the line through its center.
double ofBall(double x)
{
    const double q = std::clamp((x - 0.5) / 0.4, -1.0, 1.0);
    return 5.0 * (q - 2.0 / 3.0 * q * q * q + q * q * q * q * q / 5.0 + 8.0 / 15.0);
}

} // namespace

TEST(SliceDepth, isThatOfTheSlabAtItsPlanes)
{
    for (const double d0 : {0.0, 0.3, 4.0})
        for (const double d : {0.0, 1.0, 20.0})
            for (const double d1 : {0.0, 0.3, 4.0}) {
                EXPECT_EQ(fxSliceDepth(d0, d, d1, 0.0), 0.0);
                EXPECT_NEAR(fxSliceDepth(d0, d, d1, 1.0), d, 1e-15 * d);
            }
    EXPECT_EQ(fx::formula::fxSliceDepth(0.0f, 0.0f, 0.0f, 0.5f), 0.0f);
}

TEST(SliceDepth, neverFallsTowardsTheLight)
{
    for (const double d0 : {0.0, 1e-6, 0.5, 1.0, 30.0})
        for (const double d1 : {0.0, 1e-6, 0.5, 1.0, 30.0}) {
            double before = 0.0;
            for (int i = 1; i <= 200; ++i) {
                const double depth = fxSliceDepth(d0, 1.0, d1, i / 200.0);
                EXPECT_GE(depth, before - 1e-15) << d0 << ' ' << d1 << ' ' << i;
                before = depth;
            }
        }
}

TEST(SliceDepth, isExactInEvenMedia)
{
    for (int i = 0; i <= 10; ++i)
        EXPECT_NEAR(fxSliceDepth(2.0, 2.0, 2.0, i / 10.0), 0.2 * i, 1e-14);
}

TEST(SliceDepth, isTheSameFromBothSides)
{
    for (int i = 0; i <= 10; ++i) {
        const double x = i / 10.0;
        EXPECT_NEAR(fxSliceDepth(0.3, 1.0, 5.0, x), 1.0 - fxSliceDepth(5.0, 1.0, 0.3, 1.0 - x), 1e-14);
    }
}

TEST(SliceDepth, errorsInABallFallFasterThanThoseOfAStraightLine)
{
    for (const int slabs : {16, 32, 64, 128}) {
        const double cubic = worstError(ofBall, slabs, false), line = worstError(ofBall, slabs, true);
        EXPECT_LT(cubic, 0.4 * line) << slabs;
        EXPECT_LT(worstError(ofBall, 2 * slabs, false), cubic / 3.5) << slabs;
    }
}
