// The composition that a preset is made for: what it says of the effect, and what it is warned of.
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/scene_file.h"
#include "fxsdk/scene_file/validate_file.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using fx::sim::PreferredComposition;
using fx::test::TempFolder;

std::string presetWith(const std::string& members, const std::string& appearance = "")
{
    return R"({"version": 1, )" + members + R"("emitters": [{"emission": {"rate": 1}, "appearance": {)" +
           appearance + "}}]}";
}

std::shared_ptr<const fx::sim::EffectDef> effectOf(const std::string& text)
{
    const auto loaded = fx::preset::loadPresetText(text, "p");
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return loaded.ok() ? loaded->effect : nullptr;
}

/// Pointers of members that need the composition "sorted", as fx validate tells them.
std::vector<std::string> orderFaults(const std::string& text)
{
    const TempFolder folder;
    std::vector<std::string> pointers;
    for (const auto& finding : fx::preset::validateFile(folder.write("p.fx.json", text)))
        if (finding.message.find("needs the composition \"sorted\"") != std::string::npos) {
            EXPECT_TRUE(finding.warning);
            EXPECT_NE(finding.message.find("remove it"), std::string::npos) << finding.message;
            pointers.push_back(finding.pointer);
        }
    return pointers;
}

} // namespace

TEST(PreferredComposition, isWhatThePresetSays)
{
    EXPECT_EQ(effectOf(presetWith(""))->hints.composition, PreferredComposition::None);
    EXPECT_EQ(effectOf(presetWith(R"("composition": "sorted", )"))->hints.composition,
              PreferredComposition::Sorted);
    EXPECT_EQ(effectOf(presetWith(R"("composition": "slabs", )"))->hints.composition,
              PreferredComposition::Slabs);
    EXPECT_EQ(effectOf(presetWith(R"("composition": "volume", )"))->hints.composition,
              PreferredComposition::Volume);
    EXPECT_FALSE(fx::preset::loadPresetText(presetWith(R"("composition": "automatic", )"), "p").ok());
}

TEST(PreferredComposition, isNoPartOfTheEffect)
{
    EXPECT_EQ(effectOf(presetWith(R"("composition": "volume", )"))->fingerprint,
              effectOf(presetWith(""))->fingerprint);
}

TEST(PreferredComposition, ofTheLibraryIsVolumeWhereMediaHaveDetailAndSlabsForBlocks)
{
    size_t detailed = 0;
    for (const auto& entry : fx::preset::presetLibrary()) {
        const bool hasDetail = entry.text.find("\"detail\":") != std::string_view::npos;
        const bool hasBlocks = entry.text.find("\"blocks\":") != std::string_view::npos;
        const auto loaded = fx::preset::loadPresetText(entry.text, std::string(entry.name));
        ASSERT_TRUE(loaded.ok()) << loaded.status().message();
        const auto expected = hasBlocks   ? PreferredComposition::Slabs
                              : hasDetail ? PreferredComposition::Volume
                                          : PreferredComposition::None;
        EXPECT_EQ(loaded->effect->hints.composition, expected) << entry.name;
        detailed += hasDetail ? 1 : 0;
    }
    EXPECT_GE(detailed, 11u);
}

TEST(PreferredComposition, warnsOfEachMemberThatOrdersParticles)
{
    const std::string order = R"("order": "youngest", "orderBias": 0.5)";
    EXPECT_EQ(orderFaults(presetWith(R"("composition": "volume", )", order)),
              (std::vector<std::string>{"/emitters/0/appearance/order", "/emitters/0/appearance/orderBias"}));
    EXPECT_EQ(orderFaults(presetWith(R"("composition": "slabs", )", R"("order": "oldest")")).size(), 1u);
    EXPECT_TRUE(orderFaults(presetWith(R"("composition": "sorted", )", order)).empty());
    EXPECT_TRUE(orderFaults(presetWith("", order)).empty());
    EXPECT_TRUE(orderFaults(presetWith(R"("composition": "slabs", )", R"("order": "depth", "orderBias": 0)"))
                    .empty());
}

