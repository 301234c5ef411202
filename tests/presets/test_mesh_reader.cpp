#include "fxsdk/scene_file/mesh_reader.h"
#include "tests/presets/temp_folder.h"

#include <glm/geometric.hpp>

#include <filesystem>

using namespace fx::scene_file;
using fx::base::Code;
using fx::test::TempFolder;

namespace {

/// Reads `text` as mesh.obj of a folder that also holds m.mtl.
fx::base::Result<fx::render::StageMesh> read(const std::string& text, std::string* outWarning = nullptr)
{
    const TempFolder folder;
    folder.write("mesh.obj", text);
    folder.write("m.mtl", "newmtl red\nKd 0.5 0.25 2.0\n");
    const fx::asset::AssetResolver resolver(folder.path(), {});
    std::string warning;
    auto mesh = readMesh("mesh.obj", resolver, warning);
    if (outWarning)
        *outWarning = warning;
    return mesh;
}

constexpr const char* kSquare = "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\n";

double areaOf(const fx::render::StageMesh& mesh)
{
    double area = 0;
    for (size_t i = 0; i + 2 < mesh.positions.size(); i += 3)
        area += 0.5 * glm::length(glm::cross(mesh.positions[i + 1] - mesh.positions[i],
                                             mesh.positions[i + 2] - mesh.positions[i]));
    return area;
}

} // namespace

TEST(MeshReader, cutsPolygonsIntoTrianglesOfTheSameArea)
{
    const auto mesh = read(std::string(kSquare) + "f 1 2 3 4\n");
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_EQ(mesh->positions.size(), 6u);
    EXPECT_NEAR(areaOf(*mesh), 6.0, 1e-6);
}

TEST(MeshReader, putsWaterBehindTheOtherTriangles)
{
    const TempFolder folder;
    folder.write("mesh.obj", std::string("mtllib m.mtl\n") + kSquare +
                                 "usemtl lake\nf 1 2 3 4\nusemtl red\nf 1 2 3\nusemtl glass\nf 1 2 3\n");
    folder.write("m.mtl",
                 "newmtl lake\nKd 0 0 0.5\nillum 7\nnewmtl red\nKd 1 0 0\nillum 2\nnewmtl glass\nKd 0 1 0\n");
    std::string warning;
    const auto mesh = readMesh("mesh.obj", fx::asset::AssetResolver(folder.path(), {}), warning);
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    ASSERT_EQ(mesh->colors.size(), 12u);
    EXPECT_EQ(mesh->waterVertices, 6u);
    EXPECT_EQ(mesh->colors[0], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh->colors[3], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh->colors[6], glm::vec3(0, 0, 0.5f));
    EXPECT_EQ(mesh->normals.size(), 12u);
}

TEST(MeshReader, cutsPolygonsWithInwardCornersWithoutLeavingThem)
{
    // A U of area 7, and a star whose corners turn clockwise.
    const std::string u = "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n";
    const auto mesh = read(u + "f 1 2 3 4 5 6 7 8\n");
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_EQ(mesh->positions.size(), 18u);
    EXPECT_NEAR(areaOf(*mesh), 7.0, 1e-6);
    for (const glm::vec3& normal : mesh->normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
    const auto star = read("v 0 0 2\nv 1 0 1\nv 3 0 0\nv 1 0 -1\nv 0 0 -2\nv 0.5 0 0\nf 6 5 4 3 2 1\n");
    ASSERT_TRUE(star.ok());
    EXPECT_EQ(star->positions.size(), 12u);
    EXPECT_NEAR(areaOf(*star), 4.0, 1e-6);
}

TEST(MeshReader, cutsAQuadrilateralAlongItsShorterDiagonal)
{
    const auto mesh = read("v 0 0 0\nv 4 -1 0\nv 8 0 0\nv 4 1 0\nf 1 2 3 4\n");
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->positions.at(2), glm::vec3(4, 1, 0));
    EXPECT_EQ(mesh->positions.at(3), glm::vec3(4, -1, 0));
}

