#include "quad.h"

#include <gtest/gtest.h>

namespace fx::render::integral {
namespace {

TEST(AttenuationExponential, isWithinItsBoundOfTheTrueValueForEveryOpticalDepth)
{
    double worstFloat = 0.0, worstDouble = 0.0;
    for (int step = -3000; step <= 3868; ++step) {
        const float x = float(std::pow(10.0, step / 2000.0)); // up to 86
        const double exact = double(expq(-Quad(x)));
        worstFloat = std::max(worstFloat, std::fabs(double(expOfMinus(x)) / exact - 1.0));
        worstDouble = std::max(worstDouble, std::fabs(expOfMinus(double(x)) / exact - 1.0));
    }
    EXPECT_LT(worstFloat, 2e-7);
    EXPECT_LT(worstDouble, 1e-15);
}

TEST(AttenuationExponential, ofNothingIsExactlyOneAndOfAnyAmountIsPositive)
{
    EXPECT_EQ(expOfMinus(0.0f), 1.0f);
    EXPECT_EQ(expOfMinus(0.0), 1.0);
    EXPECT_GT(expOfMinus(1e30f), 0.0f);
    EXPECT_LT(expOfMinus(1e30f), 2e-38f);
    EXPECT_GT(expOfMinus(std::numeric_limits<double>::infinity()), 0.0);
    EXPECT_TRUE(std::isfinite(expOfMinus(-1e30f)));
}

TEST(AttenuationExponential, needsNoReductionBelowTheLimitOfThinParts)
{
    for (int i = -1000; i <= 1000; ++i) {
        const float x = kSmallDepth * float(i) / 1000.0f;
        EXPECT_EQ(expOfMinus(x), expSeries(0.0f - x)) << x;
        EXPECT_EQ(expOfMinus(double(x)), expSeries(0.0 - double(x))) << x;
    }
    EXPECT_NE(expOfMinus(0.8f), expSeries(-0.8f)); // beyond it the reduction is what counts
}

TEST(WholeAbove, isTheSmallestIntegerThatIsNotLess)
{
    EXPECT_EQ(wholeAbove(0.0f), 0.0f);
    EXPECT_EQ(wholeAbove(2.0f), 2.0f);
    EXPECT_EQ(wholeAbove(2.0000002f), 3.0f);
    EXPECT_EQ(wholeAbove(63.5), 64.0);
}

} // namespace
} // namespace fx::render::integral
