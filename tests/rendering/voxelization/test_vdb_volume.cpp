#include "rendering/vdb/vdb_volume.h"

#include <gtest/gtest.h>

#if FX_HAS_OPENVDB

#include "tests/rendering/voxelization/voxel_sums.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <cmath>
#include <sstream>

namespace fx::render {
namespace {

constexpr double kVoxel = 0.1; // [m]

std::vector<VoxelBall> balls()
{
    std::vector<VoxelBall> list(3);
    const glm::dvec3 centers[] = {{-1.03, 0.51, 0.27}, {0.4, 0.8, -2.2}, {5.0, -3.0, 1.0}};
    const double radii[] = {0.9, 0.02, 0.3};
    for (size_t i = 0; i < 3; ++i) {
        list[i].center = centers[i];
        list[i].radius = radii[i];
        list[i].crossSection = 1.0 + double(i);
        list[i].temperature = 500.0 * double(i + 1);
        list[i].luminance = 7.0;
        list[i].age = 0.5 + double(i);
        list[i].albedo = {0.25, 0.125 * double(i), 0.75};
        list[i].velocity = {1.0, double(i), -2.0};
        list[i].id = 100 + i;
        list[i].instance = 7;
    }
    return list;
}

std::string fileOf(const std::vector<VoxelBall>& list, bool half)
{
    VdbVolume volume(kVoxel);
    volume.add(voxelize(list, kVoxel));
    volume.addPoints(list);
    const auto bytes =
        volume.encode({{"source", std::string("a test")}, {"time", 0.5}, {"seed", int64_t(9)}}, half);
    EXPECT_TRUE(bytes.ok()) << bytes.status().message();
    return *bytes;
}

struct ReadBack
{
    openvdb::GridPtrVecPtr grids;
    openvdb::MetaMap::Ptr metadata;

    explicit ReadBack(const std::string& bytes)
    {
        std::istringstream input(bytes);
        openvdb::io::Stream stream(input);
        grids = stream.getGrids();
        metadata = stream.getMetadata();
    }

