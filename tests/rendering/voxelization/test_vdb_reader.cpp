#include "rendering/vdb/vdb_reader.h"
#include "rendering/vdb/vdb_volume.h"

#include <gtest/gtest.h>

#if FX_HAS_OPENVDB

#include "tests/rendering/voxelization/voxel_sums.h"

#include <glm/geometric.hpp>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

namespace fx::render {
namespace {

class VdbReader : public testing::Test
{
protected:
    void SetUp() override
    {
        openvdb::initialize();
        char folder[] = "/tmp/fx-vdb-XXXXXX";
        ASSERT_NE(mkdtemp(folder), nullptr);
        folder_ = folder;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string write(const openvdb::GridCPtrVec& grids)
    {
        const std::string path = folder_ / "a.vdb";
        openvdb::io::File(path).write(grids);
        return path;
    }

    static openvdb::FloatGrid::Ptr fog(const char* name = "density")
    {
        auto grid = openvdb::FloatGrid::create();
        grid->setName(name);
        grid->setGridClass(openvdb::GRID_FOG_VOLUME);
        return grid;
    }

    std::filesystem::path folder_;
};

TEST_F(VdbReader, voxelsOfARotatedLatticeOfUnequalSidesAreWhereOpenVdbHasThem)
{
    auto grid = fog();
    openvdb::math::Mat4d matrix = openvdb::math::Mat4d::identity();
    matrix.preScale(openvdb::Vec3d(0.5, 0.2, 1.5));
    matrix.postRotate(openvdb::math::Y_AXIS, 0.7);
    matrix.postTranslate(openvdb::Vec3d(3.0, -2.0, 11.0));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    const openvdb::Coord voxel(-9, 30, 4);
    grid->tree().setValue(voxel, 3.0f);
    const auto read = readVdb(write({grid}), {});
    ASSERT_TRUE(read.ok()) << read.status().message();
    const MediumGridSums sums = sumsOf(*read);
    const openvdb::Vec3d place = grid->indexToWorld(voxel);
    EXPECT_EQ(sums.voxels, 1u);
    EXPECT_EQ(sums.low, glm::ivec3(-9, 30, 4));
    for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(sums.center[a], place[a], 1e-9);
    EXPECT_NEAR(sums.crossSection, 3.0 * 0.5 * 0.2 * 1.5, 1e-6);
}

TEST_F(VdbReader, ballsBesideTheVoxelsAreReadAsTheyWereWritten)
{
    std::vector<VoxelBall> balls(3);
    for (size_t i = 0; i < balls.size(); ++i) {
        const double n = double(i);
        balls[i] = {.center = {0.3 + n, -7.0, 2.25 * n},
                    .radius = 0.01 + 0.5 * n,
                    .crossSection = 0.25 + n,
                    .temperature = 1500.0 + n,
                    .luminance = 4e4 + n,
                    .luminanceRate = -40.0 * n,
                    .age = 0.125 * n,
                    .velocity = {1.0, -2.0 * n, 3.0},
                    .albedo = {0.25, 0.5, 0.75},
                    .streak = {0.5, 0.0, -0.25 * n},
                    .id = (uint64_t(3) << 40) + 5 - i,
                    .instance = 2};
    }
    VdbVolume volume(0.1);
    VoxelBlock block{};
    block.density[0] = 1.0f;
    volume.add(std::span(&block, 1));
    volume.addPoints(balls, true);
    const auto bytes = volume.encode({}, false);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    const std::string path = folder_ / "balls.vdb";
    std::ofstream(path, std::ios::binary) << *bytes;
    VdbReadOptions options;
    options.lengthScale = 2.0;
    const auto read = readVdb(path, options);
    ASSERT_TRUE(read.ok()) << read.status().message();
    ASSERT_EQ(read->balls.size(), balls.size());
    for (size_t i = 0; i < balls.size(); ++i) {
        const VoxelBall &found = read->balls[2 - i], &wanted = balls[i]; // rising by their ids
        EXPECT_EQ(found.id, wanted.id);
        EXPECT_EQ(found.instance, wanted.instance);
        EXPECT_LT(glm::length(found.center - 2.0 * wanted.center), 1e-6);
        EXPECT_NEAR(found.radius, 2.0 * wanted.radius, 1e-6);
        EXPECT_NEAR(found.crossSection, 8.0 * wanted.crossSection, 1e-5);
        EXPECT_NEAR(found.temperature, wanted.temperature, 1e-3);
        EXPECT_NEAR(found.luminance, wanted.luminance, 1e-2);
        EXPECT_EQ(found.luminanceRate, wanted.luminanceRate);
        EXPECT_EQ(found.age, wanted.age);
        EXPECT_LT(glm::length(found.velocity - 2.0 * wanted.velocity), 1e-6);
        EXPECT_EQ(found.albedo, wanted.albedo);
        EXPECT_LT(glm::length(found.streak - 2.0 * wanted.streak), 1e-6);
    }
    const auto carried = mediumGridFromBytes(toBytes(*read));
    ASSERT_TRUE(carried.ok()) << carried.status().message();
    EXPECT_EQ(carried->balls.size(), balls.size());
    EXPECT_EQ(carried->balls[1].streak, read->balls[1].streak);
    MediumGrid damaged = *read;
    damaged.balls[0].radius = 0.0;
    EXPECT_FALSE(mediumGridFromBytes(toBytes(damaged)).ok());
    damaged = *read;
    damaged.balls[0].age = -1.0;
    EXPECT_FALSE(mediumGridFromBytes(toBytes(damaged)).ok());
}

TEST_F(VdbReader, theMeanCosineIsThatOfTheMetadataUnlessOneIsGiven)
{
    const auto readWith = [&](std::optional<double> stated, std::optional<double> given) {
        VdbVolume volume(0.1);
        VoxelBlock block{};
        block.density.fill(1.0f);
        volume.add(std::span(&block, 1));
        VdbMetadata metadata;
        if (stated)
            metadata.emplace_back("anisotropy", *stated);
        const auto bytes = volume.encode(metadata, false);
        EXPECT_TRUE(bytes.ok());
        const std::filesystem::path path = folder_ / "g.vdb";
        std::ofstream(path, std::ios::binary) << *bytes;
        VdbReadOptions options;
        options.anisotropy = given;
        auto read = readVdb(path, options);
        EXPECT_TRUE(read.ok());
        return std::move(*read);
    };
    EXPECT_EQ(readWith({}, {}).anisotropy, 0.0);
    EXPECT_EQ(readWith(0.6, {}).anisotropy, 0.6);
    EXPECT_EQ(readWith(0.6, -0.2).anisotropy, -0.2);
    EXPECT_EQ(readWith(0.99, {}).anisotropy, kMostAnisotropy);
    EXPECT_EQ(readWith(3.0, {}).anisotropy, 0.0);
    EXPECT_EQ(readWith(3.0, {}).warnings.size(), 1u);
    MediumGrid grid = readWith(0.6, {});
    EXPECT_EQ(mediumGridFromBytes(toBytes(grid))->anisotropy, 0.6);
    grid.anisotropy = 0.97;
    EXPECT_FALSE(mediumGridFromBytes(toBytes(grid)).ok());
}

TEST_F(VdbReader, pointsWithoutAMediumAreNone)
{
    VdbVolume volume(0.1);
    VoxelBlock block{};
    block.density[0] = 1.0f;
    volume.add(std::span(&block, 1));
    volume.addPoints(std::vector<VoxelBall>{{.radius = 1.0, .crossSection = 1.0}});
    const auto bytes = volume.encode({}, false);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    const std::string path = folder_ / "points.vdb";
    std::ofstream(path, std::ios::binary) << *bytes;
    const auto read = readVdb(path, {});
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_TRUE(read->balls.empty());
}

TEST_F(VdbReader, aLevelSetHasTheVolumeOfItsInside)
{
    for (const float voxel : {0.1f, 0.05f}) {
        auto ball =
            openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, {0.3f, -0.2f, 0.1f}, voxel);
        ball->setName("density");
        VdbReadOptions options;
        options.densityScale = 2.5;
        const auto read = readVdb(write({ball}), options);
        ASSERT_TRUE(read.ok()) << read.status().message();
        const MediumGridSums sums = sumsOf(*read);
        EXPECT_NEAR(sums.crossSection, 2.5 * 4.0 / 3.0 * std::numbers::pi, 0.01 * sums.crossSection);
        EXPECT_NEAR(sums.largestDensity, 2.5, 1e-6);
        EXPECT_LT(glm::length(sums.center - glm::dvec3(0.3, -0.2, 0.1)), 0.01 * double(voxel));
    }
}

TEST_F(VdbReader, tilesCountAsTheirVoxels)
{
    auto grid = fog();
    grid->fill(openvdb::CoordBBox({0, 0, 0}, {15, 7, 7}), 0.5f, true);
    ASSERT_GT(grid->tree().activeTileCount(), 0u);
    const auto read = readVdb(write({grid}), {});
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(sumsOf(*read).voxels, 16u * 8u * 8u);
    EXPECT_EQ(read->blocks.size(), 2u);
}

TEST_F(VdbReader, gridsOfOtherLatticesAreInterpolated)
{
    auto density = fog();
    density->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    density->fill(openvdb::CoordBBox({0, 0, 0}, {9, 9, 9}), 1.0f, true);
    auto temperature = fog("temperature");
    temperature->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    for (int x = -2; x < 8; ++x) // linear in x
        for (int y = -2; y < 8; ++y)
            for (int z = -2; z < 8; ++z)
                temperature->tree().setValue({x, y, z}, 1000.0f + 100.0f * float(x));
    const auto read = readVdb(write({density, temperature}), {});
    ASSERT_TRUE(read.ok()) << read.status().message();
    for (int x = 0; x < 8; ++x)
        EXPECT_NEAR(read->temperature[voxelInBlock(x, 3, 5)], 1000.0 + 400.0 * 0.1 * x, 1e-3);
}

TEST_F(VdbReader, exportedVolumesAreReadBack)
{
    std::vector<VoxelBall> balls(2);
    balls[0].center = {0.4, 1.0, -2.0};
    balls[0].radius = 0.5;
    balls[0].crossSection = 1.5;
    balls[0].temperature = 900.0;
    balls[0].luminance = 20.0;
    balls[0].luminanceRate = -12.0;
    balls[0].velocity = {1.0, 2.0, -3.0};
    balls[1] = balls[0];
    balls[1].center.x = 3.0;
    const auto blocks = voxelize(balls, 0.1);
    for (const bool isHalf : {false, true}) {
        VdbVolume volume(0.1);
        volume.add(blocks);
        const auto bytes = volume.encode({}, isHalf);
        ASSERT_TRUE(bytes.ok());
        const std::string path = folder_ / "b.vdb";
        std::ofstream(path, std::ios::binary) << *bytes;
        const auto read = readVdb(path, {});
        ASSERT_TRUE(read.ok()) << read.status().message();
        const MediumGridSums sums = sumsOf(*read);
        const double allowed = isHalf ? 1e-3 : 1e-5;
        EXPECT_EQ(sums.voxels, volume.voxels());
        EXPECT_NEAR(sums.crossSection, 3.0, 3.0 * allowed);
        EXPECT_NEAR(sums.center.x, 1.7, 0.1 * allowed); // the tent filter keeps the center
        EXPECT_NEAR(sums.center.y, 1.0, 0.1 * allowed);
        EXPECT_NEAR(sums.center.z, -2.0, 0.1 * allowed);
        EXPECT_NEAR(sums.temperature, 900.0, 900.0 * allowed);
        EXPECT_NEAR(sums.luminousVolume, 60.0, 60.0 * allowed);
        const auto most = std::ranges::max_element(read->density) - read->density.begin();
        EXPECT_NEAR(read->velocity[size_t(most)].z, -3.0, 3.0 * allowed);
        EXPECT_NEAR(read->flameRate[size_t(most)], -12.0, 12.0 * allowed);
        EXPECT_EQ(mediumGridFromBytes(toBytes(*read))->flameRate, read->flameRate);
    }
}

TEST_F(VdbReader, numbersThatAreNoneBecomeZeroWithAWarning)
{
    auto grid = fog();
    grid->tree().setValue({0, 0, 0}, std::numeric_limits<float>::quiet_NaN());
    grid->tree().setValue({0, 0, 1}, -1.0f);
    grid->tree().setValue({0, 0, 2}, 4.0f);
    const auto read = readVdb(write({grid}), {});
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(sumsOf(*read).voxels, 1u);
    ASSERT_EQ(read->warnings.size(), 1u);
    EXPECT_NE(read->warnings[0].find("2 voxels"), std::string::npos);
}

TEST_F(VdbReader, ratesOutOfTheirRangeBecomeZeroWithAWarning)
{
    auto grid = fog();
    auto rate = fog("flame_rate");
    for (int x = 0; x < 4; ++x) {
        grid->tree().setValue({x, 0, 0}, 1.0f);
        rate->tree().setValue({x, 0, 0}, std::array{-5.0f, 5000.0f, std::nanf(""), -5000.0f}[size_t(x)]);
    }
    const auto read = readVdb(write({grid, rate}), {});
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->flameRate[voxelInBlock(0, 0, 0)], -5.0f);
    for (int x = 1; x < 4; ++x)
        EXPECT_EQ(read->flameRate[voxelInBlock(x, 0, 0)], 0.0f) << x;
    ASSERT_EQ(read->warnings.size(), 1u);
    EXPECT_NE(read->warnings[0].find("3 voxels of \"flame_rate\""), std::string::npos);
    MediumGrid fast = *read;
    fast.flameRate[0] = 5000.0f;
    EXPECT_FALSE(mediumGridFromBytes(toBytes(fast)).ok());
}

TEST_F(VdbReader, whatIsNotSupportedIsRefusedByName)
{
    auto frustum = fog();
    frustum->tree().setValue({0, 0, 0}, 1.0f);
    frustum->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 1.0, 0.1));
    auto read = readVdb(write({frustum}), {});
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.status().message().find("frustum"), std::string::npos);

    auto vectors = openvdb::Vec3SGrid::create();
    vectors->setName("density");
    read = readVdb(write({vectors}), {});
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.status().code(), base::Code::Schema);

    read = readVdb(write({fog("smoke")}), {});
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.status().code(), base::Code::NotFound);
    EXPECT_NE(read.status().message().find("\"smoke\""), std::string::npos);
}

