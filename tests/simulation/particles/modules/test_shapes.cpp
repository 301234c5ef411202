#include "foundation/random/philox.h"
#include "simulation/particles/fields/spline_path.h"
#include "simulation/particles/fields/turn.h"
#include "simulation/particles/shapes/mesh_sampler.h"
#include "simulation/particles/shapes/shape_sample.h"
#include "tests/simulation/particles/modules/chi_square.h"

#include <algorithm>
#include <numbers>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;

namespace {

constexpr int kSamples = 1'000'000;
constexpr size_t kCells = 64;

ShapeDef shaped(ShapeKind kind, const glm::vec3& size)
{
    ShapeDef def;
    def.kind = kind;
    def.size = size;
    return def;
}

/// Calls f(place) for each of a million samples.
template <class F>
void forEachSample(const ShapeDef& def, F&& f, int samples = kSamples)
{
    for (int i = 0; i < samples; ++i) {
        const ShapePlace place =
            sampleShape(def, base::randomUnit4(11, 2, uint64_t(i), base::RandomPurpose::Position),
                        base::randomUnit4(11, 2, uint64_t(i), base::RandomPurpose::Direction));
        if (!(std::abs(glm::length(place.direction) - 1.0f) < 1e-4f))
            return ADD_FAILURE() << "direction of sample " << i;
        f(glm::dvec3(place.position), glm::dvec3(place.direction));
    }
}

double turnOf(double y, double x)
{
    return std::atan2(y, x) / (2.0 * std::numbers::pi) + 0.5;
}

} // namespace

TEST(Shapes, aLineIsEvenAndItsParticlesLeaveItSideways)
{
    ShapeDef def = shaped(ShapeKind::Line, {2, 0, 0});
    def.axis = {0, 0, 3};
    EqualCells along(kCells), around(kCells);
    forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
        along.add((p.z + 2.0) / 4.0);
        around.add(turnOf(d.y, d.x));
        ASSERT_NEAR(d.z, 0.0, 1e-6);
    });
    expectEven(along, "along");
    expectEven(around, "around");
}

TEST(Shapes, discsAreEvenWithAndWithoutAMiddleAndOnTheirRim)
{
    for (const float inner : {0.0f, 0.6f}) {
        ShapeDef def = shaped(ShapeKind::Disc, {3, 0, 0});
        def.inner = inner;
        EqualCells radius(kCells), turn(kCells);
        const double k = double(inner) * double(inner);
        forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
            radius.add((glm::dot(p, p) / 9.0 - k) / (1.0 - k));
            turn.add(turnOf(p.z, p.x));
            ASSERT_EQ(d.y, 1.0);
        });
        expectEven(radius, "radius");
        expectEven(turn, "turn");
    }
    ShapeDef rim = shaped(ShapeKind::Disc, {3, 0, 0});
    rim.onSurface = true;
    forEachSample(
        rim, [&](const glm::dvec3& p, const glm::dvec3&) { ASSERT_NEAR(glm::length(p), 3.0, 1e-5); }, 1000);
}

TEST(Shapes, ballsShellsAndSpheresAreEven)
{
    for (const float inner : {0.0f, 0.5f, 1.0f}) {
        ShapeDef def = shaped(ShapeKind::Sphere, {2, 0, 0});
        def.inner = inner;
        def.onSurface = inner == 1.0f;
        EqualCells volume(kCells), height(kCells), turn(kCells);
        const double k = std::pow(double(inner), 3);
        forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
            const double r = glm::length(p);
            if (inner == 1.0f)
                ASSERT_NEAR(r, 2.0, 1e-5);
            else
                volume.add((std::pow(r / 2.0, 3) - k) / (1.0 - k));
            height.add(0.5 + 0.5 * d.y); // Archimedes
            turn.add(turnOf(d.z, d.x));
        });
        if (inner < 1.0f)
            expectEven(volume, "volume");
        expectEven(height, "height");
        expectEven(turn, "turn");
    }
}

TEST(Shapes, boxesAreEvenInsideAndOnTheirFaces)
{
    const glm::dvec3 half(1, 2, 3);
    ShapeDef def = shaped(ShapeKind::Box, glm::vec3(half));
    for (int axis = 0; axis < 3; ++axis) {
        EqualCells cells(kCells);
        forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3&) {
            cells.add(0.5 + 0.5 * p[axis] / half[axis]);
        });
        expectEven(cells, "inside");
    }
    def.onSurface = true;
    EqualCells faces(22); // unit squares: areas 6, 3, 2 on both sides, 11 halves of a square each
    EqualCells across(kCells);
    forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
        const int axis = std::abs(d.x) > 0.5 ? 0 : (std::abs(d.y) > 0.5 ? 1 : 2);
        ASSERT_NEAR(p[axis], d[axis] * half[axis], 1e-6);
        const int first = axis == 0 ? 0 : (axis == 1 ? 6 : 9), parts = axis == 0 ? 6 : (axis == 1 ? 3 : 2);
        const int other = axis == 0 ? 2 : (axis == 1 ? 2 : 1);
        const int part = std::min(int((0.5 + 0.5 * p[other] / half[other]) * parts), parts - 1);
        faces.addCell(size_t((d[axis] > 0 ? 11 : 0) + first + part));
        across.add(0.5 + 0.5 * p[3 - axis - other] / half[3 - axis - other]);
    });
    expectEven(faces, "faces");
    expectEven(across, "across");
}

