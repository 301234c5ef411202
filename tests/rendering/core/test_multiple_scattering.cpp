// Light scattered many times by a closed form: exact limits, and the energy of slabs.
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

/// The fitted constants of multiple-scattering.
struct Fitted
{
    double c1 = 3.67, c2 = 2.15, m = 0.704, n = 0.960, u = 1.44, w = 0.683;
};

/// Diffuse light along a line by finite differences: equations (3) to (5) of multiple-scattering, and its
/// ends.
class DiffuseLine
{
public:
    DiffuseLine(double albedo, double g, double tauColumn)
    {
        const double s = 1.0 - albedo * g, f = std::pow(g, 1.5);
        depth_ = s * tauColumn;
        beam_ = (1.0 - albedo * f) / s;
        turned_ = albedo * (g - f) / s;
        const double source = albedo * (1.0 - f) / s;
        const double side = fitted_.c1 / (depth_ + fitted_.c2);
        const double k2 = 3.0 * (1.0 - albedo) / s + side * side;
        step_ = depth_ / kCells;
        // phi[i-1] - (2 + k2 step^2) phi[i] + phi[i+1] = right[i]; cells beyond the ends take part in the
        // ends' conditions
        std::vector<double> lower(kCells + 1, 1.0), middle(kCells + 1, -2.0 - k2 * step_ * step_),
            upper(kCells + 1, 1.0), right(kCells + 1);
        for (int i = 0; i <= kCells; ++i)
            right[size_t(i)] =
                -3.0 * (source + beam_ * turned_) * std::exp(-beam_ * i * step_) * step_ * step_;
        const double slope = 3.0 * step_ / fitted_.m; // phi[-1] = phi[1] - slope (phi + 2 m p exp) and so on
        upper[0] = lower[kCells] = 2.0;
        middle[0] -= slope;
        middle[kCells] -= slope;
        right[0] += slope * 2.0 * fitted_.m * turned_;
        right[kCells] -= slope * 2.0 * fitted_.m * turned_ * std::exp(-beam_ * depth_);
        for (size_t i = 1; i <= kCells; ++i) { // Thomas
            const double share = lower[i] / middle[i - 1];
            middle[i] -= share * upper[i - 1];
            right[i] -= share * right[i - 1];
        }
        phi_.resize(kCells + 1);
        phi_[kCells] = right[kCells] / middle[kCells];
        for (size_t i = kCells; i-- > 0;)
            phi_[i] = (right[i] - upper[i] * phi_[i + 1]) / middle[i];
    }
    /// At the cell `i`, not the first or last.
    double density(int i) const { return phi_[size_t(i)]; }
    double flux(int i) const
    {
        return (phi_[size_t(i - 1)] - phi_[size_t(i + 1)]) / (6.0 * step_) +
               turned_ * std::exp(-beam_ * i * step_);
    }
    static constexpr int kCells = 4000;

private:
    Fitted fitted_;
    double depth_, beam_, turned_, step_;
    std::vector<double> phi_;
};

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
        ASSERT_NEAR(value, exact, 1e-3 * exact + 2e-5)
            << albedo << ' ' << g << ' ' << cosine << ' ' << tau << ' ' << column;
    });
}

TEST(MultipleScattering, aColumnShorterThanTheWayToTheLightEndsAtThePoint)
{
    EXPECT_EQ(fx::formula64::fxMultipleScattering(0.9, 0.3, 0.5, 2.0, 1.0),
              fx::formula64::fxMultipleScattering(0.9, 0.3, 0.5, 2.0, 2.0));
}

TEST(MultipleScattering, isTheSolutionOfTheDiffusionEquationAndOfTheBeam)
{
    const Fitted fitted;
    for (const double albedo : {0.6, 0.95, 1.0})
        for (const double g : {0.0, 0.3, 0.7})
            for (const double column : {0.5, 4.0, 25.0}) {
                const DiffuseLine line(albedo, g, column);
                for (const int i : {1, 400, 2000, 3600, 3999}) {
                    const double tau = column * i / DiffuseLine::kCells;
                    const double along =
                        fitted.w * (std::exp(-(1.0 - albedo * std::pow(g, 1.5)) * tau) - std::exp(-tau));
                    for (const double cosine : {-0.3, 0.3}) {
                        const double diffuse = fitted.n * line.density(i) +
                                               3.0 * g * fitted.u * cosine * std::max(line.flux(i), 0.0);
                        const double beam = along * fx::formula64::fxHenyeyGreenstein(cosine, g * g);
                        const double want = albedo * (std::max(diffuse, 0.0) / (4.0 * kPi) + beam);
                        EXPECT_NEAR(fx::formula64::fxMultipleScattering(albedo, g, cosine, tau, column), want,
                                    1e-5 + 1e-4 * want)
                            << albedo << ' ' << g << ' ' << column << ' ' << i << ' ' << cosine;
                    }
                }
            }
}

