#include "tests/api/api_fixture.h"
#include "tests/tool/temporary_folder.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>

using fx::test::fountainPreset;
using fx::test::loadText;
using PresetApi = fx::test::ApiTest;

namespace {

/// An archive that the host owns.
struct Archive
{
    std::map<std::string, std::string> texts;
    int open = 0;

    static const void* openText(void* user, const char* name, size_t* outSize)
    {
        auto& self = *static_cast<Archive*>(user);
        const auto found = self.texts.find(name);
        if (found == self.texts.end())
            return nullptr;
        ++self.open;
        *outSize = found->second.size();
        return found->second.data();
    }
    static void closeText(void* user, const void*, size_t) { --static_cast<Archive*>(user)->open; }
};

FxContext* contextWith(Archive& archive)
{
    FxContextDef def = fxDefaultContextDef();
    def.assets = {&archive, &Archive::openText, &Archive::closeText};
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&def, &context), FX_OK);
    return context;
}

} // namespace

TEST_F(PresetApi, aLoadedPresetTellsWhatItIs)
{
    FxPresetInfo info{};
    info.structSize = sizeof info;
    ASSERT_EQ(fxGetPresetInfo(context_, fountain_, &info), FX_OK);
    EXPECT_STREQ(info.name, "fountain");
    EXPECT_EQ(info.solverCount, 1u);
    EXPECT_EQ(info.capacity, 128u);
    EXPECT_EQ(info.durationTicks, 0);
}

TEST_F(PresetApi, aPreviewIsThatOfTheAuthor)
{
    FxPresetPreview preview{};
    preview.structSize = sizeof preview;
    ASSERT_EQ(fxGetPresetPreview(context_, fountain_, &preview), FX_OK);
    EXPECT_EQ(preview.exposureEv100, 13.0f); // it says nothing
    EXPECT_EQ(preview.hasCamera, 0u);
    const std::string text = R"({"version": 1, "emitters": [], "preview": {"time": 3, "exposureEv100": 9.5,
        "camera": {"position": [1, 2, 3], "target": [0, 1, 0], "fovYDegrees": 90},
        "lighting": {"sunDirection": [0, 3, 4], "sunIlluminance": [5, 6, 7], "groundAlbedo": 0.5}}})";
    FxPresetId id{};
    ASSERT_EQ(fxLoadPresetText(context_, text.data(), text.size(), nullptr, &id), FX_OK)
        << fxGetLastErrorMessage();
    ASSERT_EQ(fxGetPresetPreview(context_, id, &preview), FX_OK);
    EXPECT_EQ(preview.time, 3.0);
    EXPECT_EQ(preview.exposureEv100, 9.5f);
    EXPECT_EQ(preview.hasCamera, 1u);
    EXPECT_EQ(preview.cameraPosition[2], 3.0);
    EXPECT_EQ(preview.cameraTarget[1], 1.0);
    EXPECT_FLOAT_EQ(preview.fovY, 1.57079633f);
    EXPECT_FLOAT_EQ(preview.sunDirection[1], 0.6f);
    EXPECT_EQ(preview.sunIlluminance[1], 6.0f);
    EXPECT_EQ(preview.skyLuminance[0], 0.0f);
    EXPECT_EQ(preview.groundAlbedo, 0.5f);
}

TEST_F(PresetApi, pathsOfTheLibraryAreFiles)
{
    FxPresetId id{};
    EXPECT_EQ(fxLoadPresetFile(context_, "library:sparks", &id), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxLoadPresetFile(context_, "library:spraks", &id), FX_ERROR_NOT_FOUND);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "did you mean"), nullptr) << fxGetLastErrorMessage();
}

