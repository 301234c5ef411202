// Calibrations as text: what is accepted comes back, what is refused says where and why.
#include "fxsdk/quality/calibration_file.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace fx::quality {

namespace {

using base::Code;

/// A file of one technique, `steps` inside.
std::string fileWith(const std::string& steps, const std::string& name = "media")
{
    return "{\"version\": 1, \"techniques\": [\n  {\"name\": \"" + name + "\", \"steps\": [\n" + steps +
           "\n]}]}";
}

const std::string kLow = R"({"cost": 0.2, "error": 0.5, "setting": {"particles": 0.25}})";
const std::string kTop = R"({"cost": 1, "error": 0, "setting": {"particles": 1}})";

void expectRefused(const std::string& text, Code code, const std::vector<std::string>& parts)
{
    const auto read = readCalibration(text, "my.json");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_EQ(read.status().code(), code) << read.status().message();
    EXPECT_NE(read.status().message().find("my.json"), std::string::npos) << read.status().message();
    for (const std::string& part : parts)
        EXPECT_NE(read.status().message().find(part), std::string::npos) << read.status().message();
}

} // namespace

TEST(BuiltInCalibration, isReadAndItsLevelsAscend)
{
    const auto calibration = builtInCalibration();
    ASSERT_TRUE(calibration.ok()) << calibration.status().message();
    ASSERT_EQ(calibration->techniqueLevels.size(), 6u);
    for (const ScalabilityLevels& levels : calibration->techniqueLevels) {
        EXPECT_GE(levels.steps.size(), 2u) << levels.technique;
        for (size_t k = 1; k < levels.steps.size(); ++k) {
            EXPECT_GT(levels.steps[k].cost, levels.steps[k - 1].cost);
            EXPECT_LT(levels.steps[k].error, levels.steps[k - 1].error);
        }
    }
    EXPECT_FALSE(calibration->origin.empty());
}

TEST(BuiltInCalibration, knowsLightSlicesAndGlare)
{
    const auto calibration = builtInCalibration();
    ASSERT_TRUE(calibration.ok()) << calibration.status().message();
    const auto scalabilityLevelsOf = [&](const std::string& name) {
        for (const ScalabilityLevels& levels : calibration->techniqueLevels)
            if (levels.technique == name)
                return levels;
        return ScalabilityLevels{};
    };
    const ScalabilityLevels slices = scalabilityLevelsOf("light slices");
    ASSERT_GE(slices.steps.size(), 2u);
    for (size_t k = 1; k < slices.steps.size(); ++k)
        EXPECT_GT(slices.steps[k].knobs.valueOf("slicePlanes"),
                  slices.steps[k - 1].knobs.valueOf("slicePlanes"));
    const ScalabilityLevels dazzle = scalabilityLevelsOf("dazzle");
    ASSERT_EQ(dazzle.steps.size(), 2u);
    EXPECT_EQ(dazzle.steps[0].knobs.valueOf("dazzle"), 0.0f);
    EXPECT_EQ(dazzle.steps[1].knobs.valueOf("dazzle"), 1.0f);
}

TEST(CalibrationFile, comesBackAsItWasWritten)
{
    const auto calibration = builtInCalibration();
    ASSERT_TRUE(calibration.ok());
    const std::string text = calibrationText(*calibration);
    const auto again = readCalibration(text, "again");
    ASSERT_TRUE(again.ok()) << again.status().message();
    EXPECT_EQ(toJson(*again), toJson(*calibration));
    EXPECT_EQ(calibrationText(*again), text);
}

TEST(CalibrationFile, lowersLightSlicesButNeverRaisesThem)
{
    const auto calibration = readCalibration(R"({"version": 1, "techniques": [
        {"name": "light slices", "steps": [
            {"cost": 0.2, "error": 0.1, "setting": {"slicePlanes": 8}},
            {"cost": 1, "error": 0, "setting": {"slicePlanes": 32}}]},
        {"name": "media", "steps": [
            {"cost": 1, "error": 0, "setting": {"lightSamples": 1, "multiple": false}}]}]})",
                                             "my.json");
    ASSERT_TRUE(calibration.ok()) << calibration.status().message();
    const Knobs& low = calibration->techniqueLevels[0].steps[0].knobs;
    render::ViewSettings settings;
    settings.slices.resolution = {128, 32};
    apply(low, settings);
    EXPECT_EQ(settings.slices.resolution, (render::SliceResolution{32, 8}));
    apply(calibration->techniqueLevels[0].steps[1].knobs, settings);
    EXPECT_EQ(settings.slices.resolution, (render::SliceResolution{32, 8}));
    settings.slices.samples = 2;
    settings.slices.multiple = true;
    apply(calibration->techniqueLevels[1].steps[0].knobs, settings);
    EXPECT_EQ(settings.slices.samples, 1);
    EXPECT_FALSE(settings.slices.multiple);
}