    template <class Grid>
    typename Grid::Ptr grid(const std::string& name) const
    {
        for (const auto& grid : *grids)
            if (grid->getName() == name)
                return openvdb::gridPtrCast<Grid>(grid);
        return nullptr;
    }
};

TEST(VdbVolume, whatOpenVdbReadsHasTheMassCenterHeatLightAndMomentumOfTheBalls)
{
    for (const bool half : {false, true}) {
        const double near = half ? 5e-4 : 1e-5;
        const auto list = balls();
        const ReadBack file(fileOf(list, half));
        const auto density = file.grid<openvdb::FloatGrid>("density");
        const auto temperature = file.grid<openvdb::FloatGrid>("temperature");
        const auto flame = file.grid<openvdb::FloatGrid>("flame");
        const auto velocity = file.grid<openvdb::Vec3SGrid>("v");
        ASSERT_TRUE(density && temperature && flame && velocity);
        const double volume = density->transform().voxelVolume();
        EXPECT_NEAR(volume, 1e-3, 1e-12);
        openvdb::Vec3d moment(0.0), momentum(0.0);
        double mass = 0.0, heat = 0.0, light = 0.0;
        for (auto value = density->cbeginValueOn(); value; ++value) {
            const openvdb::Coord at = value.getCoord();
            const double part = double(*value) * volume;
            mass += part;
            moment += part * density->indexToWorld(at);
            heat += part * double(temperature->tree().getValue(at));
            light += double(flame->tree().getValue(at)) * volume;
            momentum += part * openvdb::Vec3d(velocity->tree().getValue(at));
        }
        EXPECT_NEAR(mass, 6.0, 6.0 * near);
        EXPECT_NEAR(heat, 500.0 + 2000.0 + 4500.0, 7000.0 * near);
        EXPECT_NEAR(light, 42.0, 42.0 * near);
        openvdb::Vec3d exactMoment(0.0), exactMomentum(0.0);
        for (const VoxelBall& ball : list) {
            exactMoment += ball.crossSection * openvdb::Vec3d(ball.center.x, ball.center.y, ball.center.z);
            exactMomentum +=
                ball.crossSection * openvdb::Vec3d(ball.velocity.x, ball.velocity.y, ball.velocity.z);
        }
        EXPECT_NEAR((moment - exactMoment).length(), 0.0, 20.0 * near);
        EXPECT_NEAR((momentum - exactMomentum).length(), 0.0, 20.0 * near);
    }
}

TEST(VdbVolume, theBoxOfActiveVoxelsIsThatOfTheBalls)
{
    const ReadBack file(fileOf(balls(), false));
    const openvdb::CoordBBox box = file.grid<openvdb::FloatGrid>("density")->evalActiveVoxelBoundingBox();
    const double low[] = {-1.93, -3.3, -2.22}, high[] = {5.3, 1.41, 1.3};
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR(box.min()[a] * kVoxel, low[a], 1.01 * kVoxel);
        EXPECT_NEAR(box.max()[a] * kVoxel, high[a], 1.01 * kVoxel);
    }
}

TEST(VdbVolume, allGridsHaveTheSameActiveVoxelsAndSaySomethingOfThemselves)
{
    VdbVolume volume(kVoxel);
    volume.add(voxelize(balls(), kVoxel));
    const ReadBack file(fileOf(balls(), false));
    const auto density = file.grid<openvdb::FloatGrid>("density");
    EXPECT_EQ(density->activeVoxelCount(), volume.voxels());
    EXPECT_TRUE(density->tree().hasSameTopology(file.grid<openvdb::FloatGrid>("temperature")->tree()));
    EXPECT_TRUE(density->tree().hasSameTopology(file.grid<openvdb::FloatGrid>("flame")->tree()));
    EXPECT_TRUE(density->tree().hasSameTopology(file.grid<openvdb::Vec3SGrid>("v")->tree()));
    EXPECT_EQ(density->getGridClass(), openvdb::GRID_FOG_VOLUME);
    EXPECT_EQ(density->metaValue<std::string>("unit"), "1/m");
    EXPECT_EQ(file.metadata->metaValue<std::string>("source"), "a test");
    EXPECT_EQ(file.metadata->metaValue<double>("time"), 0.5);
    EXPECT_EQ(file.metadata->metaValue<int64_t>("seed"), 9);
}

TEST(VdbVolume, pointsHaveWhatTheirBallsHave)
{
    const auto list = balls();
    const ReadBack file(fileOf(list, false));
    const auto points = file.grid<openvdb::points::PointDataGrid>("points");
    ASSERT_TRUE(points);
    size_t found = 0;
    for (auto leaf = points->tree().cbeginLeaf(); leaf; ++leaf) {
        const openvdb::points::AttributeHandle<openvdb::Vec3f> place(leaf->constAttributeArray("P"));
        const openvdb::points::AttributeHandle<openvdb::Vec3f> velocity(leaf->constAttributeArray("v"));
        const openvdb::points::AttributeHandle<int64_t> id(leaf->constAttributeArray("id"));
        const openvdb::points::AttributeHandle<float> radius(leaf->constAttributeArray("pscale"));
        const openvdb::points::AttributeHandle<float> age(leaf->constAttributeArray("age"));
        const openvdb::points::AttributeHandle<openvdb::Vec3f> color(leaf->constAttributeArray("Cd"));
        for (auto index = leaf->beginIndexOn(); index; ++index, ++found) {
            const openvdb::Vec3d world =
                points->indexToWorld(openvdb::Vec3d(place.get(*index)) + index.getCoord().asVec3d());
            ASSERT_GE(id.get(*index), 100);
            ASSERT_LT(id.get(*index), 103);
            const VoxelBall& ball = list[size_t(id.get(*index) - 100)];
            EXPECT_NEAR((world - openvdb::Vec3d(ball.center.x, ball.center.y, ball.center.z)).length(), 0.0,
                        1e-6);
            EXPECT_EQ(velocity.get(*index)[1], float(ball.velocity.y));
            EXPECT_EQ(radius.get(*index), float(ball.radius));
            EXPECT_EQ(age.get(*index), float(ball.age));
            EXPECT_EQ(color.get(*index)[1], float(ball.albedo.y));
        }
    }
    EXPECT_EQ(found, list.size());
}

TEST(VdbVolume, equalContentGivesEqualFiles)
{
    EXPECT_EQ(fileOf(balls(), false), fileOf(balls(), false));
    auto other = balls();
    other[0].luminance = 8.0;
    EXPECT_NE(fileOf(balls(), false), fileOf(other, false));
}

TEST(VdbVolume, valuesBeyondHalfFloatsStayFinite)
{
    auto list = balls();
    list[0].luminance = 1e9;
    const ReadBack file(fileOf(list, true));
    const auto flame = file.grid<openvdb::FloatGrid>("flame");
    float most = 0.0f;
    for (auto value = flame->cbeginValueOn(); value; ++value)
        most = std::max(most, *value);
    EXPECT_TRUE(std::isfinite(most));
    EXPECT_GT(most, 65504.0f);
}

TEST(VdbVolume, aFileWithoutMediumHasItsGrids)
{
    const ReadBack file(fileOf({}, false));
    ASSERT_TRUE(file.grid<openvdb::FloatGrid>("density"));
    EXPECT_EQ(file.grid<openvdb::FloatGrid>("density")->activeVoxelCount(), 0u);
    EXPECT_TRUE(file.grid<openvdb::points::PointDataGrid>("points"));
}

} // namespace
} // namespace fx::render

#else

namespace fx::render {

TEST(VdbVolume, withoutOpenVdbThePackageIsNamed)
{
    EXPECT_EQ(vdbVersion(), "");
    EXPECT_NE(checkVdb().message().find("libopenvdb-dev"), std::string::npos);
    EXPECT_EQ(VdbVolume(1.0).encode({}, false).status().code(), base::Code::NotFound);
}

} // namespace fx::render

#endif
