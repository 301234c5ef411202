// Balls that are drawn wider than they are cover as much as before.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

constexpr double kPi = std::numbers::pi;

/// [m2] integral over the disc of a ball of its opacity, by midpoints of kernel-optical-depth.
double coveredArea(double section, double radius)
{
    const int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double share = (i + 0.5) / steps; // of the disc's area
        const double depth = fx::formula64::fxKernelOpticalDepth(section, radius, radius * std::sqrt(share),
                                                                 0.0, -radius, radius);
        sum -= std::expm1(-depth);
    }
    return kPi * radius * radius * sum / steps;
}

} // namespace

TEST(WidenedBall, coversAsMuchAsBeforeWhateverItsDepth)
{
    for (const double section : {1e-6, 1e-3, 0.1, 1.0, 5.0, 30.0, 1e3})
        for (const double wide : {1.001, 1.1, 1.5, 3.0, 10.0, 1e3}) {
            const double area = coveredArea(section, 1.0);
            const double widened = coveredArea(fx::formula64::fxWidenedSection(section, 1.0, wide), wide);
            EXPECT_NEAR(widened / area, 1.0, 0.11) << section << " " << wide;
            // an opaque ball whose cross section is kept covers several times its disc
            if (section >= 5.0 && wide >= 3.0) {
                EXPECT_GT(coveredArea(section, wide) / area, 1.8) << section << " " << wide;
            }
        }
}

TEST(WidenedBall, keepsTheCrossSectionOfThinBallsAndOfThoseThatAreNotWidened)
{
    for (const float wide : {1.0f, 2.0f, 100.0f, 1e4f})
        EXPECT_NEAR(fx::formula::fxWidenedSection(1e-5f, 1.0f, wide), 1e-5f, 1e-10f) << wide;
    for (const float section : {1e-6f, 1.0f, 50.0f}) {
        EXPECT_EQ(fx::formula::fxWidenedSection(section, 1.0f, 1.0f), section);
        EXPECT_EQ(fx::formula::fxWidenedSection(section, 1.0f, 0.5f), section);
        EXPECT_NEAR(fx::formula::fxWidenedSection(section, 1.0f, 1.00001f) / section, 1.0f, 1e-3f) << section;
    }
}

TEST(WidenedBall, isFiniteForAnyBall)
{
    for (const float section : {0.0f, 1e-30f, 1.0f, 1e30f})
        for (const float radius : {1e-30f, 1e-6f, 1.0f, 1e6f}) {
            const float widened = fx::formula::fxWidenedSection(section, radius, 2e6f);
            EXPECT_TRUE(std::isfinite(widened)) << section << " " << radius;
            EXPECT_GE(widened, 0.0f);
        }
}

TEST(WidenedBall, inFloatIsThatInDouble)
{
    for (const float section : {1e-4f, 0.3f, 4.0f, 60.0f})
        for (const float wide : {1.01f, 2.0f, 50.0f}) {
            const double exact = fx::formula64::fxWidenedSection(double(section), 1.0, double(wide));
            EXPECT_NEAR(double(fx::formula::fxWidenedSection(section, 1.0f, wide)) / exact, 1.0, 5e-6);
        }
}
