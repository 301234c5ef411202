// Soil and the outline of hills: the lattice is exact, the mean is that of the mesh, slopes are derivatives.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace {

using namespace fx;

constexpr int kPeriod = 289;

/// Equation (2) written from the comment.
double noiseOf(double x, double z)
{
    const auto ease = [](double u) { return 3.0 * u * u - 2.0 * u * u * u; };
    const int i = int(std::floor(x)), j = int(std::floor(z));
    const auto value = [](int a, int b) {
        const auto permuted = [](int q) { return (34 * q + 1) * q % kPeriod; };
        const auto wrapped = [](int q) { return (q % kPeriod + kPeriod) % kPeriod; };
        return permuted((permuted(wrapped(a)) + wrapped(b)) % kPeriod) / 288.0 - 0.5;
    };
    const double t = ease(x - i), r = ease(z - j);
    return std::lerp(std::lerp(value(i, j), value(i + 1, j), t),
                     std::lerp(value(i, j + 1), value(i + 1, j + 1), t), r);
}

} // namespace

TEST(SoilTexture, aRowOfTheLatticeHasEachValueOnce)
{
    for (const int row : {-700, -1, 0, 5, 288, 100000}) {
        std::set<float> values;
        double sum = 0.0;
        for (int j = -40; j < kPeriod - 40; ++j) {
            values.insert(formula::fxSoilValue(float(row), float(j)));
            sum += formula64::fxSoilValue(row, j);
        }
        EXPECT_EQ(values.size(), size_t(kPeriod)) << row;
        EXPECT_NEAR(sum, 0.0, 1e-10) << row;
    }
}

TEST(SoilTexture, floatsNameTheCornersExactly)
{
    for (int i = -1000; i < 1000; i += 7)
        for (int j = -90000; j < 90000; j += 9001)
            ASSERT_EQ(std::lround((formula::fxSoilValue(float(i), float(j)) + 0.5f) * 288.0f),
                      std::lround((formula64::fxSoilValue(i, j) + 0.5) * 288.0))
                << i << ' ' << j;
}

TEST(SoilTexture, noiseIsThatOfTheEquations)
{
    for (double x = -9.7; x < 9.0; x += 0.37)
        for (double z = -5.3; z < 5.0; z += 0.41)
            ASSERT_NEAR(formula64::fxSoilNoise(x, z), noiseOf(x, z), 1e-12) << x << ' ' << z;
}

TEST(SoilTexture, slopesAreTheDerivativesOfTheNoise)
{
    constexpr double kStep = 1e-6;
    for (double x = -3.3; x < 3.0; x += 0.21)
        for (double z = -3.1; z < 3.0; z += 0.23) {
            const double dx = noiseOf(x + kStep, z) - noiseOf(x - kStep, z);
            const double dz = noiseOf(x, z + kStep) - noiseOf(x, z - kStep);
            ASSERT_NEAR(formula64::fxSoilSlopeX(x, z), dx / (2.0 * kStep), 1e-6);
            ASSERT_NEAR(formula64::fxSoilSlopeZ(x, z), dz / (2.0 * kStep), 1e-6);
        }
}

TEST(HillLine, theHorizonHasNoSeamAndStaysAboveTheGround)
{
    const auto at = [](double turn, double p) {
        const double angle = 2.0 * std::numbers::pi * turn;
        const double x = std::cos(angle), z = std::sin(angle);
        return std::array{formula64::fxFarHills(x, z, p), formula64::fxNearTrees(x, z, p)};
    };
    for (const double p : {0.0, 1e-3, 4e-3}) {
        for (int i = 0; i < 20000; ++i) {
            const auto [far, near] = at(i / 20000.0, p);
            const auto next = at((i + 1) / 20000.0, p);
            ASSERT_NEAR(far, next[0], 1e-3) << i;
            ASSERT_NEAR(near, next[1], 1e-3) << i;
            ASSERT_GT(far, 0.0);
            ASSERT_GT(near, -0.004);
            ASSERT_LT(std::max(far, near), 0.03);
        }
    }
}

TEST(HillLine, aWiderPixelSeesASmootherOutline)
{
    const auto roughness = [](double p) {
        double sum = 0.0;
        for (int i = 0; i < 20000; ++i) {
            const auto at = [&](int n) {
                const double angle = 2.0 * std::numbers::pi * n / 20000.0;
                return formula64::fxNearTrees(std::cos(angle), std::sin(angle), p);
            };
            sum += std::abs(at(i + 1) - at(i));
        }
        return sum;
    };
    EXPECT_LT(roughness(3e-3), 0.6 * roughness(0.0));
    EXPECT_LT(roughness(0.02), 0.3 * roughness(3e-3));
}

TEST(HillLine, theShareOfAPixelBelowALevelOutlineIsItsArea)
{
    EXPECT_EQ(formula64::fxShareBelow(1.0, 1.0, 0.1), 0.5);
    EXPECT_NEAR(formula64::fxShareBelow(1.02, 1.0, 0.1), 0.7, 1e-12);
    EXPECT_EQ(formula64::fxShareBelow(1.0, 2.0, 0.1), 0.0);
    EXPECT_EQ(formula64::fxShareBelow(1.0, 0.5, 0.0), 1.0);
}