TEST_F(VdbReader, sizesThatAreStatedAndThoseThatAreNotAreLimited)
{
    auto grid = fog();
    grid->fill(openvdb::CoordBBox({0, 0, 0}, {1023, 1023, 1023}), 1.0f, true); // tiles of 2^30 voxels
    for (const bool isStated : {true, false}) {
        const std::string path = folder_ / "c.vdb";
        openvdb::io::File file(path);
        file.setGridStatsMetadataEnabled(isStated);
        file.write(openvdb::GridCPtrVec{grid});
        file.close();
        const auto read = readVdb(path, {});
        ASSERT_FALSE(read.ok());
        EXPECT_EQ(read.status().code(), base::Code::TooLarge);
        EXPECT_EQ(read.status().message().find("states") != std::string::npos, isStated);
    }
}

TEST_F(VdbReader, bytesOfAGridGiveTheSameGridAndDamagedOnesNone)
{
    auto density = fog();
    density->fill(openvdb::CoordBBox({-3, 0, 0}, {9, 9, 9}), 1.0f, true);
    const auto read = readVdb(write({density}), {});
    ASSERT_TRUE(read.ok());
    const std::string bytes = toBytes(*read);
    const auto again = mediumGridFromBytes(bytes);
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->density, read->density);
    EXPECT_EQ(again->blocks, read->blocks);
    for (const size_t size : {size_t(0), size_t(7), size_t(100), bytes.size() / 2, bytes.size() - 1})
        EXPECT_FALSE(mediumGridFromBytes(std::string_view(bytes).substr(0, size)).ok()) << size;
    EXPECT_FALSE(mediumGridFromBytes(bytes + "x").ok());
}

} // namespace
} // namespace fx::render

#else

TEST(VdbReader, isAbsent)
{
    const auto read = fx::render::readVdb("a.vdb", {});
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.status().message().find("libopenvdb-dev"), std::string::npos);
}

#endif
