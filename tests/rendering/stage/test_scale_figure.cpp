// The person beside whom the size of an effect is read: its size, place, surface and shadow.
#include "rendering/frame/exposure.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/scale_figure.h"
#include "rendering/stage/stage_props.h"
#include "view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace fx;
using namespace fx::test;

namespace {

struct Box
{
    glm::vec3 low{1e9f}, high{-1e9f};
};

Box boxAround(std::span<const glm::vec3> points)
{
    Box box;
    for (const glm::vec3& p : points) {
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    }
    return box;
}

render::StageMesh figureAlone(const render::ScaleFigure& figure)
{
    render::StageMesh mesh;
    render::addScaleFigure(mesh, figure);
    return mesh;
}

/// Level soil of half side 500 m, of albedo 0.5.
render::StageMesh soil()
{
    render::StageMesh mesh;
    const glm::vec3 corner[] = {{-500, 0, 500}, {500, 0, 500}, {500, 0, -500}, {-500, 0, -500}};
    for (const int i : {0, 1, 2, 0, 2, 3}) {
        mesh.positions.push_back(corner[i]);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.colors.emplace_back(0.5f);
    }
    mesh.isSoil = true;
    return mesh;
}

class ScaleFigureTest : public ViewTest
{
protected:
    static constexpr int kSize = 16;

    /// Mean luminance of a square of ground of 0.3 m around a point, seen from above, in the light of a low
    /// sun from +x alone.
    float groundAt(const render::StageMesh& mesh, const glm::dvec3& point)
    {
        render::StageRenderer stage(device_.get());
        EXPECT_TRUE(stage.setMesh(mesh).ok());
        render::Lighting lighting;
        lighting.sunDirection = glm::normalize(glm::vec3(1.0f, 0.5f, 0.0f));
        lighting.sunIlluminance = glm::vec3(50000.0f);
        lighting.skyLuminance = glm::vec3(0.0f);
        lighting.groundAlbedo = 0.0f;
        const auto camera = render::orthographicView(
            {point + glm::dvec3(0, 0.5, 0), point, {0.0f, 0.0f, -1.0f}}, 0.3f, 1.0f, 0.1f, 1.0f);
        EXPECT_TRUE(stage.render(camera, lighting, {}, kEv100, kSize, kSize).ok());
        const auto texels = render::readTexture(*device_, stage.colorTexture(), kSize, kSize, 4);
        float sum = 0.0f;
        for (size_t i = 0; i < texels.size(); i += 4)
            sum += texels[i];
        return sum / (float(kSize * kSize) * render::exposureFromEv100(kEv100));
    }
};

} // namespace

TEST(ScaleFigure, is1800MillimetersTallAndStandsOnItsPosition)
{
    const render::StageMesh mesh = figureAlone({{3.0f, 2.0f, -1.0f}, 0.0f});
    const Box box = boxAround(mesh.positions);
    EXPECT_NEAR(box.high.y - box.low.y, render::kFigureHeight, 0.005f);
    EXPECT_NEAR(box.low.y, 2.0f, 0.005f);
    EXPECT_NEAR(0.5f * (box.low.x + box.high.x), 3.0f, 0.001f); // both sides are alike
    EXPECT_GT(box.low.x, 3.0f - 0.4f);
    EXPECT_GT(box.low.z, -1.0f - 0.3f);
    EXPECT_LT(box.high.z, -1.0f + 0.3f);
    EXPECT_EQ(mesh.figureVertices, mesh.positions.size());
}

TEST(ScaleFigure, turnsAboutTheVertical)
{
    const Box ahead = boxAround(figureAlone({}).positions);
    const Box right = boxAround(figureAlone({glm::vec3(0.0f), 90.0f}).positions);
    EXPECT_NEAR(right.high.x, ahead.high.z, 1e-5f); // it looked along +z, and looks along +x
    EXPECT_NEAR(right.low.x, ahead.low.z, 1e-5f);
    EXPECT_NEAR(right.high.z, -ahead.low.x, 1e-5f);
}

