// Acceleration of affine iterations.
#include "rendering/network/network_mixing.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::render;

namespace {

/// x -> 1 + r x in each element, at rest at 1 / (1 - r).
std::vector<float> step(const std::vector<float>& x, const std::vector<float>& rates)
{
    std::vector<float> out(x.size());
    for (size_t i = 0; i < x.size(); ++i)
        out[i] = 1.0f + rates[i] * x[i];
    return out;
}

float afterSteps(int steps, int depth, const std::vector<float>& rates)
{
    NetworkMixing mixing;
    const std::vector<float> weight(rates.size(), 1.0f);
    std::vector<float> x(rates.size(), 0.0f);
    for (int s = 0; s < steps; ++s) {
        if (mixing.isReady())
            mixing.mix(x);
        const std::vector<float> out = step(x, rates);
        mixing.remember(x, out, weight, depth);
        x = out;
    }
    float worst = 0.0f;
    for (size_t i = 0; i < x.size(); ++i)
        worst = std::max(worst, std::abs(x[i] * (1.0f - rates[i]) - 1.0f));
    return worst;
}

} // namespace

TEST(NetworkMixing, findsTheEndOfOneRateAtOnceAndOfTwoWithTwo)
{
    EXPECT_LT(afterSteps(3, 1, {0.99f, 0.99f}), 1e-4f);
    EXPECT_LT(afterSteps(4, 2, {0.99f, 0.5f}), 1e-3f);
    EXPECT_GT(afterSteps(4, 0, {0.99f, 0.5f}), 0.9f) << "without it";
}

TEST(NetworkMixing, ofStepsThatDoNotDifferDoesNothing)
{
    NetworkMixing mixing;
    const std::vector<float> weight(2, 1.0f), x{1.0f, 2.0f};
    for (int i = 0; i < 4; ++i)
        mixing.remember(x, x, weight, 4);
    ASSERT_TRUE(mixing.isReady());
    std::vector<float> mixed = x;
    mixing.mix(mixed);
    EXPECT_EQ(mixed, x);
}

TEST(NetworkMixing, weighsElementsOfEachPart)
{
    // elements of weight 0 do not count: the rate of the others is found at once
    NetworkMixing mixing;
    const std::vector<float> weight{1.0f, 0.0f}, rates{0.9f, 0.1f, 0.9f, 0.7f};
    std::vector<float> x(4, 0.0f);
    for (int s = 0; s < 3; ++s) {
        if (mixing.isReady())
            mixing.mix(x);
        const std::vector<float> out = step(x, rates);
        mixing.remember(x, out, weight, 1);
        x = out;
    }
    EXPECT_NEAR(x[0], 10.0f, 1e-2f);
    EXPECT_NEAR(x[2], 10.0f, 1e-2f);
}

TEST(NetworkMixing, knowsItsLastOutput)
{
    NetworkMixing mixing;
    const std::vector<float> a{1.0f}, b{2.0f}, weight{1.0f};
    EXPECT_FALSE(mixing.continues(a));
    mixing.remember(a, b, weight, 2);
    EXPECT_TRUE(mixing.continues(b));
    EXPECT_FALSE(mixing.continues(a));
    mixing.clear();
    EXPECT_FALSE(mixing.continues(b));
}
