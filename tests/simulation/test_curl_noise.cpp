#include "simulation/motion/curl_noise.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace fx;
using namespace fx::sim;

namespace {

glm::vec3 randomPoint(int i, float extent)
{
    const auto u = base::randomUnit4(3, 0, uint64_t(i), base::RandomPurpose::Position);
    return extent * (2.0f * glm::vec3(u[0], u[1], u[2]) - 1.0f);
}

/// Derivative of each velocity component along its own axis, by central differences.
glm::dvec3 selfDerivatives(const CurlNoise& noise, const glm::vec3& p, float step)
{
    glm::dvec3 d;
    for (int a = 0; a < 3; ++a) {
        glm::vec3 offset(0.0f);
        offset[a] = step;
        d[a] = double(noise.velocity(p + offset)[a] - noise.velocity(p - offset)[a]) / (2.0 * double(step));
    }
    return d;
}

} // namespace

TEST(CurlNoise, hasNoDivergence)
{
    const CurlNoise noise(42, 1.0f, 1.0f, 0.3);
    double divergence = 0;
    double slope = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 d = selfDerivatives(noise, randomPoint(i, 4.0f), 1e-2f);
        divergence += std::pow(d.x + d.y + d.z, 2);
        slope += glm::dot(d, d);
    }
    EXPECT_LT(std::sqrt(divergence / slope), 2e-3); // what central differences of this step leave
    EXPECT_GT(slope, 1.0);                          // there is something to diverge
}

TEST(CurlNoise, itsRootMeanSquareSpeedIsTheStrength)
{
    for (const double turns : {0.0, 0.4}) {
        const CurlNoise noise(7, 3.0f, 0.5f, turns);
        double squares = 0;
        const int count = 20000;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 v(noise.velocity(randomPoint(i, 50.0f)));
            squares += glm::dot(v, v) / count;
        }
        EXPECT_NEAR(std::sqrt(squares), 3.0, 0.15) << turns;
    }
}

TEST(CurlNoise, hasNoMeanWind)
{
    const CurlNoise noise(7, 1.0f, 1.0f, 0.0);
    glm::dvec3 mean(0.0);
    for (int i = 0; i < 20000; ++i)
        mean += glm::dvec3(noise.velocity(randomPoint(i, 100.0f))) / 20000.0;
    EXPECT_LT(glm::length(mean), 0.03);
}

TEST(CurlNoise, isContinuousAcrossCellBorders)
{
    const CurlNoise noise(9, 1.0f, 1.0f, 0.1);
    for (int i = -3; i < 4; ++i) {
        const glm::vec3 below(float(i) - 1e-5f, 0.3f, -0.7f);
        const glm::vec3 above(float(i) + 1e-5f, 0.3f, -0.7f);
        EXPECT_LT(glm::length(noise.velocity(below) - noise.velocity(above)), 1e-3f) << i;
    }
}

TEST(CurlNoise, scaleStretchesSpaceAndNotSpeed)
{
    const CurlNoise one(5, 2.0f, 1.0f, 0.0);
    const CurlNoise four(5, 2.0f, 4.0f, 0.0);
    const glm::vec3 p(0.3f, 1.6f, -2.2f);
    EXPECT_EQ(one.velocity(p), four.velocity(4.0f * p));
}

TEST(CurlNoise, changesWithTimeAndReturnsAfterATurn)
{
    const glm::vec3 p(0.3f, 1.6f, -2.2f);
    const glm::vec3 now = CurlNoise(5, 1.0f, 1.0f, 0.0).velocity(p);
    EXPECT_GT(glm::length(now - CurlNoise(5, 1.0f, 1.0f, 0.25).velocity(p)), 0.01f);
    EXPECT_LT(glm::length(now - CurlNoise(5, 1.0f, 1.0f, 1e-4).velocity(p)), 0.01f);
    EXPECT_EQ(now, CurlNoise(5, 1.0f, 1.0f, 1.0).velocity(p));
    EXPECT_NE(now, CurlNoise(6, 1.0f, 1.0f, 0.0).velocity(p));
}

TEST(CurlNoise, isFiniteEverywhere)
{
    const CurlNoise noise(5, 1.0f, 1e-3f, 0.0);
    const float wild[] = {1e30f, -1e30f, std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::quiet_NaN()};
    for (const float x : wild)
        EXPECT_TRUE(std::isfinite(glm::length(noise.velocity({x, x, x})))) << x;
}

TEST(CurlNoise, withoutStrengthIsStill)
{
    const CurlNoise noise(5, 0.0f, 1.0f, 0.0);
    EXPECT_FALSE(noise.active());
    EXPECT_EQ(noise.velocity({1, 2, 3}), glm::vec3(0.0f));
}
