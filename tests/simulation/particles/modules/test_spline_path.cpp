#include "simulation/particles/fields/spline_path.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace fx::sim;

TEST(SplinePath, goesThroughItsPoints)
{
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 2, 0}, {3, 1, 1}, {4, 0, 5}};
    const SplinePath path(points, false);
    EXPECT_LT(glm::length(path.at(0.0f).position - points.front()), 1e-5f);
    EXPECT_LT(glm::length(path.at(1.0f).position - points.back()), 1e-5f);
    for (const glm::vec3& p : points) {
        float nearest = 1e9f;
        for (int i = 0; i <= 20000; ++i)
            nearest = std::min(nearest, glm::length(path.at(float(i) / 20000.0f).position - p));
        EXPECT_LT(nearest, 1e-3f);
    }
}

TEST(SplinePath, ofPointsOnALineIsTheLineAtEvenSpeed)
{
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {6, 0, 0}}; // of uneven distance
    const SplinePath path(points, false);
    EXPECT_NEAR(path.length(), 6.0, 1e-3);
    for (int i = 0; i <= 100; ++i) {
        EXPECT_NEAR(path.at(float(i) / 100.0f).position.x, 0.06f * float(i), 2e-3f);
        EXPECT_NEAR(path.at(float(i) / 100.0f).tangent.x, 1.0f, 1e-6f);
    }
}

TEST(SplinePath, equalSharesAreEqualLengths)
{
    const std::vector<glm::vec3> points{{0, 0, 0}, {1, 3, 0}, {2, -1, 2}, {7, 0, 1}, {7, 1, 1}};
    const SplinePath path(points, false);
    const int kPieces = 2000;
    double longest = 0, shortest = 1e9;
    glm::vec3 before = path.at(0.0f).position;
    for (int i = 1; i <= kPieces; ++i) {
        const glm::vec3 p = path.at(float(i) / float(kPieces)).position;
        longest = std::max(longest, double(glm::length(p - before)));
        shortest = std::min(shortest, double(glm::length(p - before)));
        before = p;
    }
    EXPECT_LT(longest / shortest, 1.02);
}

TEST(SplinePath, aClosedOneEndsWhereItBeginsAndGoesAroundACircle)
{
    std::vector<glm::vec3> points;
    for (int i = 0; i < 16; ++i)
        points.push_back({std::cos(std::numbers::pi * i / 8), std::sin(std::numbers::pi * i / 8), 0.0});
    const SplinePath path(points, true);
    EXPECT_LT(glm::length(path.at(0.0f).position - path.at(1.0f).position), 1e-5f);
    EXPECT_NEAR(path.length(), 2.0 * std::numbers::pi, 5e-3);
    EXPECT_NEAR(glm::length(path.at(0.37f).position), 1.0f, 2e-3f);
}

TEST(SplinePath, pointsThatCoincideDoNoHarm)
{
    const std::vector<glm::vec3> points(3, glm::vec3(1, 2, 3));
    const SplinePath path(points, false);
    EXPECT_EQ(path.length(), 0.0);
    EXPECT_EQ(path.at(0.5f).position, glm::vec3(1, 2, 3));
    EXPECT_NEAR(glm::length(path.at(0.5f).tangent), 1.0f, 1e-6f);
}
