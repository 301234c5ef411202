#include "quad.h"
#include "rendering/reference/integral/quadrature.h"

#include <gtest/gtest.h>

namespace fx::render::integral {
namespace {

/// The rule's value for x^k on [-1, 1].
template <class T>
Quad integralOfPower(const GaussRule<T>& rule, uint32_t nodes, uint32_t k)
{
    Quad sum = k == 0 ? Quad(rule.centerWeight) : Quad(0);
    if (k % 2 == 0)
        for (uint32_t i = 0; i < nodes / 2; ++i)
            sum += Quad(2) * Quad(rule.weight[i][k]);
    return sum;
}

template <class T>
void expectExact(double tolerance)
{
    for (const uint32_t nodes : {3u, 5u, 8u}) {
        const GaussRule<T> rule = gaussRule<T>(nodes);
        for (uint32_t k = 0; k <= 2 * nodes - 1; ++k)
            EXPECT_NEAR(
                double(integralOfPower(rule, nodes, k) - (k % 2 == 0 ? Quad(2) / Quad(k + 1) : Quad(0))), 0.0,
                tolerance)
                << nodes << " nodes, x^" << k;
    }
}

TEST(GaussLegendre, integratesPolynomialsUpToTwiceItsNodesExactly)
{
    expectExact<float>(2e-7);
    expectExact<double>(4e-16);
    expectExact<Quad>(1e-32);
}

TEST(GaussLegendre, doesNotIntegrateTheNextPower)
{
    EXPECT_GT(std::fabs(double(integralOfPower(gaussRule<double>(3), 3, 6)) - 2.0 / 7.0), 1e-2);
    EXPECT_GT(std::fabs(double(integralOfPower(gaussRule<double>(5), 5, 10)) - 2.0 / 11.0), 1e-4);
}

TEST(PieceNodes, riseFromOneEndToTheOther)
{
    for (const uint32_t pieces : {2u, 5u, 64u}) {
        const std::vector<float> nodes = pieceNodes<float>(pieces);
        ASSERT_EQ(nodes.size(), pieces + 1);
        EXPECT_EQ(nodes.front(), -1.0f);
        EXPECT_EQ(nodes.back(), 1.0f);
        for (size_t i = 1; i < nodes.size(); ++i)
            EXPECT_LT(nodes[i - 1], nodes[i]);
    }
}

} // namespace
} // namespace fx::render::integral