TEST(Shapes, conesAreEvenInVolumeAndOnTheirSide)
{
    for (const bool onSurface : {false, true}) {
        ShapeDef def = shaped(ShapeKind::Cone, {0.5f, 0, 0});
        def.height = 2.0f;
        def.angle = 0.6f;
        def.onSurface = onSurface;
        const double slope = std::tan(double(def.angle)), low = 0.5, high = low + 2.0 * slope;
        const double power = onSurface ? 2.0 : 3.0;
        EqualCells height(kCells), radius(kCells), turn(kCells);
        forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
            const double wide = low + p.y * slope, r = std::sqrt(p.x * p.x + p.z * p.z);
            height.add((std::pow(wide, power) - std::pow(low, power)) /
                       (std::pow(high, power) - std::pow(low, power)));
            turn.add(turnOf(p.z, p.x));
            radius.add(r * r / (wide * wide));
            ASSERT_GE(d.y, std::cos(double(def.angle)) - 1e-5);
            if (onSurface) {
                ASSERT_NEAR(r, wide, 1e-5);
            }
        });
        expectEven(height, "height");
        expectEven(turn, "turn");
        if (!onSurface)
            expectEven(radius, "radius");
    }
}

TEST(Shapes, toriAreEvenInVolumeAndOnTheirTube)
{
    for (const bool onSurface : {false, true}) {
        ShapeDef def = shaped(ShapeKind::Torus, {2, 0, 0});
        def.tube = 1.5f;
        def.onSurface = onSurface;
        EqualCells around(kCells), tube(kCells), across(kCells);
        forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
            const double ring = std::sqrt(p.x * p.x + p.z * p.z) - 2.0;
            const double r = std::sqrt(ring * ring + p.y * p.y);
            around.add(turnOf(p.z, p.x));
            across.add(r * r / 2.25);
            // Of the tube's circumference below angle b lies (T b + r sin b) / (2 pi T).
            const double b = std::atan2(p.y, ring) + std::numbers::pi;
            tube.add((2.0 * b - r * std::sin(b)) / (4.0 * std::numbers::pi));
            ASSERT_NEAR(d.y * r, p.y, 1e-5);
            if (onSurface) {
                ASSERT_NEAR(r, 1.5, 1e-5);
            }
        });
        expectEven(around, "around");
        expectEven(tube, "tube");
        if (!onSurface)
            expectEven(across, "across");
    }
}

TEST(Shapes, meshesAreEvenInAreaAndHeadAlongTheirNormals)
{
    // A floor of 4 x 1 and a wall of 4 x 3, so that a quarter of the area is floor.
    const std::vector<glm::vec3> corners{{0, 0, 0}, {4, 0, 0}, {4, 0, 1}, {0, 0, 1}, {0, 3, 0}, {4, 3, 0}};
    const std::vector<uint32_t> indices{0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 1, 2}; // the last has no area
    const auto sampler = makeMeshSampler({glm::dvec3(0.0), corners, indices});
    ASSERT_TRUE(sampler.ok());
    ShapeDef def = shaped(ShapeKind::Mesh, {});
    def.mesh = *sampler;
    def.position = {10, 0, 0};
    EqualCells x(kCells), area(4), inFloor(kCells), inWall(kCells);
    forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3& d) {
        x.add((p.x - 10.0) / 4.0);
        const bool isFloor = d.y > 0.5;
        ASSERT_NEAR(isFloor ? p.y : p.z, 0.0, 1e-6);
        area.addCell(isFloor ? 0 : 1 + std::min(size_t(p.y), size_t(2)));
        (isFloor ? inFloor : inWall).add(isFloor ? p.z : p.y / 3.0);
    });
    expectEven(x, "x");
    expectEven(area, "area");
    expectEven(inFloor, "floor");
    expectEven(inWall, "wall");
}

TEST(Shapes, splinesAreEvenInLength)
{
    ShapeDef def = shaped(ShapeKind::Spline, {});
    def.spline = std::make_shared<SplinePath>(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {7, 0, 0}}, false);
    EqualCells along(kCells);
    forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3&) { along.add(p.x / 7.0); });
    expectEven(along, "along");
}

