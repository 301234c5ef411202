#include "fxsdk/assets/obj_reader.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using fx::asset::readObj;

TEST(ObjReader, readsPositionsTexturesAndNormalsByTheirNumbers)
{
    const auto mesh =
        readObj("# a triangle\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.5\nvn 0 0 2\nf 1/1/1 2/1/1 3/1/1\n");
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    ASSERT_EQ(mesh->indices.size(), 3u);
    EXPECT_EQ(mesh->vertices[mesh->indices[1]].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh->vertices[0].texture, glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(mesh->vertices[0].normal, glm::vec3(0, 0, 1)) << "normals are made unit";
}

TEST(ObjReader, aSquareIsTwoTrianglesThatShareCorners)
{
    const auto mesh = readObj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n");
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->indices.size(), 6u);
    EXPECT_EQ(mesh->vertices.size(), 4u);
}

TEST(ObjReader, withoutNormalsEachTriangleGetsItsOwn)
{
    const auto mesh = readObj("v 0 0 0\r\nv 1 0 0\r\nv 0 0 -1\r\nf -3 -2 -1\r\n");
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    for (const auto& vertex : mesh->vertices)
        EXPECT_EQ(vertex.normal, glm::vec3(0, 1, 0));
}

TEST(ObjReader, namesTheLineOfAFault)
{
    const auto beyond = readObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    ASSERT_FALSE(beyond.ok());
    EXPECT_NE(beyond.status().message().find("line 4"), std::string::npos) << beyond.status().message();
    EXPECT_FALSE(readObj("v 0 0 nan\n").ok());
    EXPECT_FALSE(readObj("v 0 0\n").ok());
    EXPECT_FALSE(readObj("v 0 0 0\nf 1 1\n").ok());
    EXPECT_FALSE(readObj("v 0 0 0\nf 0 0 0\n").ok());
    EXPECT_FALSE(readObj("").ok());
}

TEST(ObjReader, takesSignsAndNumbersThatAreTooSmallForAFloat)
{
    const auto mesh = readObj("v +0.5 -1e-46 .25\nv 1 0 0\nv 0 1 0\nf +1 2 3\n");
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_EQ(mesh->vertices[0].position, glm::vec3(0.5f, 0.0f, 0.25f));
    EXPECT_FALSE(readObj("v 1e39 0 0\n").ok());
    EXPECT_FALSE(readObj("v +-1 0 0\n").ok());
}

TEST(ObjReader, trianglesOfTheSimulationNeedPositionsOnly)
{
    const auto mesh =
        fx::asset::readObjTriangles("v 0 0 0\r\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0\nvn\nf -4/1 -3/2/3 -2 -1\n");
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_EQ(mesh->positions.size(), 4u);
    EXPECT_EQ(mesh->indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    for (const char* wrong :
         {"f 1 2 3\n", "v 0 0 0\nf 1 1\n", "v 0 0 x\n", "v 0 0 0\nf 0 1 1\n", "v inf 0 0\n"})
        EXPECT_FALSE(fx::asset::readObjTriangles(wrong).ok()) << wrong;
}
