#include "fxsdk/presets/preset_loader.h"
#include "simulation/cloud/cloud_solver.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace fx;

namespace {

sim::BallList twoBalls()
{
    sim::BallList list(2);
    list[0] = {{1, 2, 3}, 0.5f, 2.0f, 900.0f, {0.1f, 0.2f, 0.3f}, {4, 5, 6}};
    list[1] = {{-4, 0, 0}, 2.0f, 1.0f, 293.0f, {0.8f, 0.8f, 0.8f}, {0, 0, 0}};
    return list;
}

} // namespace

TEST(BallList, isReadAsItWasWritten)
{
    const std::string bytes = sim::writeBallList(twoBalls());
    const auto read = sim::parseBallList(bytes);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(sim::writeBallList(**read), bytes);
    EXPECT_EQ((**read)[0].emission, glm::vec3(4, 5, 6));
}

TEST(BallList, damagedFilesAreRefused)
{
    const std::string bytes = sim::writeBallList(twoBalls());
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(sim::parseBallList(std::string_view(bytes).substr(0, size)).ok()) << size;
    EXPECT_FALSE(sim::parseBallList(bytes + "x").ok());
    EXPECT_FALSE(sim::parseBallList("fxballs 1\ncount 4000000000\ndata\n").ok());
    EXPECT_EQ(sim::parseBallList("fxballs 2\ncount 1\ndata\n").status().code(), base::Code::Version);
    for (size_t number = 0; number < 12; ++number) {
        std::string damaged = bytes;
        const size_t at = bytes.size() - 48 + 4 * number;
        damaged.replace(at, 4, "\xff\xff\xff\xff"); // no number
        const auto read = sim::parseBallList(damaged);
        EXPECT_FALSE(read.ok()) << number;
        EXPECT_NE(read.status().message().find("ball 1"), std::string::npos);
    }
}

TEST(Cloud, publishesTheBallsOfItsFilePlacedAndScaled)
{
    base::SnapshotSchema schema;
    schema.add(base::kBlobKind);
    sim::CloudDef def;
    def.balls = std::make_shared<sim::BallList>(twoBalls());
    def.position = {10, 20, 30};
    def.scale = 2.0f;
    def.density = 3.0f;
    const auto cloud = def.create(schema, {}, std::pmr::get_default_resource());
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    cloud->publish({}, snapshot);
    const base::SnapshotGroup& group = snapshot.group(0);
    ASSERT_EQ(group.count(), 2u);
    namespace blob = base::blob_column;
    EXPECT_EQ(group.column(blob::PositionX)[0], 12.0f);
    EXPECT_EQ(group.column(blob::PositionY)[0], 24.0f);
    EXPECT_EQ(group.column(blob::Radius)[0], 1.0f);
    EXPECT_EQ(group.column(blob::CrossSection)[0], 3.0f * 4.0f * 2.0f); // optical depth is a / R^2
    EXPECT_EQ(group.column(blob::Temperature)[0], 900.0f);
    EXPECT_EQ(group.column(blob::AlbedoG)[0], 0.2f);
    EXPECT_EQ(group.column(blob::EmissionB)[0], 6.0f);
    EXPECT_FALSE(cloud->finished(base::toTicks(1e6)));
    const float reach = def.reach(9.8f, 1.0f, 5.0f);
    EXPECT_GE(reach, glm::length(glm::vec3(12, 24, 36)) + 1.0f);
    EXPECT_LE(reach, 1.01f * (glm::length(glm::vec3(12, 24, 36)) + 1.0f));
}

TEST(Clouds, presetsWithoutAFileOrWithAnotherOneAreErrors)
{
    const auto missing = preset::loadPresetText(R"({"version": 1, "clouds": [{}]})", "t");
    ASSERT_FALSE(missing.ok());
    EXPECT_NE(missing.status().message().find("fxballs"), std::string::npos) << missing.status().message();
}
