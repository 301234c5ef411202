#include "simulation/sph/wendland.h"

#include <gtest/gtest.h>

#include <cmath>

using fx::sim::Wendland;

namespace {

constexpr double kPi = 3.14159265358979;

/// Integral over space of a radial function, by the midpoint rule over the support.
template <class F>
double integrate(double h, F&& f)
{
    const int steps = 20000;
    const double dr = 2.0 * h / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double r = (i + 0.5) * dr;
        sum += f(r) * 4.0 * kPi * r * r * dr;
    }
    return sum;
}

} // namespace

TEST(Wendland, integratesToOneForEverySize)
{
    for (const float h : {0.01f, 0.3f, 1.0f, 40.0f}) {
        const Wendland kernel(h);
        EXPECT_NEAR(integrate(double(h), [&](double r) { return double(kernel.value(float(r))); }), 1.0, 1e-5)
            << h;
    }
}

TEST(Wendland, gradientIsTheDerivativeOverTheDistance)
{
    const Wendland kernel(0.7f);
    for (float r = 0.05f; r < 1.38f; r += 0.01f) {
        const double step = 1e-3;
        const double slope =
            (double(kernel.value(r + float(step))) - double(kernel.value(r - float(step)))) / (2 * step);
        ASSERT_NEAR(double(kernel.gradient(r)) * double(r), slope, 5e-3) << r;
    }
}

TEST(Wendland, radialDerivativeIntegratesByPartsToMinusThree)
{
    // The integral of x . grad W over space is -3 times that of W.
    const Wendland kernel(0.9f);
    EXPECT_NEAR(integrate(0.9, [&](double r) { return double(kernel.gradient(float(r))) * r * r; }), -3.0,
                1e-4);
}

TEST(Wendland, endsAtTwiceTheSmoothingLength)
{
    const Wendland kernel(0.5f);
    EXPECT_EQ(kernel.value(1.0f), 0.0f);
    EXPECT_EQ(kernel.gradient(1.0f), 0.0f);
    EXPECT_EQ(kernel.value(7.0f), 0.0f);
    EXPECT_GT(kernel.value(0.99f), 0.0f);
}

TEST(Wendland, fallsFromItsKnownCenter)
{
    const Wendland kernel(2.0f);
    EXPECT_NEAR(double(kernel.value(0.0f)), 21.0 / (16.0 * kPi * 8.0), 1e-7);
    for (float r = 0.0f; r < 4.0f; r += 0.1f)
        ASSERT_LE(kernel.value(r + 0.1f), kernel.value(r));
}

TEST(Wendland, itsFourierTransformIsPositive)
{
    // What makes particles pair is a negative wave number; sin(kr)/(kr) is the transform of a shell.
    const Wendland kernel(1.0f);
    for (double k = 0.5; k < 30.0; k += 0.5)
        EXPECT_GT(
            integrate(1.0,
                      [&](double r) { return double(kernel.value(float(r))) * std::sin(k * r) / (k * r); }),
            -1e-6)
            << k;
}