TEST(Shapes, volumesAreBornWhereThereIsDensity)
{
    FieldGrid grid;
    grid.nodes = {2, 1, 2};
    grid.low = {1, 2, 3};
    grid.cell = {0.5f, 1.0f, 2.0f};
    grid.values = {1.0f, 2.0f, 0.0f, 5.0f}; // (0,0), (1,0), (0,1), (1,1) in x, z
    const auto sampler = makeVolumeSampler(grid);
    ASSERT_TRUE(sampler.ok());
    ShapeDef def = shaped(ShapeKind::Volume, {});
    def.volume = *sampler;
    EqualCells nodes(8), within(kCells), high(kCells);
    forEachSample(def, [&](const glm::dvec3& p, const glm::dvec3&) {
        const bool isHighX = p.x > 1.25, isHighZ = p.z > 4.0;
        const size_t first = isHighZ ? 3 : (isHighX ? 1 : 0), wide = isHighZ ? 5 : (isHighX ? 2 : 1);
        ASSERT_FALSE(isHighZ && !isHighX) << "no density there";
        nodes.addCell(first + std::min(size_t((p.y - 1.5) * double(wide)), wide - 1));
        within.add((p.x - (isHighX ? 1.25 : 0.75)) / 0.5);
        high.add(p.y - 1.5);
    });
    expectEven(within, "x within the node");
    expectEven(high, "y within the node");
    EXPECT_LT(nodes.chiSquare(), chiSquareLimit(7, kSidak));
}

TEST(Shapes, theAxisTurnsAllOfAShapeAndUpChangesNothing)
{
    ShapeDef upright = shaped(ShapeKind::Cone, {1, 0, 0});
    upright.angle = 0.3f;
    ShapeDef turned = upright;
    turned.axis = glm::vec3(1, -2, 0.5f);
    turned.position = {5, 6, 7};
    const glm::vec3 axis = glm::normalize(turned.axis);
    for (uint64_t i = 0; i < 1000; ++i) {
        const auto u = base::randomUnit4(1, 0, i, base::RandomPurpose::Position);
        const auto h = base::randomUnit4(1, 0, i, base::RandomPurpose::Direction);
        const ShapePlace a = sampleShape(upright, u, h), b = sampleShape(turned, u, h);
        EXPECT_NEAR(a.direction.y, glm::dot(b.direction, axis), 1e-5f);
        EXPECT_NEAR(glm::length(a.position), glm::length(b.position - turned.position), 1e-5f);
        EXPECT_NEAR(glm::dot(b.position - turned.position, axis), 0.0f, 1e-5f);
    }
    const glm::vec3 v(0.1f, -0.7f, 2.0f);
    EXPECT_EQ(turnFromY({0, 1, 0}, v), v);
    EXPECT_EQ(turnFromY({0, -1, 0}, v), glm::vec3(0.1f, 0.7f, -2.0f));
    EXPECT_LT(glm::length(turnToY(axis, turnFromY(axis, v)) - v), 1e-5f);
    EXPECT_LT(glm::length(turnFromY(axis, {0, 1, 0}) - axis), 1e-6f);
}

TEST(Shapes, theModuleGivesWhatTheFunctionGives)
{
    ShapeDef def = shaped(ShapeKind::Torus, {2, 0, 0});
    def.tube = 0.3f;
    std::vector<std::array<float, 4>> u(5), h(5);
    std::vector<std::vector<float>> columns(8, std::vector<float>(5)), out(6, std::vector<float>(5));
    for (uint32_t i = 0; i < 5; ++i) {
        u[i] = base::randomUnit4(1, 0, i, base::RandomPurpose::Position);
        h[i] = base::randomUnit4(1, 0, i, base::RandomPurpose::Direction);
        for (size_t k = 0; k < 4; ++k) {
            columns[k][i] = u[i][k];
            columns[4 + k][i] = h[i][k];
        }
    }
    makeShapeOp(def)->sample({{columns[0].data(), columns[1].data(), columns[2].data(), columns[3].data()},
                              {columns[4].data(), columns[5].data(), columns[6].data(), columns[7].data()},
                              {out[0].data(), out[1].data(), out[2].data()},
                              {out[3].data(), out[4].data(), out[5].data()},
                              5});
    for (uint32_t i = 0; i < 5; ++i) {
        const ShapePlace want = sampleShape(def, u[i], h[i]);
        EXPECT_EQ(glm::vec3(out[0][i], out[1][i], out[2][i]), want.position);
        EXPECT_EQ(glm::vec3(out[3][i], out[4][i], out[5][i]), want.direction);
    }
}

TEST(Shapes, nothingToDrawFromIsAnError)
{
    const std::vector<glm::vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_FALSE(makeMeshSampler({glm::dvec3(0.0), line, {}}).ok());
    FieldGrid empty;
    empty.values = {0.0f};
    EXPECT_FALSE(makeVolumeSampler(empty).ok());
}
