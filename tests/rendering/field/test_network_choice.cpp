// Which media have networks: the estimate of their optical depth against exact ones, and its invariances.
#include "foundation/random/philox.h"
#include "rendering/field/network_choice.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::render;

namespace {

/// An even ellipsoid of small balls. @param depth [1] optical depth along its axis x
MediumMoments ellipsoid(const glm::dvec3& axes, double depth, const glm::dvec3& albedo,
                        const glm::dvec3& middle = glm::dvec3(0.0))
{
    constexpr uint32_t kBalls = 40'000;
    const double extinction = depth / (2.0 * axes.x);
    const double crossSection =
        extinction * 4.0 / 3.0 * std::numbers::pi * axes.x * axes.y * axes.z / double(kBalls);
    MediumMoments moments;
    uint32_t there = 0;
    for (uint32_t i = 0; there < kBalls; ++i) {
        const auto bits = base::philox({i, 0, 0, 0}, 3);
        const glm::dvec3 p = 2.0 * glm::dvec3(base::toUnitFloat(bits[0]), base::toUnitFloat(bits[1]),
                                              base::toUnitFloat(bits[2])) -
                             1.0;
        if (glm::dot(p, p) > 1.0)
            continue;
        moments.add(middle + axes * p, 0.01, crossSection, albedo);
        ++there;
    }
    return moments;
}

constexpr double kPixel = 1e-3; // [m]: everything is large on the picture
const glm::dvec3 kWhite(0.9);

} // namespace

TEST(NetworkChoice, knowsTheMeanDepthAndTheAxesOfEvenEllipsoids)
{
    // A ball: cross section over pi r^2, that is 2/3 of the depth through its middle.
    const MediumMoments ball = ellipsoid(glm::dvec3(2.0), 6.0, kWhite, {100.0, -40.0, 7.0});
    EXPECT_NEAR(ball.opticalDepth(), 4.0, 0.04);
    for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(ball.semiAxes()[a], 2.0, 0.02);
    // A prolate spheroid: a quarter of its surface is its mean projected area (Cauchy).
    const MediumMoments tall = ellipsoid({1.0, 3.0, 1.0}, 6.0, kWhite);
    const double eccentricity = std::sqrt(1.0 - 1.0 / 9.0);
    const double area = 0.5 * std::numbers::pi * (1.0 + 3.0 / eccentricity * std::asin(eccentricity));
    EXPECT_NEAR(tall.opticalDepth() / (3.0 * 4.0 / 3.0 * std::numbers::pi * 3.0 / area), 1.0, 0.07);
    // One ball with the quartic kernel, whose depth through the middle is 3.5 C / (pi r^2).
    MediumMoments one;
    one.add({1.0, 2.0, 3.0}, 2.0, std::numbers::pi * 4.0, kWhite);
    EXPECT_NEAR(one.semiAxes().x, 2.0 * std::sqrt(5.0) / 3.0, 1e-12);
    EXPECT_NEAR(one.opticalDepth(), 9.0 / 5.0, 1e-12);
}

TEST(NetworkChoice, doesNotDependOnHowAMediumIsSplit)
{
    MediumMoments whole, first, second;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 center(std::sin(i), std::cos(2 * i), std::sin(3 * i));
        const glm::dvec3 albedo(0.2, 0.01 * i, 0.4);
        whole.add(center, 0.1, 0.5 + i, albedo);
        (i % 3 == 0 ? first : second).add(center, 0.1, 0.5 + i, albedo);
    }
    first.add(second);
    EXPECT_NEAR(first.opticalDepth(), whole.opticalDepth(), 1e-9 * whole.opticalDepth());
    EXPECT_NEAR(first.albedo(), whole.albedo(), 1e-12);
    EXPECT_NEAR(glm::length(first.semiAxes() - whole.semiAxes()), 0.0, 1e-9);
}

TEST(NetworkChoice, thinDarkAndSmallMediaHaveNone)
{
    const auto use = [](double depth, const glm::dvec3& albedo, double pixel = kPixel) {
        return networkUse(ellipsoid(glm::dvec3(1.0), depth, albedo), pixel);
    };
    EXPECT_EQ(use(5.0, kWhite), NetworkUse::Network);
    EXPECT_EQ(use(0.4, kWhite), NetworkUse::Thin);
    EXPECT_EQ(use(5.0, glm::dvec3(0.25)), NetworkUse::Dark);
    EXPECT_EQ(use(5.0, {0.1, 0.1, 0.8}), NetworkUse::Network) << "one color is enough";
    EXPECT_EQ(use(5.0, kWhite, 0.2), NetworkUse::Small) << "10 pixels";
    EXPECT_EQ(networkUse(MediumMoments(), kPixel), NetworkUse::Thin) << "none";
}

TEST(NetworkChoice, mediaThatHadANetworkKeepItBelowEachLimit)
{
    const auto use = [](double depth, double albedo, double pixel, bool had) {
        return networkUse(ellipsoid(glm::dvec3(1.0), 1.5 * depth, glm::dvec3(albedo)), pixel, had);
    };
    const double small = 2.0 / kLeastNetworkPixels; // pixel of a medium as large as the limit
    for (const double share : {0.9, 0.7}) {
        const bool isKept = share > kKeptNetworkShare;
        EXPECT_NE(use(share * kLeastNetworkDepth, 0.9, kPixel, false), NetworkUse::Network);
        EXPECT_EQ(use(share * kLeastNetworkDepth, 0.9, kPixel, true) == NetworkUse::Network, isKept);
        EXPECT_NE(use(5.0, share * kLeastNetworkAlbedo, kPixel, false), NetworkUse::Network);
        EXPECT_EQ(use(5.0, share * kLeastNetworkAlbedo, kPixel, true) == NetworkUse::Network, isKept);
        EXPECT_NE(use(5.0, 0.9, small / share, false), NetworkUse::Network);
        EXPECT_EQ(use(5.0, 0.9, small / share, true) == NetworkUse::Network, isKept);
    }
}
