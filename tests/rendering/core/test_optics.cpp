// Black body and phase function against published values and conservation.
#include "rendering/optics/black_body.h"
#include "rendering/optics/phase.h"
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using fx::render::blackBodyLuminance;
using fx::render::integrateBlackBody;

namespace {

double luminance(const glm::dvec3& rgb)
{
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

} // namespace

TEST(BlackBody, hasTheLuminanceOfPlancksLaw)
{
    // Independent integration with the same color matching fit, in a script: cd/m2 at T.
    EXPECT_NEAR(luminance(integrateBlackBody(1500.0)) / 7.8e3, 1.0, 0.02);
    EXPECT_NEAR(luminance(integrateBlackBody(2000.0)) / 4.7e5, 1.0, 0.02);
    EXPECT_NEAR(luminance(integrateBlackBody(3000.0)) / 3.0e7, 1.0, 0.02);
    EXPECT_NEAR(luminance(integrateBlackBody(6504.0)) / 3.1e9, 1.0, 0.02);
}

TEST(BlackBody, turnsFromRedToWhiteAsItHeats)
{
    const glm::vec3 warm = blackBodyLuminance(1500.0f);
    const glm::vec3 hot = blackBodyLuminance(4000.0f);
    EXPECT_GT(warm.x, 4.0f * warm.y);
    EXPECT_LT(hot.x, 2.0f * hot.y);
    EXPECT_GT(hot.z / hot.x, warm.z / warm.x);
}

TEST(BlackBody, isBrighterWhenHotterAndNeverNegative)
{
    double before = 0.0;
    for (float t = 500.0f; t < 12000.0f; t += 7.0f) {
        const glm::vec3 now = blackBodyLuminance(t);
        EXPECT_GE(std::min({now.x, now.y, now.z}), 0.0f) << t;
        EXPECT_GE(luminance(now), before) << t;
        before = luminance(now);
    }
}

TEST(BlackBody, tableAgreesWithTheIntegral)
{
    for (double t = 1000.0; t < 9000.0; t *= 1.013) {
        const glm::dvec3 exact = integrateBlackBody(t);
        const glm::vec3 table = blackBodyLuminance(float(t));
        EXPECT_NEAR(double(table.x) / exact.x, 1.0, 1e-3) << t;
        EXPECT_NEAR(double(table.y) / exact.y, 1.0, 1e-3) << t;
    }
}

TEST(BlackBody, coldAndInvalidTemperaturesAreDark)
{
    EXPECT_EQ(blackBodyLuminance(293.0f), glm::vec3(0.0f));
    EXPECT_EQ(blackBodyLuminance(-5.0f), glm::vec3(0.0f));
    EXPECT_EQ(blackBodyLuminance(std::nanf("")), glm::vec3(0.0f));
}

TEST(BlackBodyContrast, isTheSlopeOfTheLuminance)
{
    for (double t = 1000.0; t <= 3000.0; t += 100.0) {
        const double slope = (std::log(luminance(integrateBlackBody(t * 1.01))) -
                              std::log(luminance(integrateBlackBody(t / 1.01)))) /
                             (2.0 * std::log(1.01));
        EXPECT_NEAR(fx::formula64::fxBlackBodyContrast(t) / slope, 1.0, 0.08) << t;
    }
}

TEST(HenyeyGreenstein, isNormalisedAndHasItsMeanCosine)
{
    for (const float g : {-0.7f, 0.0f, 0.3f, 0.9f}) {
        double sum = 0.0;
        double mean = 0.0;
        const int steps = 200000;
        for (int i = 0; i < steps; ++i) {
            const double c = -1.0 + 2.0 * (i + 0.5) / steps;
            const double p =
                double(fx::render::henyeyGreenstein(float(c), g)) * 2.0 * std::numbers::pi * 2.0 / steps;
            sum += p;
            mean += p * c;
        }
        EXPECT_NEAR(sum, 1.0, 1e-5) << g;
        EXPECT_NEAR(mean, double(g), 1e-5) << g;
    }
}
