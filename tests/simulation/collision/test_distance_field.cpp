#include "simulation/collision/distance_field.h"

#include "tests/simulation/collision/shapes.h"

using namespace fx;
using namespace fx::test;

namespace {

base::Status failureOf(const Soup& soup, float cell)
{
    const std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();
    return sim::DistanceField::build(viewOf(soup), cell, *tasks, std::pmr::get_default_resource()).status();
}

} // namespace

TEST(DistanceField, aBallIsAsFarAsItsFormulaSaysWithinTheBound)
{
    constexpr float kCell = 0.05f;
    constexpr double kFacets = 0.003; // between the ball and its triangles: r (1 - cos(pi / 48)) and some
    const auto field = fieldOf(sphereMesh(0.7f, 48), kCell);
    double largest = 0;
    for (uint32_t i = 0; i < 5000; ++i) {
        const glm::vec3 p = 0.85f * quasiRandom(i);
        const double error = std::abs(double(field->distance(p)) - (double(glm::length(p)) - 0.7));
        EXPECT_LE(error, double(sim::kFieldErrorCells * kCell) + kFacets);
        if (glm::length(p) > 0.3f) // away from the center the ball is flat for a cell
            largest = std::max(largest, error);
    }
    EXPECT_LT(largest, 0.1 * double(kCell) + kFacets); // in practice far below the bound
}

TEST(DistanceField, aBoxIsAsFarAsItsFormulaSaysWithinTheBound)
{
    constexpr float kCell = 0.06f;
    const glm::vec3 low(-0.6f, -0.3f, -0.45f), high(0.5f, 0.4f, 0.6f);
    const auto field = fieldOf(boxMesh(low, high), kCell);
    for (uint32_t i = 0; i < 5000; ++i) {
        const glm::vec3 p = 0.6f * quasiRandom(i);
        EXPECT_NEAR(double(field->distance(p)), boxDistance(p, low, high),
                    double(sim::kFieldErrorCells * kCell));
    }
}

TEST(DistanceField, eachNodeIsAsFarAsTheNearestOfAllTriangles)
{
    // solids and sheets without matter thinner than a cell; front and back are other tests' matter
    Soup sheet = sheetMesh(1.0f);
    for (glm::vec3& p : sheet)
        p.x -= 1.3f;
    const Soup soup =
        joined(joined(sphereMesh(0.6f, 10), boxMesh({0.1f, 0.7f, -0.3f}, {0.9f, 1.2f, 0.4f})), sheet);
    const auto field = fieldOf(soup, 0.11f);
    const sim::DistanceGrid& grid = field->grid();
    for (uint32_t z = 0; z + 1 < grid.nodes.z; ++z)
        for (uint32_t y = 0; y + 1 < grid.nodes.y; ++y)
            for (uint32_t x = 0; x + 1 < grid.nodes.x; ++x) {
                const glm::dvec3 p = grid.place(x, y, z);
                double nearest = 1e30;
                for (size_t i = 0; i + 2 < soup.size(); i += 3)
                    nearest =
                        std::min(nearest, glm::distance(p, sim::nearestOnTriangle(p, glm::dvec3(soup[i]),
                                                                                  glm::dvec3(soup[i + 1]),
                                                                                  glm::dvec3(soup[i + 2]))
                                                               .point));
                const double d = double(field->distance(glm::vec3(p)));
                // nothing is thickened so far away, and behind the sheet are only two cells of matter
                if (nearest > double(grid.cell) && p.x > -1.29) {
                    ASSERT_NEAR(std::abs(d), nearest, 2e-6) << x << ", " << y << ", " << z;
                }
            }
}

TEST(DistanceField, besideAFlatWallItIsExact)
{
    const auto field = fieldOf(boxMesh({-1, -1, -1}, {1, 1, 1}), 0.1f);
    for (const float x : {0.75f, 0.93f, 1.0f, 1.04f, 1.25f})
        EXPECT_NEAR(field->distance({x, 0.013f, -0.21f}), x - 1.0f, 1e-6f);
    EXPECT_EQ(field->sample({1.1f, 0.013f, -0.21f}).normal, glm::vec3(1, 0, 0));
}

TEST(DistanceField, theSignIsThatOfTheSideAlsoWhereRowsMeetEdgesAndCorners)
{
    // nodes at multiples of 1/8: rows run through corners, sides and diagonals of the mesh
    const auto field = fieldOf(boxMesh({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}), 0.125f);
    const sim::DistanceGrid& grid = field->grid();
    ASSERT_NEAR(std::fmod(grid.low.x, 0.125f), 0.0f, 1e-7f);
    for (uint32_t z = 0; z + 1 < grid.nodes.z; ++z)
        for (uint32_t y = 0; y + 1 < grid.nodes.y; ++y)
            for (uint32_t x = 0; x + 1 < grid.nodes.x; ++x) {
                const glm::vec3 p(grid.place(x, y, z));
                EXPECT_NEAR(double(field->distance(p)), boxDistance(p, glm::dvec3(-0.5), glm::dvec3(0.5)),
                            1e-6);
            }
}