TEST_F(PresetApi, nullIsRefusedEverywhereAndTheOutputStays)
{
    const std::string text = fountainPreset();
    FxPresetId id{42};
    EXPECT_EQ(fxLoadPresetText(nullptr, text.data(), text.size(), nullptr, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetText(context_, nullptr, 3, nullptr, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetText(context_, text.data(), 0, nullptr, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetText(context_, text.data(), text.size(), nullptr, nullptr),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetFile(context_, nullptr, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetFile(nullptr, "a.fx.json", &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetFile(context_, "a.fx.json", nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetLibrary(context_, nullptr, &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetLibrary(nullptr, "explosion", &id), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxLoadPresetLibrary(context_, "explosion", nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxUnloadPreset(nullptr, fountain_), FX_ERROR_INVALID_ARGUMENT);
    FxPresetInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxGetPresetInfo(nullptr, fountain_, &info), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxGetPresetInfo(context_, fountain_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    info.structSize = 3;
    EXPECT_EQ(fxGetPresetInfo(context_, fountain_, &info), FX_ERROR_VERSION);
    FxPresetPreview preview{};
    preview.structSize = sizeof preview;
    EXPECT_EQ(fxGetPresetPreview(nullptr, fountain_, &preview), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxGetPresetPreview(context_, fountain_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxGetPresetPreview(context_, {}, &preview), FX_ERROR_STALE_ID);
    EXPECT_EQ(id.bits, 42u);
}

TEST_F(PresetApi, aBrokenPresetIsRefusedWithItsPlace)
{
    const std::string text = "{\"version\": 1,\n \"emiters\": []}";
    FxPresetId id{};
    EXPECT_EQ(fxLoadPresetText(context_, text.data(), text.size(), "mine.fx.json", &id), FX_ERROR_SCHEMA);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "mine.fx.json:2:"), nullptr) << fxGetLastErrorMessage();
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "emitters"), nullptr) << fxGetLastErrorMessage();
    EXPECT_EQ(fxLoadPresetText(context_, text.data(), 5, nullptr, &id), FX_ERROR_PARSE);
    EXPECT_EQ(id.bits, 0u);
}

TEST_F(PresetApi, aTextBeyondTheLimitIsNotRead)
{
    FxPresetId id{};
    const char one = '{';
    EXPECT_EQ(fxLoadPresetText(context_, &one, (size_t(4) << 20) + 1, nullptr, &id), FX_ERROR_TOO_LARGE);
}

TEST_F(PresetApi, everyLibraryPresetLoadsWithAndWithoutItsPrefix)
{
    FxPresetId id{};
    if (!fx::test::kHasGas) {
        EXPECT_NE(fxLoadPresetLibrary(context_, "explosion", &id), FX_OK);
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find("FXSDK_WITH_SPH"), std::string::npos)
            << fxGetLastErrorMessage(); // what is missing is named
    } else {
        EXPECT_EQ(fxLoadPresetLibrary(context_, "explosion", &id), FX_OK) << fxGetLastErrorMessage();
    }
    for (const char* name : {"artillery-dirt", "barrel-smoke", "gas-fire", "campfire", "smoke-column",
                             "dust-burst", "sparks", "steam", "burning-debris", "rain", "snow", "fireworks",
                             "waterfall-mist", "magic-trail", "muzzle-flash", "tracer", "debris"})
        EXPECT_EQ(fxLoadPresetLibrary(context_, name, &id), FX_OK) << name << ": " << fxGetLastErrorMessage();
    EXPECT_EQ(fxLoadPresetLibrary(context_, fx::test::kLargeEffect, &id), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxLoadPresetLibrary(context_, "volcano", &id), FX_ERROR_NOT_FOUND);
}

TEST_F(PresetApi, aFileIsLoadedAndAMissingOneIsNamed)
{
    const fx::test::TemporaryFolder folder;
    const std::string path = (folder / "fx_api_preset.fx.json").string();
    std::ofstream(path) << fountainPreset();
    FxPresetId id{};
    EXPECT_EQ(fxLoadPresetFile(context_, path.c_str(), &id), FX_OK) << fxGetLastErrorMessage();
    std::remove(path.c_str());
    EXPECT_EQ(fxLoadPresetFile(context_, path.c_str(), &id), FX_ERROR_NOT_FOUND);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "fx_api_preset"), nullptr) << fxGetLastErrorMessage();
}

TEST_F(PresetApi, unloadingMakesTheIdStaleAndLeavesInstancesAlone)
{
    const FxInstanceId instance = addFountain();
    ASSERT_EQ(fxUnloadPreset(context_, fountain_), FX_OK);
    EXPECT_EQ(fxUnloadPreset(context_, fountain_), FX_ERROR_STALE_ID);
    FxPresetInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxGetPresetInfo(context_, fountain_, &info), FX_ERROR_STALE_ID);
    const FxInstanceDef def = instanceDef();
    FxInstanceId second{};
    EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &second), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_Update(scene_, 0.05), FX_OK);
    EXPECT_EQ(fxScene_IsValid(scene_, instance), 1u);
    EXPECT_GT(statistics().particles, 0u);
}

TEST_F(PresetApi, theIdOfAnotherContextIsRefused)
{
    Archive archive;
    FxContext* other = contextWith(archive);
    const FxPresetId foreign = loadText(other, fountainPreset());
    EXPECT_EQ(fxUnloadPreset(context_, foreign), FX_ERROR_STALE_ID);
    FxInstanceDef def = instanceDef();
    def.preset = foreign;
    FxInstanceId id{};
    EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxDestroyContext(other), FX_OK);
}

TEST(AssetHook, theHostsArchiveIsAskedFirstAndEveryAssetIsClosed)
{
    Archive archive;
    archive.texts["effects/fountain.fx.json"] = fountainPreset();
    archive.texts.emplace("broken.fx.json", "{");
    FxContext* context = contextWith(archive);
    FxPresetId id{};
    EXPECT_EQ(fxLoadPresetFile(context, "effects/fountain.fx.json", &id), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxLoadPresetFile(context, "broken.fx.json", &id), FX_ERROR_PARSE);
    EXPECT_EQ(fxLoadPresetFile(context, "nowhere.fx.json", &id), FX_ERROR_NOT_FOUND);
    archive.texts["large.fx.json"] = std::string((size_t(4) << 20) + 1, ' ');
    EXPECT_EQ(fxLoadPresetFile(context, "large.fx.json", &id), FX_ERROR_TOO_LARGE);
    EXPECT_EQ(archive.open, 0);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}