TEST(CalibrationFile, lowersCompositionsButNeverRaisesThem)
{
    const auto calibration = readCalibration(
        fileWith(
            R"({"cost": 0.2, "error": 0.1, "setting": {"composition": "slabs", "slabs": 6, "voxels": 48}},
                    {"cost": 1, "error": 0, "setting": {"composition": "volume", "voxels": 256}})"),
        "my.json");
    ASSERT_TRUE(calibration.ok()) << calibration.status().message();
    const auto& steps = calibration->techniqueLevels[0].steps;
    EXPECT_EQ(toText(steps[0].knobs), "slabs 6, voxels 48, slabs");
    render::ViewSettings settings;
    apply(steps[1].knobs, settings);
    EXPECT_EQ(settings.composition, render::Composition::Sorted);
    EXPECT_EQ(settings.voxels, 96);
    settings.composition = render::Composition::Volume;
    apply(steps[0].knobs, settings);
    EXPECT_EQ(settings.composition, render::Composition::Slabs);
    EXPECT_EQ(settings.slabs, 6);
    EXPECT_EQ(settings.voxels, 48);
}

TEST(CalibrationFile, levelsOfACompositionTakeThePlaceOfTheOthers)
{
    const std::string steps = ", \"steps\": [" + kTop + "]}";
    const std::string text = R"({"version": 1, "techniques": [{"name": "media", "composition": "volume")" +
                             steps + R"(, {"name": "dazzle")" + steps + R"(, {"name": "media")" + steps +
                             "]}";
    const auto calibration = readCalibration(text, "my.json");
    ASSERT_TRUE(calibration.ok()) << calibration.status().message();
    EXPECT_EQ(toJson(*readCalibration(calibrationText(*calibration), "again")), toJson(*calibration));
    for (const auto composition :
         {render::Composition::Sorted, render::Composition::Slabs, render::Composition::Volume})
    {
        const auto levels = levelsFor(*calibration, composition);
        ASSERT_EQ(levels.size(), 2u);
        const bool isOwn = composition == render::Composition::Volume;
        const auto media = std::ranges::find(levels, "media", &ScalabilityLevels::technique);
        ASSERT_NE(media, levels.end());
        EXPECT_EQ(media->composition.has_value(), isOwn);
    }
    expectRefused(R"({"version": 1, "techniques": [{"name": "media", "composition": "volume")" + steps +
                      R"(, {"name": "media", "composition": "volume")" + steps + "]}",
                  Code::Schema, {"/techniques/1/name", "twice"});
    expectRefused(R"({"version": 1, "techniques": [{"name": "media", "composition": "automatic")" + steps +
                      "]}",
                  Code::Schema, {"/techniques/0/composition", "volume"});
}

TEST(CalibrationFile, everyTruncationIsRefused)
{
    const std::string text = fileWith(kLow + ",\n" + kTop);
    ASSERT_TRUE(readCalibration(text, "my.json").ok());
    for (size_t length = 0; length < text.size(); ++length)
        EXPECT_FALSE(readCalibration(text.substr(0, length), "my.json").ok()) << length;
}

TEST(CalibrationFile, refusesWhatItIsNotAndNamesThePlace)
{
    expectRefused("[]", Code::Schema, {"version"});
    expectRefused(R"({"version": 2, "techniques": []})", Code::Version, {"/version"});
    expectRefused(fileWith(kTop, "medium"), Code::Schema, {":2:", "/techniques/0/name", "media"});
    expectRefused(fileWith(R"({"cost": 1, "error": 0, "setting": {"detial": true}})"), Code::Schema,
                  {":3:", "detail"});
    expectRefused(fileWith(R"({"cost": -1, "error": 0, "setting": {}})"), Code::Schema, {"/cost"});
    expectRefused(fileWith(R"({"cost": 1e999, "error": 0, "setting": {}})"), Code::Parse, {":3:"});
    expectRefused(fileWith(R"({"cost": 1, "error": 0, "setting": {"particles": 0}})"), Code::Schema,
                  {"/particles"});
}

TEST(CalibrationFile, refusesLevelsThatDoNotAscend)
{
    const std::string same = R"({"cost": 0.2, "error": 0.1, "setting": {}})";
    expectRefused(fileWith(kLow + ",\n" + same + ",\n" + kTop), Code::Schema,
                  {":4:", "/techniques/0/steps/1/cost", "remove"});
    const std::string worse = R"({"cost": 0.3, "error": 0.6, "setting": {}})";
    expectRefused(fileWith(kLow + ",\n" + worse + ",\n" + kTop), Code::Schema,
                  {":4:", "/techniques/0/steps/1/error", "remove"});
    expectRefused(fileWith(kLow), Code::Schema, {"/steps/0/error", "/steps/0/cost", "unit"});
    const std::string technique = "{\"name\": \"media\", \"steps\": [" + kTop + "]}";
    expectRefused("{\"version\": 1, \"techniques\": [" + technique + ", " + technique + "]}", Code::Schema,
                  {"/techniques/1/name", "twice"});
}

TEST(CalibrationFile, isNeverReadWhenItIsTooLarge)
{
    expectRefused(std::string(kCalibrationBytes + 1, ' '), Code::TooLarge, {});
}

} // namespace fx::quality