TEST(DistanceField, whereSolidsOverlapIsInsideOfMatter)
{
    const auto field =
        fieldOf(joined(boxMesh({-1, -1, -1}, {0.2f, 1, 1}), boxMesh({-0.2f, -1, -1}, {1, 1, 1})), 0.1f);
    for (float x = -0.95f; x < 0.95f; x += 0.07f)
        EXPECT_LE(field->distance({x, 0.1f, 0.1f}), 0.0f) << x;
    EXPECT_GT(field->distance({1.2f, 0.1f, 0.1f}), 0.0f);
}

TEST(DistanceField, aSheetHasTwoCellsOfMatterBehindIt)
{
    constexpr float kCell = 0.1f;
    const auto field = fieldOf(sheetMesh(1.0f), kCell); // in front of it is +x
    for (float x = 0.01f; x < 0.3f; x += 0.05f) {
        const auto sample = field->sample({x, 0.1f, -0.3f});
        EXPECT_NEAR(sample.distance, x, 1e-5f);
        EXPECT_NEAR(sample.normal.x, 1.0f, 1e-5f);
    }
    for (float x = -0.01f; x > -0.19f; x -= 0.03f)
        EXPECT_LT(field->distance({x, 0.1f, -0.3f}), 0.0f);
    EXPECT_NEAR(field->distance({-0.35f, 0.1f, -0.3f}), 0.15f, 1e-5f);
    EXPECT_NEAR(field->sample({-0.35f, 0.1f, -0.3f}).normal.x, -1.0f, 1e-5f);
}

TEST(DistanceField, aWallBetweenTheNodesIsThickenedWhereverItIs)
{
    constexpr float kCell = 0.1f;
    for (float x = 0.0f; x < kCell; x += 0.0093f) {
        Soup wall = boxMesh({x, -1, -1}, {x + 0.012f, 1, 1});
        Soup far = boxMesh({1.5f, -0.5f, -0.5f}, {2, 0.5f, 0.5f}); // so that the grid does not move along
        far = joined(far, boxMesh({-2, -0.5f, -0.5f}, {-1.5f, 0.5f, 0.5f}));
        const auto field = fieldOf(joined(wall, far), kCell);
        int inside = 0;
        for (float at = -0.5f; at < 0.5f; at += 0.01f)
            inside += field->distance({at, 0.23f, -0.31f}) <= 0.0f ? 1 : 0;
        EXPECT_GE(inside, 5) << x; // half a cell
        EXPECT_LE(inside, 22) << x;
        EXPECT_NEAR(field->distance({x + 0.312f, 0.23f, -0.31f}), 0.3f, 1e-5f);
        EXPECT_NEAR(field->distance({x - 0.3f, 0.23f, -0.31f}), 0.3f, 1e-5f);
    }
}

TEST(DistanceField, aRoomSeenFromInsideIsEmptyWithin)
{
    const auto field = fieldOf(insideOut(boxMesh({-1, -1, -1}, {1, 1, 1})), 0.1f);
    EXPECT_NEAR(field->distance({0.0f, 0.0f, 0.5f}), 0.5f, 1e-5f);
    EXPECT_LT(field->sample({0.0f, 0.0f, 0.8f}).normal.z, -0.99f);
    EXPECT_LT(field->distance({0.0f, 0.0f, 1.1f}), 0.0f);
}

TEST(DistanceField, aBoxWithoutABottomIsAsFarAsAClosedOneAbove)
{
    Soup box = boxMesh({-0.6f, 0, -0.5f}, {0.6f, 0.8f, 0.5f});
    Soup open;
    for (size_t i = 0; i < box.size(); i += 3)
        if (box[i].y + box[i + 1].y + box[i + 2].y > 0.0f)
            open.insert(open.end(), {box[i], box[i + 1], box[i + 2]});
    ASSERT_EQ(open.size(), 30u);
    const auto field = fieldOf(open, 0.05f);
    for (uint32_t i = 0; i < 3000; ++i) {
        const glm::vec3 p = glm::vec3(0, 0.5f, 0) + 0.75f * glm::vec3(1.0f, 0.6f, 1.0f) * quasiRandom(i);
        const double exact = boxDistance(p, {-0.6, 0, -0.5}, {0.6, 0.8, 0.5});
        if (p.y > 0.05f && exact > 0.0) {
            EXPECT_NEAR(double(field->distance(p)), exact, double(sim::kFieldErrorCells * 0.05f));
        }
    }
}

