/// @file quadrature.h
/// Nodes and weights of quadrature rules in the precision of T.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

namespace fx::render::integral {

/// The positive nodes of a Gauss-Legendre rule on [-1, 1], which is symmetric. The outermost node comes
/// first.
template <class T>
struct GaussRule
{
    static constexpr uint32_t kPairs = 4;
    static constexpr uint32_t kPowers = 17;
    std::array<T, kPairs> node{};
    /// weight times node^k
    std::array<std::array<T, kPowers>, kPairs> weight{};
    T centerWeight{}; ///< weight of the node 0; 0 for an even number of nodes
};

/// @formula gauss-legendre
/// Nodes and weights of the rule that integrates polynomials up to degree 2 n - 1 exactly.
///
/// symbol   unit   meaning
///   n       1      number of nodes
///   P_n     1      Legendre polynomial
///   x, w    1      node and weight on [-1, 1]
/// @derivation
///   (k + 1) P_{k+1} = (2 k + 1) x P_k - k P_{k-1}, P_0 = 1, P_1 = x                 (1)
///   (x^2 - 1) P_n' = n (x P_n - P_{n-1})                                            (2)
///   nodes are the zeros of P_n; Newton's method starts at cos(pi (i + 3/4)/(n + 1/2))       (3)
///   w = 2 / ((1 - x^2) P_n'^2)                                                      (4)
/// @source    [AS64] 8.5.3, 8.5.4 and 25.4.29
/// @deviation none
/// @valid     n <= 64
/// @accuracy  one rounding to T; checked with all polynomials up to degree 2 n - 1
/// @tests     tests/rendering/reference/integral/test_quadrature.cpp
template <class W>
std::pair<W, W> gaussNode(uint32_t n, uint32_t i)
{
    W x = static_cast<W>(std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5))); // (3)
    W slope = W(0);
    for (int iteration = 0; iteration < 12; ++iteration)
    { // quadratic convergence: from 1e-3 to 1e-34 in four iterations
        W before = W(1), value = x;
        for (uint32_t k = 1; k < n; ++k) {
            const W next = (W(2 * k + 1) * x * value - W(k) * before) / W(k + 1); // (1)
            before = value;
            value = next;
        }
        slope = W(n) * (x * value - before) / (x * x - W(1)); // (2)
        x = x - value / slope;
    }
    return {x, W(2) / ((W(1) - x * x) * slope * slope)}; // (4)
}

/// The type in which the quadrature constants for T are computed.
template <class T>
using Precise = std::conditional_t<(sizeof(T) < sizeof(long double)), long double, T>;

/// The Gauss-Legendre rule with `n` nodes.
/// @param n 3, 5 or 8
template <class T>
GaussRule<T> gaussRule(uint32_t n)
{
    GaussRule<T> rule;
    for (uint32_t i = 0; i < n / 2; ++i) {
        const auto [x, w] = gaussNode<Precise<T>>(n, i);
        rule.node[i] = static_cast<T>(x);
        auto power = w;
        for (uint32_t k = 0; k < GaussRule<T>::kPowers; ++k, power = power * x)
            rule.weight[i][k] = static_cast<T>(power);
    }
    if (n % 2 == 1)
        rule.centerWeight = static_cast<T>(gaussNode<Precise<T>>(n, n / 2).second);
    return rule;
}

/// The pieces + 1 nodes -cos(pi i / pieces) from -1 to 1. The nodes are denser at the ends, where optical
/// depth is least linear.
template <class T>
std::vector<T> pieceNodes(uint32_t pieces)
{
    std::vector<T> nodes(pieces + 1);
    for (uint32_t i = 0; i <= pieces; ++i)
        nodes[i] = static_cast<T>(-std::cos(std::numbers::pi_v<long double> * i / pieces));
    nodes[0] = T(-1);
    nodes[pieces] = T(1);
    return nodes;
}

} // namespace fx::render::integral
