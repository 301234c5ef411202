#include "fxsdk/editor/document/solo_mute.h"

#include "fxsdk/editor/document/schema_tree.h"
#include "fxsdk/presets/preset_loader.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

const Json& presetSchema()
{
    return schemaOf(DocumentKind::Preset);
}

TEST(SoloMute, aSoloElementHidesAllOthers)
{
    const Json preset = Json::parse(R"({"emitters": [{}, {}], "gas": [{}]})");
    SoloMute choice;
    choice.setSolo("/emitters/1", true);
    EXPECT_FALSE(choice.isShown("/emitters/0"));
    EXPECT_TRUE(choice.isShown("/emitters/1"));
    EXPECT_FALSE(choice.isShown("/gas/0"));
    choice.setMuted("/emitters/1", true);
    EXPECT_FALSE(choice.isShown("/emitters/1"));
    choice.clear();
    EXPECT_EQ(choice.shown(preset, presetSchema()), preset);
}

TEST(SoloMute, everyElementOfTheLibraryCanBeHidden)
{
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        const Json preset = Json::parse(file.text);
        for (const std::string& element : soloElements(preset, presetSchema())) {
            SoloMute choice;
            choice.setMuted(element, true);
            const Json shown = choice.shown(preset, presetSchema());
            EXPECT_NE(shown, preset) << file.name << element;
            const auto loaded = preset::loadPresetText(shown.dump(), std::string(file.name));
            EXPECT_TRUE(loaded.ok()) << element << ": " << loaded.status().message();
        }
    }
}

TEST(SoloMute, elementsAreAddedByTechniquesOnly)
{
    const Json preset = Json::parse(R"({"emitters": [{}], "wind": [0, 0, 0], "unknown": [{}]})");
    EXPECT_EQ(soloElements(preset, presetSchema()), (std::vector<std::string>{"/emitters/0"}));
}

} // namespace
} // namespace fx::editor
