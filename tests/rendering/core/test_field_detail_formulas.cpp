// The formula texts of detail as C++, against what their comments say in double.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

double sat(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

} // namespace

TEST(FieldDetailFormulas, placeIsZeroAndOneAtTheTwoDepths)
{
    for (const double length : {0.1, 1.0, 7.0}) {
        EXPECT_NEAR(fx::formula64::fxDetailPlace(0.6 / length, length, 0.6, 40.0), 0.0, 1e-12);
        EXPECT_NEAR(fx::formula64::fxDetailPlace(40.0 / length, length, 0.6, 40.0), 1.0, 1e-12);
        EXPECT_NEAR(fx::formula::fxDetailPlace(float(5.0 / length), float(length), 0.6f, 40.0f),
                    std::log(5.0 / 0.6) / std::log(40.0 / 0.6), 1e-5);
    }
    EXPECT_EQ(fx::formula::fxDetailPlace(0.0f, 1.0f, 0.6f, 40.0f), -1000.0f);
}

TEST(FieldDetailFormulas, theMeanIsTheIntegralOfTheShareOverThresholds)
{
    for (const double w : {0.05, 0.25, 1.0})
        for (double s = -0.2; s < 2.2; s += 0.037) {
            double sum = 0;
            const int steps = 20000;
            for (int i = 0; i < steps; ++i)
                sum += fx::formula64::fxDetailShare(s, (i + 0.5) / steps, w) / steps;
            EXPECT_NEAR(fx::formula64::fxDetailMean(s, w), sum, 1e-4) << s << ' ' << w;
            EXPECT_NEAR(fx::formula::fxDetailMean(float(s), float(w)), sum, 1e-4);
        }
}

TEST(FieldDetailFormulas, theGainKeepsTheMeanUpToSixfold)
{
    for (double s = 0.01; s < 2.0; s += 0.01) {
        const double mean = fx::formula64::fxDetailMean(s, 0.25);
        EXPECT_NEAR(fx::formula64::fxDetailGain(s, 0.25) * mean, std::min(1.0, 6.0 * mean), 1e-9);
    }
    EXPECT_EQ(fx::formula::fxDetailGain(1.3f, 0.25f), 1.0f);
    EXPECT_EQ(fx::formula::fxDetailGain(-1.0f, 0.25f), 6.0f);
}

TEST(FieldDetailFormulas, theThresholdIsTheNormalDistribution)
{
    for (double z = -4.0; z <= 4.0; z += 0.1) {
        EXPECT_NEAR(fx::formula64::fxDetailThreshold(z), 0.5 * std::erfc(z / std::sqrt(2.0)), 0.0097);
        EXPECT_NEAR(fx::formula::fxDetailThreshold(float(z)) + fx::formula::fxDetailThreshold(float(-z)), 1.0,
                    1e-6);
    }
    EXPECT_TRUE(std::isfinite(fx::formula::fxDetailThreshold(1e30f)));
}

TEST(FieldDetailFormulas, creasesAreColderAndNothingChangesDeepInside)
{
    for (double h = 0.05; h < 1.0; h += 0.1)
        for (double z : {-3.0, -0.5, 0.0, 1.0, 2.0})
            for (double s = 0.0; s < 2.0; s += 0.1) {
                const double want =
                    1500.0 * (1.0 - 0.16 * (1.0 - sat(2.0 * (s - h))) +
                              0.09 * (1.0 - sat(2.0 * (s - 1.25))) * std::clamp(z, -1.5, 1.5));
                EXPECT_NEAR(fx::formula::fxDetailTemperature(1500.0f, float(s), float(h), 0.25f, float(z),
                                                             0.16f, 0.09f),
                            want, 1e-4 * want);
                if (s >= 1.75) {
                    EXPECT_NEAR(want, 1500.0, 1e-6);
                }
            }
}

TEST(FieldDetailFormulas, thinningIsCountedFromAQuarterOfTheWayBetweenTheTwoDepths)
{
    EXPECT_EQ(
        fx::formula::fxDetailThinning(std::pow(0.6f, 0.75f) * std::pow(40.0f, 0.25f) * 1.001f, 0.6f, 40.0f),
        0.0f);
    for (const double v : {0.1, 1.0, 5.0}) {
        const double q = std::pow(0.6, 0.75) * std::pow(40.0, 0.25) * std::exp(-v);
        EXPECT_NEAR(fx::formula64::fxDetailThinning(q, 0.6, 40.0), v, 1e-12);
        EXPECT_NEAR(fx::formula::fxDetailThinning(float(q), 0.6f, 40.0f), v, 1e-5 * v + 1e-6);
    }
    EXPECT_TRUE(std::isfinite(fx::formula::fxDetailThinning(0.0f, 0.6f, 40.0f)));
}

