// Things that stand on a stage: their place, and who counts them.
#include "rendering/stage/scale_figure.h"
#include "rendering/stage/stage_props.h"

#include <gtest/gtest.h>

using namespace fx;

namespace {

/// A triangle with corners of its own, whose normal is +z.
render::StageMesh triangle(const glm::vec3& color)
{
    render::StageMesh mesh;
    mesh.positions = {{0, 0, 1}, {2, 0, 1}, {0, 3, 1}};
    mesh.normals = {3, {0, 0, 1}};
    mesh.colors = {3, color};
    return mesh;
}

} // namespace

TEST(StageProps, areScaledThenTurnedThenMoved)
{
    render::StageMesh mesh;
    render::addStageProps(mesh, triangle(glm::vec3(0.5f)), {{10, 20, 30}, 90.0f, 2.0f});
    const glm::vec3 want[] = {{12, 20, 30}, {12, 20, 26}, {12, 26, 30}}; // 90 degrees turn +z to +x, +x to -z
    ASSERT_EQ(mesh.positions.size(), 3u);
    for (size_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(mesh.positions[i][axis], want[i][axis], 1e-5f) << i << " " << axis;
            EXPECT_NEAR(mesh.normals[i][axis], axis == 0 ? 1.0f : 0.0f, 1e-6f);
        }
}

TEST(StageProps, lieBetweenFiguresAndStageAndStayWithoutTheFigure)
{
    const glm::vec3 stageColor(0.1f), propColor(0.9f);
    render::StageMesh mesh = triangle(stageColor);
    render::addScaleFigure(mesh, {});
    render::addStageProps(mesh, triangle(propColor), {});
    const size_t figure = mesh.figureVertices;
    EXPECT_EQ(mesh.propVertices, 3u);
    EXPECT_EQ(mesh.addedVertices(), figure + 3);
    ASSERT_EQ(mesh.colors.size(), figure + 6);
    EXPECT_EQ(mesh.colors[figure], propColor);
    EXPECT_EQ(mesh.colors[figure + 3], stageColor);
    render::removeScaleFigures(mesh);
    ASSERT_EQ(mesh.colors.size(), 6u);
    EXPECT_EQ(mesh.colors[0], propColor);
    EXPECT_EQ(mesh.addedVertices(), 3u);
}