TEST(ScaleFigure, hasOutwardTrianglesOnAllSidesAndRealAlbedos)
{
    const render::StageMesh mesh = figureAlone({});
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); i += 3) {
        const glm::vec3 cross =
            glm::cross(mesh.positions[i + 1] - mesh.positions[i], mesh.positions[i + 2] - mesh.positions[i]);
        for (size_t k = 0; k < 3; ++k) {
            EXPECT_GT(glm::dot(glm::normalize(cross), mesh.normals[i + k]), 0.7f) << i;
            EXPECT_NEAR(glm::length(mesh.normals[i + k]), 1.0f, 1e-5f);
        }
    }
    for (const glm::vec3& color : mesh.colors)
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(color[c], 0.0f);
            EXPECT_LT(color[c], 0.9f);
        }
    glm::vec3 area(0.0f); // of closed surfaces the area vectors cancel
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        area +=
            glm::cross(mesh.positions[i + 1] - mesh.positions[i], mesh.positions[i + 2] - mesh.positions[i]);
    EXPECT_NEAR(glm::length(area), 0.0f, 1e-3f);
}

TEST(ScaleFigure, isRemovedWithoutATrace)
{
    render::StageMesh mesh = soil();
    const render::StageMesh before = mesh;
    render::addScaleFigure(mesh, {});
    render::addScaleFigure(mesh, {{1.0f, 0.0f, 0.0f}, 0.0f});
    EXPECT_GT(mesh.positions.size(), before.positions.size());
    render::removeScaleFigures(mesh);
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_EQ(mesh.normals, before.normals);
    EXPECT_EQ(mesh.colors, before.colors);
    EXPECT_EQ(mesh.figureVertices, 0u);
}

// The sun stands 26.6 degrees high in +x: the shadow is 3.6 m long towards -x.
TEST_F(ScaleFigureTest, castsItsShadowOnWideSoilAndOnNothingElse)
{
    render::StageMesh with = soil();
    render::addScaleFigure(with, {});
    const auto share = [&](const glm::dvec3& point) {
        return groundAt(with, point) / groundAt(soil(), point);
    };
    EXPECT_LT(share({-2.0, 0.0, 0.0}), 0.7f); // of the trunk
    for (const glm::dvec3& lit : {glm::dvec3(-4.5, 0, 0), glm::dvec3(1.0, 0, 0), glm::dvec3(-2.0, 0, 1.2),
                                  glm::dvec3(-2.0, 0, -1.2), glm::dvec3(-40, 0, 0), glm::dvec3(60, 0, 7)})
        EXPECT_NEAR(share(lit), 1.0f, 1e-3f) << lit.x << " " << lit.z;
}

// A board of 1 m by 1 m across the light, on the ground: its shadow is 2 m long.
TEST_F(ScaleFigureTest, andPropsCastShadowsOnWideSoilTogether)
{
    render::StageMesh board;
    for (const glm::vec3& p : {glm::vec3(0, 0, -0.5f), glm::vec3(0, 1, -0.5f), glm::vec3(0, 1, 0.5f),
                               glm::vec3(0, 0, -0.5f), glm::vec3(0, 1, 0.5f), glm::vec3(0, 0, 0.5f)})
        board.positions.push_back(p);
    board.normals.assign(6, {1, 0, 0});
    board.colors.assign(6, glm::vec3(0.5f));
    render::StageMesh with = soil();
    render::addStageProps(with, board, {{6, 0, 3}, 0.0f, 1.0f});
    render::addScaleFigure(with, {});
    const auto share = [&](const glm::dvec3& point) {
        return groundAt(with, point) / groundAt(soil(), point);
    };
    EXPECT_LT(share({5.0, 0.0, 3.0}), 0.05f); // of the board
    EXPECT_LT(share({-2.0, 0.0, 0.0}), 0.7f); // of the figure
    for (const glm::dvec3& lit : {glm::dvec3(6.5, 0, 3), glm::dvec3(3.5, 0, 3), glm::dvec3(5, 0, 4)})
        EXPECT_NEAR(share(lit), 1.0f, 1e-3f) << lit.x << " " << lit.z;
}
