// Images and meshes that a preset's appearance names.
#include "simulation/emitters/emitter_def.h"
#include "tests/presets/small_png.h"
#include "tests/presets/temp_folder.h"

#include "fxsdk/presets/preset_loader.h"

using namespace fx;
using namespace fx::test;

namespace {

constexpr const char* kLongTriangle = "v 0 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\n";

class AppearanceAssets : public ::testing::Test
{
protected:
    base::Result<preset::LoadedPreset> load(const std::string& appearance,
                                            asset::MissingAsset missing = asset::MissingAsset::IsAnError)
    {
        const std::string path =
            folder_.write("sub/p.fx.json", "{\"version\":1,\n\"emitters\":[{\"emission\":{\"rate\":1},\n"
                                           "\"appearance\":" +
                                               appearance + "}]}");
        return preset::loadPresetFile(path, nullptr, {&table_, missing});
    }
    static const sim::EmitterAppearance& appearanceOf(const base::Result<preset::LoadedPreset>& loaded)
    {
        return dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers.at(0)).appearance;
    }
    void expectError(const std::string& appearance, const char* pointer, const char* what)
    {
        const auto loaded = load(appearance);
        ASSERT_FALSE(loaded.ok()) << appearance;
        const std::string message(loaded.status().message());
        EXPECT_NE(message.find(std::string("p.fx.json:3:")), std::string::npos) << message;
        EXPECT_NE(message.find(pointer), std::string::npos) << message;
        EXPECT_NE(message.find(what), std::string::npos) << message;
    }

    TempFolder folder_;
    base::AssetTable table_{std::pmr::get_default_resource()};
};

} // namespace

TEST_F(AppearanceAssets, areInTheTableUnderTheIdsThatTheLookHolds)
{
    folder_.write("sub/a.png", smallPng());
    folder_.write("sub/m.obj", kLongTriangle);
    const auto loaded = load(R"({"kind":"mesh","texture":"a.png","motion":"a.png","mesh":"m.obj",
                                 "tileColumns":2})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const sim::EmitterAppearance& look = appearanceOf(loaded);
    ASSERT_TRUE(table_.image(look.texture));
    EXPECT_EQ(table_.image(look.texture)->width, 2);
    EXPECT_TRUE(table_.image(look.texture)->isSrgb);
    ASSERT_TRUE(table_.image(look.motion));
    EXPECT_FALSE(table_.image(look.motion)->isSrgb) << "numbers, not colors";
    ASSERT_TRUE(table_.mesh(look.mesh));
    EXPECT_FLOAT_EQ(look.meshReach, 3.0f);
}

TEST_F(AppearanceAssets, thatAreMissingDamagedOrDoNotFitAreErrorsWithPlaceAndRemedy)
{
    folder_.write("sub/a.png", smallPng());
    folder_.write("a.png", smallPng());
    folder_.write("sub/cut.png", smallPng().substr(0, 40));
    folder_.write("sub/bad.obj", "f 1 2 3\n");
    expectError(R"({"kind":"sprite","texture":"none.png"})", "/emitters/0/appearance/texture",
                "does not exist");
    expectError(R"({"kind":"sprite","texture":"../a.png"})", "/emitters/0/appearance/texture", "leads out");
    expectError(R"({"kind":"sprite","texture":"cut.png"})", "/emitters/0/appearance/texture", "cut.png");
    expectError(R"({"kind":"sprite","texture":"a.png","tileColumns":3})", "/emitters/0/appearance/texture",
                "correct the numbers of frames");
    expectError(R"({"kind":"sprite","motion":"none.png"})", "/emitters/0/appearance/motion",
                "does not exist");
    expectError(R"({"kind":"mesh","mesh":"bad.obj"})", "/emitters/0/appearance/mesh", "bad.obj");
    expectError(R"({"kind":"mesh"})", "/emitters/0/appearance/kind", "without a mesh");
}

TEST_F(AppearanceAssets, thatAreMissingAreShownAsSuchWhenThatIsAskedFor)
{
    const auto loaded = load(R"({"kind":"mesh","texture":"none.png","mesh":"none.obj"})",
                             asset::MissingAsset::ShowsPlaceholder);
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_EQ(loaded->warnings.size(), 2u);
    const sim::EmitterAppearance& look = appearanceOf(loaded);
    ASSERT_TRUE(table_.image(look.texture));
    EXPECT_EQ(table_.image(look.texture)->rgba[0], 255) << "magenta";
    EXPECT_TRUE(table_.mesh(look.mesh));
}

TEST_F(AppearanceAssets, arePartOfWhatTellsPresetsApart)
{
    const std::string sprite = R"({"kind":"sprite","texture":"a.png"})";
    folder_.write("sub/a.png", smallPng());
    const uint64_t before = load(sprite)->effect->fingerprint;
    EXPECT_EQ(load(sprite)->effect->fingerprint, before);
    std::string other = smallPng();
    folder_.write("sub/a.png",
                  other + '\0'); // what follows the end of a PNG is not read, but another file it is
    EXPECT_NE(load(sprite)->effect->fingerprint, before);
}

TEST_F(AppearanceAssets, ofTheLibraryAreThereWithoutAFolder)
{
    const std::string text = R"({"version":1,"emitters":[{"emission":{"rate":1},
        "appearance":{"kind":"mesh","mesh":"library:debris-chunk.obj"}}]})";
    const auto loaded = preset::loadPresetText(text, "t", nullptr, nullptr, {&table_, {}});
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    ASSERT_TRUE(table_.mesh(appearanceOf(loaded).mesh));
    EXPECT_NEAR(appearanceOf(loaded).meshReach, 1.0f, 1e-4f);
}
