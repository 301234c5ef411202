#include "foundation/assets/asset_table.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>
#include <vector>

using namespace fx::base;

namespace {

std::vector<uint8_t> texels(int width, int height, uint8_t first)
{
    std::vector<uint8_t> rgba(size_t(width) * size_t(height) * 4);
    for (size_t i = 0; i < rgba.size(); ++i)
        rgba[i] = uint8_t(first + i);
    return rgba;
}

const std::vector<MeshVertex> kCorners{
    {{0, 0, 0}, {0, 0, 1}, {0, 0}}, {{3, 0, 0}, {0, 0, 1}, {1, 0}}, {{0, 4, 0}, {0, 0, 1}, {0, 1}}};

class AssetTableTest : public testing::Test
{
protected:
    AssetTable table_{std::pmr::get_default_resource()};
};

} // namespace

TEST_F(AssetTableTest, handsBackWhatWasPutIn)
{
    const auto id = table_.addImage(3, 2, false, texels(3, 2, 9));
    ASSERT_TRUE(id.ok());
    EXPECT_GT(*id, 0u);
    const ImageAsset* image = table_.image(*id);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 3);
    EXPECT_EQ(image->height, 2);
    EXPECT_FALSE(image->isSrgb);
    EXPECT_EQ(std::vector<uint8_t>(image->rgba.begin(), image->rgba.end()), texels(3, 2, 9));
    EXPECT_FALSE(table_.mesh(*id)) << "an image is no mesh";
}

TEST_F(AssetTableTest, equalContentIsHeldOnce)
{
    const auto a = table_.addImage(4, 4, true, texels(4, 4, 1));
    const auto b = table_.addImage(4, 4, true, texels(4, 4, 1));
    EXPECT_EQ(*a, *b);
    EXPECT_EQ(table_.bytes(), 64u);
    EXPECT_NE(*a, *table_.addImage(4, 4, false, texels(4, 4, 1))) << "the curve of its color belongs to it";
    EXPECT_NE(*a, *table_.addImage(2, 8, true, texels(4, 4, 1))) << "and so does its shape";
    EXPECT_NE(*a, *table_.addImage(4, 4, true, texels(4, 4, 2)));
    const std::vector<uint32_t> face{0, 1, 2};
    EXPECT_EQ(*table_.addMesh(kCorners, face), *table_.addMesh(kCorners, face));
}

TEST_F(AssetTableTest, aMeshReachesAsFarAsItsFarthestVertex)
{
    const std::vector<uint32_t> face{0, 1, 2};
    const auto id = table_.addMesh(kCorners, face);
    EXPECT_EQ(table_.mesh(*id)->reach, 4.0f);
}

TEST_F(AssetTableTest, refusesWhatDoesNotFitAndStaysAsItWas)
{
    EXPECT_EQ(table_.addImage(0, 4, true, {}).status().code(), Code::InvalidArgument);
    EXPECT_EQ(table_.addImage(4, 4, true, texels(4, 3, 0)).status().code(), Code::InvalidArgument);
    EXPECT_EQ(
        table_.addImage(AssetTable::kLargestSide + 1, 1, true, texels(AssetTable::kLargestSide + 1, 1, 0))
            .status()
            .code(),
        Code::InvalidArgument);
    EXPECT_FALSE(table_.addMesh(kCorners, std::vector<uint32_t>{}).ok());
    EXPECT_FALSE(table_.addMesh(kCorners, std::vector<uint32_t>{0, 1}).ok());
    EXPECT_FALSE(table_.addMesh(kCorners, std::vector<uint32_t>{0, 1, 3}).ok());
    auto broken = kCorners;
    broken[1].position.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(table_.addMesh(broken, std::vector<uint32_t>{0, 1, 2}).ok());
    EXPECT_EQ(table_.size(), 0u);
    EXPECT_FALSE(table_.image(0));
    EXPECT_FALSE(table_.image(1));
    EXPECT_FALSE(table_.image(~0u));
}

TEST_F(AssetTableTest, whenItIsFullItSaysSo)
{
    for (uint32_t i = 0; i < AssetTable::kMaxAssets; ++i) {
        const uint8_t texel[4] = {uint8_t(i), uint8_t(i >> 8), 0, 255};
        ASSERT_TRUE(table_.addImage(1, 1, true, texel).ok());
    }
    const uint8_t another[4] = {0, 0, 1, 255};
    EXPECT_EQ(table_.addImage(1, 1, true, another).status().code(), Code::Capacity);
    const uint8_t known[4] = {7, 0, 0, 255};
    EXPECT_EQ(*table_.addImage(1, 1, true, known), 8u) << "what it has it still finds";
}

TEST_F(AssetTableTest, readersSeeWholeAssetsWhileOthersAreAdded)
{
    std::atomic<bool> stop{false};
    std::atomic<int> wrong{0};
    std::thread reader([&] {
        while (!stop)
            for (uint32_t id = 1; id <= table_.size(); ++id)
                if (const ImageAsset* image = table_.image(id); !image || image->rgba.size() != 64)
                    ++wrong;
    });
    std::vector<std::thread> writers;
    for (int w = 0; w < 2; ++w)
        writers.emplace_back([&] {
            for (int i = 0; i < 200; ++i)
                (void)table_.addImage(4, 4, true, texels(4, 4, uint8_t(i)));
        });
    for (std::thread& writer : writers)
        writer.join();
    stop = true;
    reader.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(table_.size(), 200u);
}

TEST_F(AssetTableTest, forgetsTheNewestAssetsAndCountsTheirIdsAgain)
{
    const auto kept = table_.addImage(2, 2, true, texels(2, 2, 1));
    const std::vector<uint32_t> face{0, 1, 2};
    const auto mesh = table_.addMesh(kCorners, face);
    const auto image = table_.addImage(4, 4, true, texels(4, 4, 1));
    ASSERT_TRUE(kept.ok() && mesh.ok() && image.ok());
    table_.truncate(table_.size());
    EXPECT_EQ(table_.size(), 3u);
    table_.truncate(1);
    EXPECT_EQ(table_.size(), 1u);
    EXPECT_EQ(table_.bytes(), 16u);
    EXPECT_TRUE(table_.image(*kept));
    EXPECT_FALSE(table_.mesh(*mesh));
    EXPECT_FALSE(table_.image(*image));
    EXPECT_EQ(*table_.addImage(4, 4, true, texels(4, 4, 1)), 2u);
    EXPECT_EQ(*table_.addImage(2, 2, true, texels(2, 2, 1)), *kept);
}
