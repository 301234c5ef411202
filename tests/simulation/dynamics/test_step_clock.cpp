#include "simulation/sph/dynamics/step_clock.h"
#include "simulation/sph/dynamics/step_criteria.h"

#include <gtest/gtest.h>

using namespace fx::sim;

TEST(StepClock, aLevelIsThePowerOfTwoBelow)
{
    EXPECT_EQ(stepLevel(0.0), 0u);
    EXPECT_EQ(stepLevel(1.99), 0u);
    EXPECT_EQ(stepLevel(2.0), 1u);
    EXPECT_EQ(stepLevel(1023.9), 9u);
    EXPECT_EQ(stepLevel(1e30), kFrameLevel);
    EXPECT_EQ(stepLevel(1e30, 200), 99u);
}

TEST(StepClock, stepsGrowOnlyWhereTheLongerStepBegins)
{
    EXPECT_EQ(alignedLevel(10, 0), 10u);
    EXPECT_EQ(alignedLevel(10, 1024 * 7), 10u);
    EXPECT_EQ(alignedLevel(10, 512 * 7), 9u);
    EXPECT_EQ(alignedLevel(10, 3), 0u);
}

TEST(StepClock, theMiddleOfAStepIsExact)
{
    EXPECT_EQ(ticksSinceMiddle(10, 0, 10), 5.0);
    EXPECT_EQ(ticksSinceMiddle(0, 0, 11), -5.5);
    EXPECT_EQ(ticksSinceMiddle(kFrameTicks, kFrameTicks - 1, kFrameTicks), 0.5);
}

constexpr StepLimits<double> kLimits{0.2, 0.025};

TEST(StepCriteria, theShortestOfFourDecides)
{
    EXPECT_DOUBLE_EQ(longestStep(kLimits, StepMotion<double>{2.0, 10.0, 0.0, 1.0, 0.0, 0.0}), 0.04);
    EXPECT_DOUBLE_EQ(longestStep(kLimits, StepMotion<double>{2.0, 0.0, 1e4, 1.0, 0.0, 0.0}), 0.025);
    EXPECT_DOUBLE_EQ(longestStep(kLimits, StepMotion<double>{2.0, 0.0, 0.0, 1.0, -5.0, 0.0}), 0.05);
    EXPECT_DOUBLE_EQ(longestStep(kLimits, StepMotion<double>{2.0, 0.0, 0.0, 1.0, 5.0, 0.0}), 1e30);
    EXPECT_DOUBLE_EQ(longestStep(kLimits, StepMotion<double>{2.0, 0.0, 0.0, 1.0, 0.0, -2.5}), 0.01);
    EXPECT_DOUBLE_EQ(longestStep(kLimits, StepMotion<double>{2.0, 10.0, 1e4, 1.0, -5.0, 1.0}), 0.025);
}
