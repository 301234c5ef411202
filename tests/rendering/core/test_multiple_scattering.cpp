// Light scattered many times by a closed form: exact limits, and the energy of slabs.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

constexpr double kPi = std::numbers::pi;

/// Calls `visit(albedo, g, cosine, tauLight, tauColumn)` over the whole range of the formula.
template <class Visit>
void forEachCase(const Visit& visit)
{
    for (const float albedo : {0.0f, 1e-6f, 0.01f, 0.3f, 0.6f, 0.9f, 0.99f, 0.999999f, 1.0f})
        for (const float g : {-0.5f, 0.0f, 0.01f, 0.4f, 0.7f, 0.9f})
            for (const float cosine : {-1.0f, 0.0f, 0.8f, 1.0f})
                for (const float column :
                     {0.0f, 1e-6f, 1e-3f, 0.03f, 0.3f, 1.0f, 2.5f, 7.0f, 20.0f, 1e2f, 1e4f})
                    for (const float share : {0.0f, 0.1f, 0.4f, 0.8f, 1.0f})
                        visit(albedo, g, cosine, share * column, column);
}

/// Light that leaves a slab of depth `tau` and albedo 1 on both sides, as a share of the light that comes in.
double escaping(double g, double tau)
{
    const int layers = 200, directions = 48;
    double sum = std::exp(-tau);
    for (int i = 0; i < layers; ++i)
        for (int j = 0; j < directions; ++j) {
            const double t = tau * (i + 0.5) / layers;
            const double mu = (j + 0.5) / directions;
            const double part = 2.0 * kPi * tau / (layers * directions);
            sum += part * fx::formula64::fxScatteredLight(1.0, g, mu, t, tau) * std::exp(-(tau - t) / mu);
            sum += part * fx::formula64::fxScatteredLight(1.0, g, -mu, t, tau) * std::exp(-t / mu);
        }
    return sum;
}

} // namespace

TEST(MultipleScattering, aBlackMediumScattersNothing)
{
    EXPECT_EQ(fx::formula::fxMultipleScattering(0.0f, 0.7f, 1.0f, 1.0f, 3.0f), 0.0f);
    EXPECT_EQ(fx::formula::fxScatteredLight(0.0f, 0.7f, 1.0f, 1.0f, 3.0f), 0.0f);
}

TEST(MultipleScattering, aNearlyBlackOneScattersOnce)
{
    const double albedo = 1e-4;
    for (const double g : {0.0, 0.5, 0.9}) {
        const double once = albedo * fx::formula64::fxHenyeyGreenstein(0.3, g) * std::exp(-1.0);
        EXPECT_NEAR(fx::formula64::fxScatteredLight(albedo, g, 0.3, 1.0, 3.0) / once, 1.0, 1e-3);
    }
}

TEST(MultipleScattering, aThinMediumScattersOnce)
{
    for (const double g : {-0.5, 0.0, 0.5, 0.9}) {
        const double once = fx::formula64::fxHenyeyGreenstein(-0.4, g);
        EXPECT_NEAR(fx::formula64::fxScatteredLight(1.0, g, -0.4, 0.0, 0.0), once, 1e-12);
        EXPECT_NEAR(fx::formula64::fxMultipleScattering(1.0, g, -0.4, 5e-5, 1e-4) / once, 0.0, 1e-3);
    }
}

TEST(MultipleScattering, isFiniteAndNotNegativeAndTheSameInFloat)
{
    forEachCase([](float albedo, float g, float cosine, float tau, float column) {
        const double exact = fx::formula64::fxMultipleScattering(albedo, g, cosine, tau, column);
        const float value = fx::formula::fxMultipleScattering(albedo, g, cosine, tau, column);
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0f)
            << albedo << ' ' << g << ' ' << cosine << ' ' << tau << ' ' << column;
        ASSERT_NEAR(value, exact, 1e-4 * exact + 2e-5)
            << albedo << ' ' << g << ' ' << cosine << ' ' << tau << ' ' << column;
    });
}

TEST(MultipleScattering, aColumnShorterThanTheWayToTheLightEndsAtThePoint)
{
    EXPECT_EQ(fx::formula64::fxMultipleScattering(0.9, 0.3, 0.5, 2.0, 1.0),
              fx::formula64::fxMultipleScattering(0.9, 0.3, 0.5, 2.0, 2.0));
}

TEST(MultipleScattering, isTheSolutionOfTheDiffusionEquation)
{
    // with g = 0, cosine = 0, albedo 1: phi'' = k^2 phi - 3 exp(-x), by differences along the line
    const double column = 6.0, step = 1e-3, c1 = 2.70, c2 = 1.45;
    const auto phi = [&](double x) { return fx::formula64::fxMultipleScattering(1.0, 0.0, 0.0, x, column); };
    const double k = c1 / (column + c2);
    const double unit = 0.77 / (4.0 * kPi);
    for (const double x : {0.5, 2.0, 4.0}) {
        const double bend = (phi(x + step) - 2.0 * phi(x) + phi(x - step)) / (step * step);
        EXPECT_NEAR(bend, k * k * phi(x) - 3.0 * unit * std::exp(-x), 1e-6);
    }
}

TEST(MultipleScattering, slabsSendOutNoMoreLightThanComesIn)
{
    for (const double g : {0.0, 0.4, 0.7, 0.9})
        for (const double tau : {0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 40.0}) {
            EXPECT_LE(escaping(g, tau), 1.0 + 1e-3) << g << ' ' << tau;
            EXPECT_GE(escaping(g, tau), 0.25) << g << ' ' << tau;
        }
}

TEST(MultipleScattering, theSideOfTheLightIsBrighter)
{
    for (const double g : {0.0, 0.7})
        for (const double depth : {3.0, 10.0, 100.0}) { // of similarity
            const double column = depth / (1.0 - g);
            EXPECT_GT(fx::formula64::fxMultipleScattering(0.99, g, 0.0, 0.2 * column, column),
                      2.0 * fx::formula64::fxMultipleScattering(0.99, g, 0.0, 0.9 * column, column));
        }
}