TEST(DistanceField, theGradientIsAUnitVectorAwayFromTheSurface)
{
    const auto field = fieldOf(sphereMesh(0.7f, 48), 0.05f);
    for (uint32_t i = 0; i < 2000; ++i) {
        const glm::vec3 p = 0.85f * quasiRandom(i);
        const glm::vec3 n = field->sample(p).normal;
        EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
        if (glm::length(p) > 0.3f) {
            EXPECT_GT(glm::dot(n, glm::normalize(p)), 0.97f);
        }
    }
}

TEST(DistanceField, outsideOfTheGridTheMeshIsNotNearerThanItSays)
{
    const auto field = fieldOf(boxMesh({-1, -1, -1}, {1, 1, 1}), 0.1f);
    EXPECT_FLOAT_EQ(field->distance({5, 0, 0}), 4.0f);
    EXPECT_FLOAT_EQ(field->distance({4, 5, 0}), 5.0f);
    EXPECT_EQ(field->sample({0, 9, 0}).normal, glm::vec3(0, 1, 0));
}

TEST(DistanceField, indicesAndTriangleSoupGiveTheSameField)
{
    const Soup soup = boxMesh({-1, -1, -1}, {1, 1, 1});
    Soup corners;
    std::vector<uint32_t> indices;
    for (const glm::vec3& p : soup) {
        const auto at = std::find(corners.begin(), corners.end(), p);
        indices.push_back(uint32_t(at - corners.begin()));
        if (at == corners.end())
            corners.push_back(p);
    }
    ASSERT_EQ(corners.size(), 8u);
    sim::TriangleMesh mesh = viewOf(corners);
    mesh.indices = indices;
    const std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();
    const auto indexed = sim::DistanceField::build(mesh, 0.1f, *tasks, std::pmr::get_default_resource());
    ASSERT_TRUE(indexed.ok());
    EXPECT_EQ((*indexed)->hash(), fieldOf(soup, 0.1f)->hash());
}

TEST(DistanceField, theHashTellsMeshesPlacesAndCellsApart)
{
    const Soup box = boxMesh({-1, -1, -1}, {1, 1, 1});
    const uint64_t hash = fieldOf(box, 0.1f)->hash();
    EXPECT_NE(hash, 0u);
    EXPECT_EQ(hash, fieldOf(box, 0.1f)->hash());
    EXPECT_NE(hash, fieldOf(box, 0.11f)->hash());
    EXPECT_NE(hash, fieldOf(insideOut(box), 0.1f)->hash());
    sim::TriangleMesh moved = viewOf(box);
    moved.origin = {1, 0, 0};
    const std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();
    EXPECT_NE(hash,
              (*sim::DistanceField::build(moved, 0.1f, *tasks, std::pmr::get_default_resource()))->hash());
}

TEST(DistanceField, isTheSameForAnyNumberOfThreads)
{
    const Soup soup = joined(sphereMesh(0.7f, 20), sheetMesh(1.0f));
    const uint64_t serial = fieldOf(soup, 0.05f)->hash();
    for (const uint32_t threads : {1u, 2u, 3u, 7u}) {
        const std::unique_ptr<base::TaskRunner> tasks = threadedRunner(threads);
        const auto field =
            sim::DistanceField::build(viewOf(soup), 0.05f, *tasks, std::pmr::get_default_resource());
        EXPECT_EQ((*field)->hash(), serial) << threads;
    }
}

TEST(DistanceField, anAutomaticCellIsAsFineAsItsNodesAllow)
{
    for (const Soup& soup :
         {boxMesh({-1, -1, -1}, {1, 1, 1}), sheetMesh(30), boxMesh({0, 0, 0}, {90, 0.1f, 0.1f})})
    {
        const auto field = fieldOf(soup, 0.0f);
        EXPECT_LE(field->grid().count(), sim::kAutomaticFieldNodes);
        EXPECT_GT(field->cell(), 0.0f);
    }
    EXPECT_LT(fieldOf(boxMesh({-1, -1, -1}, {1, 1, 1}), 0.0f)->cell(), 0.02f);
}

TEST(DistanceField, tooManyCellsAreRefusedWithTheirNumber)
{
    const base::Status status = failureOf(boxMesh({0, 0, 0}, {100, 100, 100}), 0.1f);
    EXPECT_EQ(status.code(), base::Code::Capacity);
    EXPECT_NE(status.message().find("1027243729"), std::string::npos) << status.message(); // 1009^3
}

TEST(DistanceField, meshesWithoutSurfaceAreRefused)
{
    EXPECT_EQ(failureOf({}, 0.1f).code(), base::Code::InvalidArgument);
    EXPECT_EQ(failureOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, 0.1f).code(), base::Code::InvalidArgument);
    EXPECT_EQ(failureOf({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 0.0f).code(), base::Code::InvalidArgument);
    EXPECT_EQ(failureOf({{0, 0, 0}, {NAN, 1, 1}, {2, 2, 2}}, 0.1f).code(), base::Code::InvalidArgument);
}