TEST(MeshReader, namesTheLineThatItCannotRead)
{
    for (const char* fault : {"v 0 0\n", "v 0 x 0\n", "f 1 2\n", "f 1 2 5\n", "f 1 2 3//1\n"}) {
        const auto mesh = read(std::string(kSquare) + fault);
        ASSERT_FALSE(mesh.ok()) << fault;
        EXPECT_NE(mesh.status().message().find("mesh \"mesh.obj\": line 5: "), std::string::npos)
            << mesh.status().message();
    }
}

TEST(MeshReader, computesNormalsThatAreMissingTowardsTheSideThatSeesItCounterClockwise)
{
    const auto mesh = read(std::string(kSquare) + "f 1 2 3 4\n");
    for (const glm::vec3& normal : mesh->normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1));
}

TEST(MeshReader, keepsNormalsThatAreGivenAsUnitVectors)
{
    const auto mesh = read(std::string(kSquare) + "vn 0 3 4\nf 1//1 2//1 3//1\n");
    ASSERT_TRUE(mesh.ok());
    EXPECT_LT(glm::length(mesh->normals.at(0) - glm::vec3(0, 0.6f, 0.8f)), 1e-6f);
}

TEST(MeshReader, takesColorsFromMaterialsWithinZeroAndOne)
{
    const auto mesh = read("mtllib m.mtl\n" + std::string(kSquare) + "f 1 2 3\nusemtl red\nf 1 3 4\n");
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->colors.at(0), glm::vec3(0.5f));
    EXPECT_EQ(mesh->colors.at(3), glm::vec3(0.5f, 0.25f, 1.0f));
}

TEST(MeshReader, warnsOfMaterialsThatAreMissingOrElsewhere)
{
    for (const char* library : {"none.mtl", "../m.mtl", "/etc/passwd"}) {
        std::string warning;
        const auto mesh = read("mtllib " + std::string(library) + "\n" + kSquare + "f 1 2 3\n", &warning);
        ASSERT_TRUE(mesh.ok());
        EXPECT_FALSE(warning.empty()) << library;
        EXPECT_EQ(mesh->colors.at(0), glm::vec3(0.5f));
    }
}

TEST(MeshReader, leavesOutTrianglesWithoutArea)
{
    const auto mesh = read(std::string(kSquare) + "f 1 1 2\nf 1 2 3\n");
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->positions.size(), 3u);
}

TEST(MeshReader, refusesWhatItCannotDraw)
{
    EXPECT_FALSE(read("").ok());
    EXPECT_FALSE(read(kSquare).ok());
    EXPECT_FALSE(read(std::string(kSquare) + "f 1 2 9\n").ok());
    EXPECT_FALSE(read(std::string(kSquare) + "f 1 2 -9\n").ok());
    EXPECT_FALSE(read("v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n").ok());
    EXPECT_FALSE(read("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n").ok());
}

TEST(MeshReader, refusesFloodsOfTrianglesBeforeParsingThem)
{
    std::string text = kSquare;
    for (int i = 0; i < 1'000'001; ++i)
        text += "f 1 2 3\n";
    EXPECT_EQ(int(read(text).status().code()), int(Code::TooLarge));
    std::string face = std::string(kSquare) + "f";
    for (int i = 0; i < 1025; ++i)
        face += " 1";
    EXPECT_EQ(int(read(face + "\n").status().code()), int(Code::TooLarge));
}

TEST(MeshReader, readsTheCornellBoxWithItsSixColors)
{
    const std::string data = FX_SHARED_DATA;
    if (!std::filesystem::exists(data + "/cornell_box.obj"))
        GTEST_SKIP() << data << "/cornell_box.obj is not here";
    const fx::asset::AssetResolver resolver(data, {});
    std::string warning;
    const auto mesh = readMesh("cornell_box.obj", resolver, warning);
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_EQ(mesh->positions.size() % 3, 0u);
    fx::base::Bounds bounds;
    bool hasRed = false, hasGreen = false;
    for (size_t i = 0; i < mesh->positions.size(); ++i) {
        bounds.add(mesh->positions[i], 0);
        hasRed |= mesh->colors[i].r > 2 * mesh->colors[i].g;
        hasGreen |= mesh->colors[i].g > 2 * mesh->colors[i].r;
    }
    EXPECT_NEAR(bounds.max.x - bounds.min.x, 556, 5);
    EXPECT_NEAR(bounds.max.y, 548.8, 0.1);
    EXPECT_TRUE(hasRed && hasGreen);
}
