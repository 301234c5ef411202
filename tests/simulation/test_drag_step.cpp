#include "simulation/motion/drag_step.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

namespace {
double relative(double got, double want)
{
    return std::abs(got - want) / std::abs(want);
}
} // namespace

TEST(DragStep, withoutDragIsFreeFlightExactly)
{
    const DragStep step = makeDragStep(0.0, 0.5);
    EXPECT_EQ(step.decay, 1.0f);
    EXPECT_EQ(step.share, 0.0f);
    EXPECT_EQ(step.gain, 0.5f);
    EXPECT_EQ(step.drift, 0.0f);
    EXPECT_EQ(step.ramp, 0.125f);
}

TEST(DragStep, agreesWithTheExactSolutionForEveryStiffness)
{
    const double t = 1.0 / 60.0;
    for (double z = 1e-8; z < 1e8; z *= 1.7) {
        const double k = std::min(z / t, 1e6);
        const long double kt = (long double)k * t;
        const long double gain = -std::expm1(-kt) / k;
        // t - gain cancels for small kt, where its series is the reference.
        const long double ramp = kt < 1e-4L ? t * t * (0.5L - kt / 6 + kt * kt / 24) : (t - gain) / k;
        const DragStep step = makeDragStep(z / t, t);
        ASSERT_LE(relative(double(step.gain), double(gain)), 3e-7) << z;
        ASSERT_LE(relative(double(step.ramp), double(ramp)), 3e-7) << z;
        ASSERT_NEAR(double(step.decay), double(std::exp(-kt)), 6e-8) << z;
        ASSERT_NEAR(double(step.decay) + double(step.share), 1.0, 2e-7) << z;
    }
}

TEST(DragStep, twoHalvesAreOneWhole)
{
    const double k = 7.0;
    const DragStep whole = makeDragStep(k, 0.2);
    const DragStep half = makeDragStep(k, 0.1);
    EXPECT_NEAR(half.decay * half.decay, whole.decay, 1e-7);
    EXPECT_NEAR(half.decay * half.gain + half.gain, whole.gain, 1e-7);
    EXPECT_NEAR(half.ramp * 2.0f + half.gain * half.gain, whole.ramp, 1e-7);
}

TEST(DragStep, negativeDragIsNone)
{
    EXPECT_EQ(makeDragStep(-3.0, 0.1).decay, 1.0f);
    EXPECT_EQ(makeDragStep(std::nan(""), 0.1).gain, 0.1f);
}
