#include "fxsdk/assets/asset_loader.h"
#include "tests/presets/small_png.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

using namespace fx;
using asset::ImageUse;
using asset::MissingAsset;
using fx::test::smallPng;

namespace {

/// A host that holds a few assets in memory.
struct Host
{
    std::map<std::string, std::string> files;

    static int read(void* user, const char* name, uint64_t maxBytes,
                    void (*deliver)(void*, const void*, size_t), void* sink)
    {
        const auto& files = static_cast<Host*>(user)->files;
        const auto found = files.find(name);
        if (found == files.end())
            return 1;
        if (found->second.size() > maxBytes)
            return 2;
        deliver(sink, found->second.data(), found->second.size());
        return 0;
    }
};

class AssetLoaderTest : public testing::Test
{
protected:
    AssetLoaderTest()
    {
        host_.files = {{"two.png", smallPng()},
                       {"broken.png", smallPng().substr(0, 50)},
                       {"tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                       {"bad.obj", "f 1 2 3\n"}};
    }

    Host host_;
    base::AssetTable table_{std::pmr::get_default_resource()};
    asset::AssetResolver resolver_{"", {}, {&host_, &Host::read}};
    asset::AssetLoader strict_{resolver_, table_, MissingAsset::IsAnError};
    asset::AssetLoader lenient_{resolver_, table_, MissingAsset::ShowsPlaceholder};
    std::string warning_;
};

} // namespace

TEST_F(AssetLoaderTest, readsAnImageWithItsOpacity)
{
    const auto id = strict_.image("two.png", ImageUse::Color, 1, 1, warning_);
    ASSERT_TRUE(id.ok()) << id.status().message();
    const base::ImageAsset* image = table_.image(*id);
    EXPECT_EQ(std::vector<uint8_t>(image->rgba.begin(), image->rgba.end()),
              (std::vector<uint8_t>{255, 0, 0, 255, 0, 0, 255, 128}));
    EXPECT_TRUE(image->isSrgb);
    EXPECT_FALSE(table_.image(*strict_.image("two.png", ImageUse::Numbers, 1, 1, warning_))->isSrgb);
    EXPECT_TRUE(warning_.empty());
}

TEST_F(AssetLoaderTest, twoNamesOfOneContentAreOneAsset)
{
    host_.files["copy.png"] = smallPng();
    EXPECT_EQ(*strict_.image("two.png", ImageUse::Color, 2, 1, warning_),
              *strict_.image("copy.png", ImageUse::Color, 1, 1, warning_));
}

TEST_F(AssetLoaderTest, readsAMesh)
{
    const auto id = strict_.mesh("tri.obj", warning_);
    ASSERT_TRUE(id.ok()) << id.status().message();
    EXPECT_EQ(table_.mesh(*id)->indices.size(), 3u);
}

TEST_F(AssetLoaderTest, faultsNameTheAssetAndWhatToDo)
{
    const auto uneven = strict_.image("two.png", ImageUse::Color, 3, 1, warning_);
    ASSERT_FALSE(uneven.ok());
    EXPECT_EQ(uneven.status().code(), base::Code::Schema);
    EXPECT_NE(uneven.status().message().find("two.png"), std::string::npos);
    EXPECT_NE(uneven.status().message().find("correct the numbers of frames"), std::string::npos);
    EXPECT_EQ(strict_.image("none.png", ImageUse::Color, 1, 1, warning_).status().code(),
              base::Code::NotFound);
    EXPECT_EQ(strict_.image("broken.png", ImageUse::Color, 1, 1, warning_).status().code(),
              base::Code::Parse);
    EXPECT_EQ(strict_.image("../two.png", ImageUse::Color, 1, 1, warning_).status().code(),
              base::Code::InvalidArgument);
    const auto bad = strict_.mesh("bad.obj", warning_);
    EXPECT_EQ(bad.status().code(), base::Code::Parse);
    EXPECT_NE(bad.status().message().find("bad.obj"), std::string::npos);
    EXPECT_EQ(table_.size(), 0u);
}

TEST_F(AssetLoaderTest, aLenientLoaderShowsThatSomethingIsMissing)
{
    const auto image = lenient_.image("none.png", ImageUse::Color, 4, 4, warning_);
    ASSERT_TRUE(image.ok());
    EXPECT_NE(warning_.find("none.png"), std::string::npos);
    const base::ImageAsset* shown = table_.image(*image);
    EXPECT_EQ(shown->width % 4, 0) << "frames of any usual number divide it";
    EXPECT_EQ(shown->rgba[0], 255);
    EXPECT_EQ(shown->rgba[1], 0);
    EXPECT_EQ(shown->rgba[2], 255);
    const auto motion = lenient_.image("none.png", ImageUse::Numbers, 4, 4, warning_);
    EXPECT_EQ(table_.image(*motion)->rgba[0], 128) << "motion vectors that move nothing";
    const auto mesh = lenient_.mesh("bad.obj", warning_);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(table_.mesh(*mesh)->indices.size(), 12u);
    EXPECT_FLOAT_EQ(table_.mesh(*mesh)->reach, 1.0f);
}

TEST_F(AssetLoaderTest, namesEachFileToItsMonitorBeforeItIsRead)
{
    asset::LoadMonitor monitor;
    asset::AssetLoader watched(resolver_, table_, MissingAsset::IsAnError, "", &monitor);
    EXPECT_EQ(watched.monitor(), &monitor);
    monitor.beginPart("emitters 1 of 1", 0.0f, 1.0f);
    ASSERT_TRUE(watched.image("two.png", ImageUse::Color, 1, 1, warning_).ok());
    EXPECT_STREQ(monitor.progress().item.data(), "two.png");
    EXPECT_FALSE(watched.mesh("bad.obj", warning_).ok());
    EXPECT_STREQ(monitor.progress().item.data(), "bad.obj");
    EXPECT_EQ(monitor.progress().filesRead, 2u);
    monitor.cancel();
    const uint32_t before = table_.size();
    EXPECT_THROW((void)watched.mesh("tri.obj", warning_), asset::LoadCanceled);
    EXPECT_EQ(table_.size(), before);
    EXPECT_EQ(monitor.progress().filesRead, 2u) << "it was not read";
}