TEST(PreferredComposition, ofOneEffectIsThatOfTheSceneAndOthersAreWarned)
{
    const TempFolder folder;
    folder.write("ordered.fx.json", presetWith("", R"("order": "oldest")"));
    folder.write("summed.fx.json", presetWith(R"("composition": "slabs", )"));
    const auto load = [&](const std::string& composition) {
        const auto scene = fx::scene_file::loadSceneFile(folder.write(
            "s.scene.json",
            R"({"version": 1, "camera": {"position": [0, 0, 9], "target": [0, 0, 0]}, "composition": ")" +
                composition +
                R"(", "instances": [{"preset": "ordered.fx.json"}, {"preset": "summed.fx.json"}]})"));
        EXPECT_TRUE(scene.ok()) << scene.status().message();
        return scene.ok() ? *scene : fx::scene_file::SceneFile();
    };
    const fx::scene_file::SceneFile scene = load("automatic");
    EXPECT_EQ(fx::scene_file::preferredHints(scene).composition, PreferredComposition::Slabs);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].pointer, "/instances/0/preset");
    EXPECT_NE(scene.warnings[0].message.find("/emitters/0/appearance/order"), std::string::npos);
    EXPECT_TRUE(load("sorted").warnings.empty());
}

namespace {

std::vector<std::string> scatteringFaults(const std::string& text)
{
    const TempFolder folder;
    std::vector<std::string> messages;
    for (const auto& finding : fx::preset::validateFile(folder.write("p.fx.json", text)))
        if (finding.pointer == "/scattering") {
            EXPECT_TRUE(finding.warning);
            messages.push_back(finding.message);
        }
    return messages;
}

} // namespace

TEST(PreferredScattering, isWhatThePresetSaysAndNoPartOfTheEffect)
{
    using fx::sim::PreferredScattering;
    const auto asked = [](const std::string& value) {
        return effectOf(presetWith(R"("scattering": ")" + value + R"(", )"))->hints.scattering;
    };
    EXPECT_EQ(effectOf(presetWith(""))->hints.scattering, PreferredScattering::Automatic);
    EXPECT_EQ(asked("automatic"), PreferredScattering::Automatic);
    EXPECT_EQ(asked("single"), PreferredScattering::Single);
    EXPECT_EQ(asked("closed_form"), PreferredScattering::ClosedForm);
    EXPECT_EQ(asked("network"), PreferredScattering::Network);
    EXPECT_FALSE(fx::preset::loadPresetText(presetWith(R"("scattering": "off", )"), "p").ok());
    EXPECT_EQ(effectOf(presetWith(R"("scattering": "network", )"))->fingerprint,
              effectOf(presetWith(""))->fingerprint);
}

TEST(PreferredScattering, ofANetworkIsWarnedOfWhereBallsAreSorted)
{
    EXPECT_EQ(scatteringFaults(presetWith(R"("scattering": "network", )")).size(), 1u);
    EXPECT_EQ(scatteringFaults(presetWith(R"("composition": "sorted", "scattering": "network", )")).size(),
              1u);
    EXPECT_TRUE(scatteringFaults(presetWith(R"("composition": "slabs", "scattering": "network", )")).empty());
    EXPECT_TRUE(
        scatteringFaults(presetWith(R"("composition": "volume", "scattering": "network", )")).empty());
    EXPECT_TRUE(scatteringFaults(presetWith(R"("scattering": "closed_form", )")).empty());
    EXPECT_TRUE(scatteringFaults(presetWith("")).empty());
}

TEST(PreferredScattering, ofSeveralEffectsIsTheGreatestOfThoseThatAreThere)
{
    using namespace fx::sim;
    HintCounts counts;
    const DrawingHints smoke{PreferredComposition::Volume, PreferredScattering::Single};
    const DrawingHints cloud{PreferredComposition::None, PreferredScattering::Network};
    EXPECT_EQ(counts.greatest(), DrawingHints());
    counts.add(smoke, 1);
    counts.add(cloud, 1);
    EXPECT_EQ(counts.greatest(), greatest(smoke, cloud));
    EXPECT_EQ(counts.greatest(), (DrawingHints{PreferredComposition::Volume, PreferredScattering::Network}));
    counts.add(cloud, -1);
    EXPECT_EQ(counts.greatest(), smoke);
}