TEST(MultipleScattering, isSmoothWhereTheBeamFallsAsTheDiffuseLight)
{
    const Fitted fitted;
    const double column = fitted.c1 - fitted.c2; // b = k = 1
    const auto light = [&](double tauColumn) {
        return fx::formula64::fxMultipleScattering(1.0, 0.0, 0.0, 0.5, tauColumn);
    };
    EXPECT_NEAR(light(column) / light(column - 0.01), 1.0, 0.01);
    EXPECT_NEAR(light(column) / light(column + 0.01), 1.0, 0.01);
    for (int i = -20; i <= 20; ++i) {
        const float close = float(column) + 1e-7f * float(i);
        EXPECT_NEAR(fx::formula::fxMultipleScattering(1.0f, 0.0f, 0.0f, 0.5f, close), light(double(close)),
                    5e-5);
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

TEST(DiffuseSky, betweenAWhiteSkyAndAWhiteGroundAWhiteMediumIsWhite)
{
    for (const float g : {0.0f, 0.4f, 0.9f})
        for (const float cosine : {-1.0f, 0.0f, 0.7f, 1.0f})
            for (const float up : {0.0f, 0.1f, 2.0f, 1e4f})
                for (const float down : {0.0f, 0.3f, 7.0f, 1e4f})
                    EXPECT_NEAR(fx::formula::fxDiffuseSky(1.0f, g, cosine, up, down) +
                                    fx::formula::fxDiffuseSky(1.0f, g, -cosine, down, up),
                                1.0f, 1e-6f);
}

TEST(DiffuseSky, anEmptyMediumSeesHalfTheSphere)
{
    EXPECT_NEAR(fx::formula64::fxDiffuseSky(1.0, 0.0, 0.3, 0.0, 0.0), 0.5, 1e-12);
    // the share of Henyey and Greenstein's function that stays in its half of all directions, by quadrature
    for (const double g : {0.2, 0.5, 0.7, 0.9}) {
        const int steps = 20000;
        double share = 0.0;
        for (int i = 0; i < steps; ++i)
            share += fx::formula64::fxHenyeyGreenstein((i + 0.5) / steps, g) * 2.0 * kPi / steps;
        EXPECT_NEAR(fx::formula64::fxDiffuseSky(1.0, g, 1.0, 0.0, 0.0), share, 0.01) << g;
        EXPECT_NEAR(fx::formula64::fxDiffuseSky(1.0, g, -1.0, 0.0, 0.0), 1.0 - share, 0.01) << g;
    }
}

TEST(DiffuseSky, isBetweenBlackAndWhiteAndTheSameInFloat)
{
    forEachCase([](float albedo, float g, float cosine, float up, float column) {
        const float value = fx::formula::fxDiffuseSky(albedo, g, cosine, up, column - up);
        ASSERT_TRUE(value >= 0.0f && value <= 1.0f + 1e-6f);
        ASSERT_NEAR(value, fx::formula64::fxDiffuseSky(albedo, g, cosine, up, column - up), 1e-5)
            << albedo << ' ' << g << ' ' << cosine << ' ' << up << ' ' << column;
    });
}

TEST(DiffuseSky, isTheSolutionOfItsDiffusionEquation)
{
    const double c1 = 6.14, c2 = 2.80, m = 1.118; // fitted
    const double albedo = 0.9, step = 1e-4;
    for (const double g : {0.0, 0.5})
        for (const double column : {0.4, 5.0, 20.0}) {
            const double s = 1.0 - albedo * g, depth = s * column;
            const auto mean = [&](double x) {
                return 2.0 / albedo *
                       fx::formula64::fxDiffuseSky(albedo, g, 0.0, x / s, (depth - x) / s); // S + A
            };
            const double l2 = std::pow(c1 / (depth + c2), 2.0);
            const double x = 0.4 * depth;
            const double bend = (mean(x + step) - 2.0 * mean(x) + mean(x - step)) / (step * step);
            EXPECT_NEAR(bend, (3.0 * (1.0 - albedo) / s + l2) * mean(x) - l2, 1e-5);
            // S + A - m (S' + A') is 2 at the top, S + A + m (S' + A') is 0 at the bottom
            EXPECT_NEAR(mean(0.0) - m * (mean(step) - mean(0.0)) / step, 2.0, 1e-3);
            EXPECT_NEAR(mean(depth) + m * (mean(depth) - mean(depth - step)) / step, 0.0, 1e-3);
        }
}
