#include "simulation/verification/lattice.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace fx::sim {
namespace {

TEST(Lattice, pointsStandInTheMiddlesOfTheirCells)
{
    std::vector<glm::dvec3> points;
    Lattice{glm::dvec3(1, 2, 3), 0.5, {2, 1, 2}}.forEach([&](const glm::dvec3& p) { points.push_back(p); });
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[0], glm::dvec3(1.25, 2.25, 3.25));
    EXPECT_EQ(points[1], glm::dvec3(1.75, 2.25, 3.25));
    EXPECT_EQ(points[3], glm::dvec3(1.75, 2.25, 3.75));
}

TEST(Lattice, sidesAreEvenAndNearest)
{
    EXPECT_EQ(evenSide(262'144, 8), 64u);
    EXPECT_EQ(evenSide(32'768, 8), 32u);
    EXPECT_EQ(evenSide(40'000, 8), 34u);
    EXPECT_EQ(evenSide(1, 8), 8u);
    EXPECT_EQ(evenAbove(11.2), 12u);
    EXPECT_EQ(evenAbove(12), 12u);
    EXPECT_EQ(evenAbove(12.1), 14u);
}

TEST(Lattice, theSupportHoldsTheNeighbors)
{
    const double h = supportInSpacings(58);
    EXPECT_NEAR(4.0 / 3.0 * std::numbers::pi * h * h * h, 58, 1e-12);
}

} // namespace
} // namespace fx::sim
