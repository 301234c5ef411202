#include "simulation/sph/pair_loops/flow_gradient.h"

#include <gtest/gtest.h>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace {

using namespace fx::sim;

/// Moments of a neighborhood of shape M in a flow of gradient J (J[b][a] = d v_a / d x_b).
FlowGradient<double> gradientOf(const glm::dmat3& J, const glm::dmat3& M)
{
    const glm::dmat3 G = J * M;
    const double moments[6] = {M[0][0], M[1][0], M[2][0], M[1][1], M[2][1], M[2][2]};
    const double flows[9] = {G[0][0], G[1][0], G[2][0], G[0][1], G[1][1], G[2][1], G[0][2], G[1][2], G[2][2]};
    return flowGradient(moments, flows);
}

const glm::dmat3 kFlow(1, 2, 3, 4, 5, 6, 7, 8, 10);

TEST(FlowGradient, isExactForEveryShapeOfNeighborhood)
{
    for (const glm::dmat3& M : {glm::dmat3(1.0), glm::dmat3(2, 0.5, 0.1, 0.5, 1, -0.3, 0.1, -0.3, 1.5)}) {
        const FlowGradient<double> found = gradientOf(kFlow, M);
        EXPECT_NEAR(found.divergence, 16.0, 1e-12);
        // curl = (J_zy - J_yz, J_xz - J_zx, J_yx - J_xy) = (6 - 8, 7 - 3, 2 - 4)
        EXPECT_NEAR(found.curl, std::sqrt(4.0 + 16.0 + 4.0), 1e-12);
    }
}

TEST(FlowGradient, doesNotDependOnTheScaleOfMasses)
{
    const float moments[6] = {1e-28f, 0, 0, 1e-28f, 0, 1e-28f};
    const float flows[9] = {2e-28f, 0, 0, 0, 2e-28f, 0, 0, 0, 2e-28f};
    EXPECT_NEAR(flowGradient(moments, flows).divergence, 6.0, 1e-5);
}

TEST(FlowGradient, staysFiniteWhereNeighborsSpanNoVolume)
{
    const glm::dmat3 flat(1, 0, 0, 0, 1, 0, 0, 0, 0);
    const FlowGradient<double> found = gradientOf(kFlow, flat);
    EXPECT_NEAR(found.divergence, 3.0 / 2.0 * (1 + 5), 1e-12);
    EXPECT_EQ(gradientOf(kFlow, glm::dmat3(0.0)).divergence, 0.0);
    EXPECT_EQ(gradientOf(kFlow, glm::dmat3(0.0)).curl, 0.0);
}

} // namespace
