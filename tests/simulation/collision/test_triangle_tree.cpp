#include "simulation/collision/triangle_tree.h"

#include "foundation/simd/instruction_set.h"
#include "simulation/collision/point_triangle.h"
#include "tests/simulation/collision/shapes.h"

using namespace fx;
using namespace fx::test;

namespace {

/// By looking at very many points of the triangle.
double sampledDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    double nearest = 1e30;
    constexpr int kSteps = 200;
    for (int i = 0; i <= kSteps; ++i)
        for (int k = 0; i + k <= kSteps; ++k)
            nearest = std::min(nearest, glm::distance(p, a + (b - a) * (double(i) / kSteps) +
                                                             (c - a) * (double(k) / kSteps)));
    return nearest;
}

std::vector<sim::Triangle> trianglesOf(const Soup& soup)
{
    std::vector<sim::Triangle> triangles;
    for (size_t i = 0; i + 2 < soup.size(); i += 3)
        triangles.push_back({soup[i], soup[i + 1], soup[i + 2]});
    return triangles;
}

/// Points on and beside corners, sides and insides, and far away.
sim::PointPacket packetNear(const Soup& soup, uint32_t i)
{
    sim::PointPacket packet;
    for (uint32_t k = 0; k < sim::kPacketPoints; ++k) {
        glm::dvec3 p = (k % 2 == 0 ? 1.2f : 40.0f) * quasiRandom(8 * i + k);
        if (k == 3)
            p = glm::dvec3(soup[(7 * i) % soup.size()]); // a corner
        if (k == 5)                                      // above a side
            p = 0.55 * (glm::dvec3(soup[3 * i % soup.size()]) + glm::dvec3(soup[(3 * i + 1) % soup.size()]));
        packet.x[k] = p.x;
        packet.y[k] = p.y;
        packet.z[k] = p.z;
    }
    return packet;
}

} // namespace

TEST(PointTriangle, eachRegionHasItsNearestPoint)
{
    const glm::dvec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
    EXPECT_EQ(sim::nearestOnTriangle({-1, -1, 3}, a, b, c).point, a);
    EXPECT_EQ(sim::nearestOnTriangle({4, -1, 3}, a, b, c).point, b);
    EXPECT_EQ(sim::nearestOnTriangle({-1, 4, 3}, a, b, c).point, c);
    EXPECT_EQ(sim::nearestOnTriangle({1, -1, 3}, a, b, c).point, glm::dvec3(1, 0, 0));
    EXPECT_EQ(sim::nearestOnTriangle({-1, 1, 3}, a, b, c).point, glm::dvec3(0, 1, 0));
    EXPECT_EQ(sim::nearestOnTriangle({2, 2, 3}, a, b, c).point, glm::dvec3(1, 1, 0));
    EXPECT_EQ(sim::nearestOnTriangle({1, -1, 3}, a, b, c).feature, sim::Feature::AB);
    EXPECT_EQ(sim::nearestOnTriangle({2, 2, 3}, a, b, c).feature, sim::Feature::BC);
    EXPECT_EQ(sim::nearestOnTriangle({0.5, 0.5, 3}, a, b, c).feature, sim::Feature::Inside);
    EXPECT_EQ(sim::nearestOnTriangle({0.5, 0.5, 3}, a, b, c).point, glm::dvec3(0.5, 0.5, 0));
}

TEST(PointTriangle, noPointOfTheTriangleIsNearer)
{
    for (uint32_t i = 0; i < 40; ++i) {
        const glm::dvec3 p = 2.0f * quasiRandom(4 * i), a(quasiRandom(4 * i + 1)), b(quasiRandom(4 * i + 2)),
                         c(quasiRandom(4 * i + 3));
        const double d = glm::distance(p, sim::nearestOnTriangle(p, a, b, c).point);
        EXPECT_LE(d, sampledDistance(p, a, b, c) + 1e-12);
        EXPECT_GE(d, sampledDistance(p, a, b, c) - 0.02);
    }
}

