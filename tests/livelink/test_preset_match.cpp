#include "fxsdk/livelink/server/preset_match.h"

#include <gtest/gtest.h>

using fx::base::Code;
using fx::link::matchPreset;
using fx::link::NamedPreset;

namespace {

const std::vector<NamedPreset> kPresets = {
    {"fx/fire.fx.json", "fire"},
    {"fx/old/fire.fx.json", "old fire"},
    {"library:campfire", "campfire"},
    {"data/smoke.fx.json", "smoke"},
    {"data/smoke.fx.json", "smoke"}, // loaded twice
    {"a.fx.json", "twin"},
    {"b.fx.json", "twin"},
};

std::vector<size_t> found(const std::string& wanted)
{
    const auto indices = matchPreset(wanted, kPresets);
    EXPECT_TRUE(indices.ok()) << indices.status().message();
    return indices ? *indices : std::vector<size_t>();
}

} // namespace

TEST(PresetMatch, takesTheFirstRuleThatFits)
{
    EXPECT_EQ(found("fx/fire.fx.json"), std::vector<size_t>{0});
    EXPECT_EQ(found("/home/user/game/fx/fire.fx.json"), std::vector<size_t>{0});
    EXPECT_EQ(found("./fx/old/fire.fx.json"), std::vector<size_t>{1});
    EXPECT_EQ(found("old/fire.fx.json"), std::vector<size_t>{1});
    EXPECT_EQ(found("library:campfire"), std::vector<size_t>{2});
    EXPECT_EQ(found("campfire"), std::vector<size_t>{2});
    EXPECT_EQ(found("/elsewhere/smoke.fx.json"), (std::vector<size_t>{3, 4}));
}

TEST(PresetMatch, refusesWhatFitsNothingOrSeveralFiles)
{
    EXPECT_EQ(matchPreset("rain", kPresets).status().code(), Code::NotFound);
    EXPECT_NE(matchPreset("rain", kPresets).status().message().find("library:campfire"), std::string::npos);
    EXPECT_EQ(matchPreset("/other/fire.fx.json", kPresets).status().code(), Code::Capacity);
    EXPECT_EQ(matchPreset("twin", kPresets).status().code(), Code::Capacity);
    EXPECT_EQ(matchPreset("a", {}).status().code(), Code::NotFound);
    EXPECT_EQ(matchPreset("re.fx.json", kPresets).status().code(), Code::NotFound); // no whole name
}