TEST(FieldDetailFormulas, aBallThatSwellsKeepsItsLumpsForASofteningOfOneAndLosesThemAbove)
{
    for (const double softening : {1.0, 1.5}) {
        double before = 0.25;
        for (double swollen = 1.0; swollen < 20.0; swollen *= 1.3)
        { // the depth of a lump falls by its square
            const double depth = std::pow(0.2, 0.75) * std::pow(18.0, 0.25) / (swollen * swollen);
            const double a = softening * fx::formula64::fxDetailThinning(depth, 0.2, 18.0);
            const double s = fx::formula64::fxDetailSoftPlace(
                fx::formula64::fxDetailPlace(depth, 1.0, 0.2, 18.0), a, 0.2, 18.0);
            if (softening == 1.0)
                EXPECT_NEAR(s, 0.25, 1e-12);
            else
                EXPECT_GE(s, before);
            before = s;
        }
        EXPECT_EQ(before > 0.8, softening > 1.0);
    }
}

TEST(FieldDetailFormulas, edgesAndNoiseSoftenByThinning)
{
    EXPECT_NEAR(fx::formula::fxDetailSoftRamp(0.2f, 0.0f), 0.2f, 1e-7f);
    EXPECT_NEAR(fx::formula::fxDetailSoftRamp(0.2f, 2.0f), 1.0 - 0.8 * std::exp(-0.5), 1e-6);
    EXPECT_LE(fx::formula::fxDetailSoftRamp(0.2f, 40.0f), 1.0f);
    EXPECT_NEAR(fx::formula::fxDetailSoftGain(0.5f, 2.0f), 0.5 * std::exp(-0.3), 1e-6);
}

TEST(FieldDetailFormulas, lumpsAreRoundWithCreases)
{
    EXPECT_EQ(fx::formula::fxLump(0.0f, 0.0f), 0.65f);
    EXPECT_EQ(fx::formula::fxLump(1.0f, 0.0f), 0.0f);
    EXPECT_FLOAT_EQ(fx::formula::fxLump(0.0f, -0.9f), 1.0f);
    EXPECT_NEAR(fx::formula::fxLump(0.5f, 0.25f), 0.65 * 0.5 + 0.35 * 0.4, 1e-6);
}

TEST(FieldDetailFormulas, octavesTurnAndShrinkByTheSameFactorInAllDirections)
{
    const auto next = [](double x, double y, double z, double* out) {
        out[0] = fx::formula64::fxNextOctaveX(x, z);
        out[1] = fx::formula64::fxNextOctaveY(x, y, z);
        out[2] = fx::formula64::fxNextOctaveZ(x, y, z);
    };
    double origin[3];
    next(0, 0, 0, origin);
    for (int axis = 0; axis < 3; ++axis) {
        double to[3];
        next(axis == 0, axis == 1, axis == 2, to);
        double square = 0;
        for (int a = 0; a < 3; ++a)
            square += (to[a] - origin[a]) * (to[a] - origin[a]);
        EXPECT_NEAR(std::sqrt(square), 2.03, 0.01);
    }
}

TEST(FieldDetailFormulas, anOctaveFadesOutEvenlyAsLumpsShrinkBelowAPixel)
{
    EXPECT_NEAR(fx::formula::fxOctaveBand(1e3f, 1.0f), 1.0f, 1e-5f);
    EXPECT_NEAR(fx::formula::fxOctaveBand(2.0f, 1.0f), 0.80f, 0.02f);
    EXPECT_NEAR(fx::formula::fxOctaveBand(1.0f, 1.0f), 0.49f, 0.02f);
    EXPECT_EQ(fx::formula::fxOctaveBand(0.28f, 1.0f), 0.0f);
    for (double size = 0.2; size < 20.0; size *= 1.05) {
        const double r = 1.0 / (size * size), c = 1.0 / (1.0 + 0.86 * r + 0.07 * r * r);
        EXPECT_NEAR(fx::formula::fxOctaveBand(float(3.0 * size), 3.0f), std::max(1.05 * c - 0.05, 0.0), 1e-5);
    }
}

TEST(FieldDetailFormulas, blendedGenerationsKeepTheirDeviation)
{
    EXPECT_EQ(fx::formula::fxBlendGenerations(2.0f, 7.0f, 0.0f), 2.0f);
    EXPECT_EQ(fx::formula::fxBlendGenerations(2.0f, 7.0f, 1.0f), 7.0f);
    for (double f = 0.0; f <= 1.0; f += 0.125) { // variance of the sum of two independent fields
        const double a = fx::formula64::fxBlendGenerations(1.0, 0.0, f);
        const double b = fx::formula64::fxBlendGenerations(0.0, 1.0, f);
        EXPECT_NEAR(a * a + b * b, 1.0, 1e-12);
    }
}
