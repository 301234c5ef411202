#include "simulation/collision/mesh_surface.h"

#include "tests/simulation/collision/shapes.h"

#include <limits>

using namespace fx;
using namespace fx::test;

namespace {

sim::MeshSurface sorted(const Soup& soup)
{
    return sim::sortTriangles(viewOf(soup), std::pmr::get_default_resource());
}

} // namespace

TEST(MeshSurface, aClosedBoxIsASolid)
{
    const sim::MeshSurface surface = sorted(boxMesh({-1, -1, -1}, {1, 1, 1}));
    EXPECT_EQ(surface.solids.size(), 12u);
    EXPECT_TRUE(surface.sheets.empty());
}

TEST(MeshSurface, aBoxWithoutALidIsASheet)
{
    Soup box = boxMesh({-1, -1, -1}, {1, 1, 1});
    box.resize(box.size() - 3);
    EXPECT_EQ(sorted(box).sheets.size(), 11u);
    EXPECT_TRUE(sorted(box).solids.empty());
}

TEST(MeshSurface, aRoomSeenFromInsideIsASheet)
{
    EXPECT_EQ(sorted(insideOut(boxMesh({-1, -1, -1}, {1, 1, 1}))).sheets.size(), 12u);
}

TEST(MeshSurface, pseudonormalsOfARoofLeadAwayFromItsRidge)
{
    Soup roof; // two slopes that meet at x = z = 0 and fall towards -x and +x
    addQuad(roof, {0, 1, -1}, {-1, 0, -1}, {-1, 0, 1}, {0, 1, 1});
    addQuad(roof, {0, 1, 1}, {1, 0, 1}, {1, 0, -1}, {0, 1, -1});
    const sim::MeshSurface surface = sorted(roof);
    ASSERT_EQ(surface.sheets.size(), 4u);
    for (size_t t = 0; t < 4; ++t) {
        const auto& normals = surface.normals[t];
        const glm::vec3 inside = normals[size_t(sim::Feature::Inside)];
        EXPECT_NEAR(std::abs(inside.x), std::sqrt(0.5f), 1e-6f);
        EXPECT_NEAR(inside.y, std::sqrt(0.5f), 1e-6f);
        const glm::vec3 sides[3] = {normals[size_t(sim::Feature::AB)], normals[size_t(sim::Feature::BC)],
                                    normals[size_t(sim::Feature::CA)]};
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec3 &u = surface.sheets[t][k], &v = surface.sheets[t][(k + 1) % 3];
            const glm::vec3 want = u.x == 0.0f && v.x == 0.0f ? glm::vec3(0, 1, 0) : inside;
            EXPECT_NEAR(glm::dot(glm::normalize(sides[k]), want), 1.0f, 1e-6f);
            if (u.x == 0.0f) { // the triangles of both slopes take the same angle at a corner of the ridge
                EXPECT_NEAR(normals[k].x, 0.0f, 1e-5f);
                EXPECT_GT(normals[k].y, 0.5f);
            }
        }
    }
}

TEST(MeshSurface, piecesAreJudgedOneByOne)
{
    const Soup both = joined(boxMesh({-1, -1, -1}, {1, 1, 1}), sheetMesh(4));
    const sim::MeshSurface surface = sorted(both);
    EXPECT_EQ(surface.solids.size(), 12u);
    EXPECT_EQ(surface.sheets.size(), 2u);
}

TEST(MeshSurface, trianglesWithoutAnAreaAreLeftOut)
{
    Soup box = boxMesh({-1, -1, -1}, {1, 1, 1});
    const Soup degenerate = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 1},
                             {2, 2, 2}, {5, 5, 5}, {5, 5, 5}, {5, 5, 5}};
    const sim::MeshSurface surface = sorted(joined(box, degenerate));
    EXPECT_EQ(surface.solids.size(), 12u);
    EXPECT_TRUE(surface.sheets.empty());
}

TEST(TriangleMesh, namesWhatIsWrongWithIt)
{
    const Soup good = sheetMesh(1);
    EXPECT_TRUE(sim::checkMesh(viewOf(good)).ok());
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -2.0e5f})
    {
        Soup soup = good;
        soup[4].z = wrong;
        const base::Status status = sim::checkMesh(viewOf(soup));
        EXPECT_EQ(status.code(), base::Code::InvalidArgument);
        EXPECT_NE(status.message().find("position 4"), std::string::npos) << status.message();
    }
    Soup cut = good;
    cut.pop_back();
    EXPECT_EQ(sim::checkMesh(viewOf(cut)).code(), base::Code::InvalidArgument);
    sim::TriangleMesh indexed = viewOf(good);
    const std::vector<uint32_t> indices{0, 1, 6};
    indexed.indices = indices;
    EXPECT_NE(sim::checkMesh(indexed).message().find("index 2"), std::string::npos);
}
