// Directions, harmonics and the phase function in moments.
#include "rendering/network/network_basis.h"
#include "rendering/network/network_phase.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::render;

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

} // namespace

TEST(NeighborQuadrature, hasAsManyDirectionsAsItSays)
{
    for (const int count : {6, 14, 26}) {
        const auto all = neighborDirections(count);
        ASSERT_EQ(all.size(), size_t(count));
        for (size_t d = 0; d < all.size(); d += 2)
            EXPECT_EQ(all[d].step, -all[d + 1].step);
    }
}

TEST(NeighborQuadrature, integratesPolynomialsOfItsDegreeAndNotOfTheNextEvenOne)
{
    // integral of x^a y^b z^c over the sphere, 0 for odd powers, else by double factorials
    const auto exact = [](int a, int b, int c) {
        if (a % 2 || b % 2 || c % 2)
            return 0.0;
        const auto odd = [](int n) {
            double product = 1.0;
            for (; n > 1; n -= 2)
                product *= n;
            return product;
        };
        return kSphere * odd(a - 1) * odd(b - 1) * odd(c - 1) / odd(a + b + c + 1);
    };
    for (const auto& [count, degree] : {std::pair(6, 3), {14, 5}, {26, 7}}) {
        double worstBeyond = 0.0;
        for (int a = 0; a <= degree + 1; ++a)
            for (int b = 0; a + b <= degree + 1; ++b)
                for (int c = 0; a + b + c <= degree + 1; ++c) {
                    double sum = 0.0;
                    for (const NeighborDirection& d : neighborDirections(count)) {
                        const glm::dvec3 v = glm::normalize(glm::dvec3(d.step));
                        sum += d.weight * std::pow(v.x, a) * std::pow(v.y, b) * std::pow(v.z, c);
                    }
                    const double error = std::abs(sum - exact(a, b, c));
                    if (a + b + c <= degree) {
                        EXPECT_LT(error, 1e-12) << count << ": " << a << b << c;
                    } else {
                        worstBeyond = std::max(worstBeyond, error);
                    }
                }
        EXPECT_GT(worstBeyond, 1e-3) << count;
    }
}

TEST(NeighborQuadrature, leavesHarmonicsOrthonormal)
{
    for (const auto& [count, moments] : {std::pair(6, 4), {14, 9}, {26, 9}})
        for (int j = 0; j < moments; ++j)
            for (int k = 0; k < moments; ++k) {
                double sum = 0.0;
                for (const NeighborDirection& d : neighborDirections(count)) {
                    const auto y = harmonics(glm::normalize(glm::dvec3(d.step)));
                    sum += d.weight * y[size_t(j)] * y[size_t(k)];
                }
                EXPECT_NEAR(sum, j == k ? 1.0 : 0.0, 1e-12) << count << " " << j << k;
            }
}

TEST(NetworkPhase, isNowhereNegativeAndKeepsTheMeanCosine)
{
    for (const int moments : {4, 9})
        for (double g = -0.3; g <= 0.98; g += 0.01) {
            const NetworkPhase phase = networkPhase(g, moments);
            double sum = 0.0, cosine = 0.0, least = 1.0;
            constexpr int kSteps = 2000;
            for (int i = 0; i < kSteps; ++i) {
                const double c = -1.0 + (i + 0.5) * 2.0 / kSteps;
                const double p = phase.series(c) * kSphere / kSteps;
                sum += p;
                cosine += p * c;
                least = std::min(least, phase.series(c));
            }
            EXPECT_GE(std::min({least, phase.series(-1.0), phase.series(1.0)}), -1e-9) << moments << " " << g;
            EXPECT_NEAR(sum, 1.0, 1e-6);
            EXPECT_NEAR(phase.peak + (1.0 - phase.peak) * cosine, g, 1e-6) << moments << " " << g;
            EXPECT_NEAR((1.0 - phase.peak) * (1.0 - phase.factors[1]), 1.0 - g, 1e-12);
            EXPECT_GE(phase.peak, 0.0);
            EXPECT_LT(phase.peak, std::max(g, 1e-9));
        }
}

TEST(NetworkPhase, isThatOfDeltaMWhereThatIsPositive)
{
    for (const double g : {0.0, 0.2, 0.5})
        EXPECT_NEAR(networkPhase(g, 4).peak, g * g, 1e-12);
    for (const double g : {0.0, 0.4, 0.7})
        EXPECT_NEAR(networkPhase(g, 9).peak, g * g * g, 1e-3) << g;
    EXPECT_NEAR(networkPhase(0.7, 4).peak, 0.55, 1e-12) << "1.5 g - 0.5";
}

TEST(NetworkPhase, withTwoBandsHasTheSecondMomentToo)
{
    for (double g = 0.0; g < 0.92; g += 0.1) {
        const NetworkPhase phase = networkPhase(g, 9);
        EXPECT_NEAR(phase.peak + (1.0 - phase.peak) * phase.factors[2], g * g, 1e-12) << g;
    }
}

TEST(NetworkPhase, withAPeakIsAMediumOfTheSameAbsorption)
{
    const NetworkPhase phase = networkPhase(0.8, 4);
    for (const double albedo : {0.0, 0.5, 0.99, 1.0}) {
        const double share = phase.extinctionShare(albedo);
        EXPECT_NEAR(share * (1.0 - phase.albedo(albedo)), 1.0 - albedo, 1e-12);
        EXPECT_NEAR(share * phase.albedo(albedo), albedo * (1.0 - phase.peak), 1e-12);
    }
}
