#include "foundation/time/step_clock.h"

#include <gtest/gtest.h>

#include <limits>

using namespace fx::base;

namespace {

constexpr Ticks kStep = kTicksPerSecond / 60;
constexpr Ticks kLongest = kTicksPerSecond / 10;

/// Steps taken over `seconds` at `rate` frames a second.
int64_t stepsAt(double rate, double seconds)
{
    StepClock clock(kStep, kLongest);
    int64_t steps = 0;
    const int frames = int(rate * seconds + 0.5);
    for (int i = 0; i < frames; ++i)
        steps += clock.advance(1.0 / rate).steps;
    return steps;
}

} // namespace

TEST(StepClock, everyFrameRateTakesTheSameStepsInAnHour)
{
    for (const double rate : {24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 120.0, 144.0, 240.0})
        EXPECT_EQ(stepsAt(rate, 3600.0), 216000) << rate;
}

TEST(StepClock, framesThatAreNoWholeTicksLoseNothing)
{
    StepClock clock(kStep, kLongest);
    int64_t steps = 0;
    for (int i = 0; i < 7 * 11 * 60; ++i)
        steps += clock.advance(1.0 / 77.0).steps;
    EXPECT_EQ(steps, 3600);
}

TEST(StepClock, zeroChangesNothing)
{
    StepClock clock(kStep, kLongest);
    clock.advance(0.013);
    const Ticks before = clock.now();
    const StepPlan plan = clock.advance(0.0);
    EXPECT_EQ(plan.steps, 0u);
    EXPECT_FALSE(plan.refused);
    EXPECT_EQ(clock.now(), before);
}

TEST(StepClock, negativeAndNonFiniteTimesAreRefused)
{
    const double bad[] = {-1.0, -1e-300, std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    StepClock clock(kStep, kLongest);
    clock.advance(0.02);
    const Ticks before = clock.now();
    for (const double dt : bad) {
        const StepPlan plan = clock.advance(dt);
        EXPECT_TRUE(plan.refused) << dt;
        EXPECT_EQ(plan.steps, 0u) << dt;
    }
    EXPECT_EQ(clock.now(), before);
}

TEST(StepClock, aLongFrameIsClampedAndWhatIsDroppedIsReported)
{
    StepClock clock(kStep, kLongest);
    const StepPlan plan = clock.advance(1.0);
    EXPECT_EQ(plan.steps, 6u);
    EXPECT_NEAR(double(plan.droppedTicks), 0.9 * double(kTicksPerSecond), 2.0);
    EXPECT_EQ(clock.advance(1e30).steps, 6u);
    EXPECT_EQ(clock.advance(std::numeric_limits<double>::max()).steps, 6u);
}

TEST(StepClock, tinyFramesAddUp)
{
    StepClock clock(kStep, kLongest);
    for (int i = 0; i < 100000; ++i)
        clock.advance(1e-10); // a fourteenth of a tick
    EXPECT_NEAR(double(clock.now()), 1e-5 * double(kTicksPerSecond), 2.0);
}

TEST(StepClock, interpolationIsThePartOfTheNextStep)
{
    StepClock clock(kStep, kLongest);
    EXPECT_EQ(clock.advance(1.5 / 60.0).steps, 1u);
    EXPECT_NEAR(clock.interpolation(), 0.5, 1e-6);
    EXPECT_EQ(clock.simulated(), kStep);
}