TEST(TriangleTree, findsWhatLookingAtEveryTriangleFinds)
{
    const std::vector<sim::Triangle> triangles = trianglesOf(sphereMesh(0.8f, 12));
    const sim::TriangleTree tree(triangles, std::pmr::get_default_resource());
    for (uint32_t i = 0; i < 300; ++i) {
        const glm::dvec3 p = 1.5f * quasiRandom(i);
        double nearest = 1e30;
        for (const sim::Triangle& t : triangles)
            nearest = std::min(
                nearest,
                glm::distance(
                    p,
                    sim::nearestOnTriangle(p, glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2])).point));
        EXPECT_DOUBLE_EQ(tree.nearest(p, 100.0).distance, nearest);
        EXPECT_DOUBLE_EQ(tree.nearest(p, 0.5 * nearest).distance, 0.5 * nearest);
    }
}

TEST(TriangleTree, eightPointsAtOnceAreAsFarAsEachAloneBitForBitOnEveryInstructionSet)
{
    Soup soup = joined(sphereMesh(0.8f, 9), boxMesh({-0.5f, -0.9f, -0.4f}, {0.7f, 0.9f, 0.3f}));
    for (uint32_t i = 0; i < 90; ++i)
        soup.push_back(1.5f * quasiRandom(1000 + i));
    soup.insert(soup.end(), {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}); // no area
    const std::vector<sim::Triangle> triangles = trianglesOf(soup);
    const sim::TriangleTree tree(triangles, std::pmr::get_default_resource());
    const base::InstructionSet widest = base::instructionSet();
    for (const base::InstructionSet set : {base::InstructionSet::Scalar, base::InstructionSet::Sse4,
                                           base::InstructionSet::Avx2, base::InstructionSet::Avx512})
    {
        base::limitInstructionSet(set);
        for (uint32_t i = 0; i < 150; ++i) {
            const sim::PointPacket packet = packetNear(soup, i);
            sim::PacketNearest found;
            tree.nearest(packet, i % uint32_t(triangles.size()), found);
            for (uint32_t k = 0; k < sim::kPacketPoints; ++k) {
                const glm::dvec3 p(packet.x[k], packet.y[k], packet.z[k]);
                const double alone = tree.nearest(p, 1e9).distance;
                ASSERT_EQ(std::sqrt(found.squared[k]), alone) << i << ", " << k;
                ASSERT_EQ(tree.at(found.triangle[k], p).distance, alone) << i << ", " << k;
            }
        }
    }
    base::limitInstructionSet(widest);
}

TEST(TriangleTree, allThatAreEquallyNearAreTold)
{
    // from the middle, six faces of a cube are equally far, each by one or both of its triangles
    const std::vector<sim::Triangle> cube = trianglesOf(boxMesh({-1, -1, -1}, {1, 1, 1}));
    const sim::TriangleTree tree(cube, std::pmr::get_default_resource());
    sim::PointPacket packet{};
    packet.x[1] = 0.5; // nearer to one face, in the middle of its diagonal
    packet.x[2] = packet.y[2] = packet.z[2] = 3.0;
    sim::PacketNearest found;
    tree.nearest(packet, 0, found);
    EXPECT_EQ(found.equals[0], 11u);
    EXPECT_EQ(found.equals[1], 1u);
    EXPECT_EQ(tree.at(found.equal[sim::PacketNearest::kMaxEqualTriangles], {0.5, 0, 0}).distance, 0.5);
    const sim::TriangleTree::Nearest corner = tree.at(found.triangle[2], {3, 3, 3});
    EXPECT_EQ(corner.point, glm::dvec3(1));
}

TEST(TriangleTree, withoutTrianglesNothingIsNear)
{
    const sim::TriangleTree tree({}, std::pmr::get_default_resource());
    EXPECT_TRUE(tree.empty());
    EXPECT_EQ(tree.nearest({0, 0, 0}, 7.0).distance, 7.0);
}
