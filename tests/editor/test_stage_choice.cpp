// The stage of the picture: a choice of the view that becomes a part of the document only when it is kept.
#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/session/session.h"
#include "fxsdk/scene_file/stages.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <fstream>

namespace fx::editor {
namespace {

const char* const kStagedPreset = R"({"version": 1, "emitters": [{"emission": {"rate": 40}}],
    "preview": {"time": 2, "exposureEv100": 9, "figure": {"position": [2, 0, 0]}, "mesh": {"file": "library:stage-yard.obj"}}})";

TEST(StageChoice, everyStageReplacesMeshLightBackgroundAndExposureAndNothingElse)
{
    ASSERT_GE(scene_file::stages().size(), 7u);
    const Json before = Json::parse(kStagedPreset);
    for (const scene_file::Stage& stage : scene_file::stages()) {
        StageChoice choice;
        choice.name = stage.name;
        const Json staged = onStage(before, DocumentKind::Preset, choice);
        const Json members = Json::parse(stage.members);
        for (const char* member : {"mesh", "lighting", "background", "exposureEv100"})
            EXPECT_EQ(staged["preview"].value(member, Json()), members.value(member, Json()))
                << stage.name << member;
        EXPECT_EQ(staged["preview"]["time"], 2);
        EXPECT_EQ(staged["preview"]["figure"], before["preview"]["figure"]);
        EXPECT_EQ(staged["emitters"], before["emitters"]);
        const auto document = Document::fromText(staged.dump(), "staged.fx.json");
        ASSERT_TRUE(document.ok());
        EXPECT_TRUE(findingsOf(*document).empty())
            << stage.name << ": " << findingsOf(*document)[0].diagnostic.message;
    }
}

TEST(StageChoice, sunAndSkyChangeInProportionAndTheSkyIsAlsoTheBackground)
{
    const Json before = Json::parse(R"({"version": 1, "preview": {"lighting": {"sunDirection": [0, 2, 0],
        "sunIlluminance": [300, 200, 100], "skyLuminance": 50}, "background": {"color": [10, 20, 40], "horizon": [30, 30, 30]}}})");
    const StageLightValues light = lightOf(before, DocumentKind::Preset);
    EXPECT_EQ(light.sunDirection, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(light.sunIlluminance, 200.0);
    EXPECT_EQ(light.skyLuminance, 50.0);
    StageChoice choice;
    choice.sunIlluminance = 400.0;
    choice.skyLuminance = 100.0;
    choice.sunDirection = directionOf(90.0, 30.0);
    const Json preview = onStage(before, DocumentKind::Preset, choice)["preview"];
    EXPECT_EQ(preview["lighting"]["sunIlluminance"], Json::array({600.0, 400.0, 200.0}));
    EXPECT_EQ(preview["lighting"]["skyLuminance"], Json::array({100.0, 100.0, 100.0}));
    EXPECT_EQ(preview["background"]["color"], Json::array({20.0, 40.0, 80.0}));
    EXPECT_EQ(preview["background"]["horizon"], Json::array({60.0, 60.0, 60.0}));
    EXPECT_NEAR(preview["lighting"]["sunDirection"][0].get<double>(), 0.866025, 1e-6);
    EXPECT_NEAR(preview["lighting"]["sunDirection"][1].get<double>(), 0.5, 1e-6);
}

TEST(StageChoice, theColorOfTheSkyIsAlsoThatOfTheBackground)
{
    const Json before =
        Json::parse(R"({"version": 1, "lighting": {"sunDirection": [0, 2, 0], "skyLuminance": [50, 100, 200]},
        "background": {"color": [10, 20, 40], "horizon": [30, 30, 30]}})");
    StageChoice choice;
    setSky(choice, {100.0, 50.0, 50.0});
    const Json scene = onStage(before, DocumentKind::Scene, choice);
    EXPECT_EQ(scene["lighting"]["skyLuminance"], Json::array({100.0, 50.0, 50.0}));
    EXPECT_EQ(scene["background"]["color"], Json::array({20.0, 10.0, 10.0}));
    EXPECT_EQ(scene["background"]["horizon"], Json::array({60.0, 15.0, 7.5}));
    EXPECT_EQ(lightOf(scene, DocumentKind::Scene).sky, glm::dvec3(100.0, 50.0, 50.0));
    EXPECT_EQ(scene["lighting"]["sunDirection"], before["lighting"]["sunDirection"]);
    choice.skyLuminance = 100.0; // brighter, with the same color
    EXPECT_EQ(onStage(before, DocumentKind::Scene, choice)["lighting"]["skyLuminance"],
              Json::array({200.0, 100.0, 100.0}));
    setSky(choice, {30.0, 0.0, 0.0}); // a little green, to which the others are ratios
    EXPECT_EQ(onStage(before, DocumentKind::Scene, choice)["lighting"]["skyLuminance"],
              Json::array({30.0, 0.03, 0.0}));
    setSky(choice, {0.0, 0.0, 0.0});
    EXPECT_EQ(onStage(before, DocumentKind::Scene, choice)["lighting"]["skyLuminance"],
              Json::array({0.0, 0.0, 0.0}));
}

TEST(StageChoice, directionsTurnIntoHeadingAndElevationAndBack)
{
    for (const double heading : {-170.0, -90.0, 0.0, 45.0, 179.0})
        for (const double elevation : {-80.0, 0.0, 35.0, 89.0}) {
            const glm::dvec3 direction = directionOf(heading, elevation);
            EXPECT_NEAR(glm::length(direction), 1.0, 1e-12);
            EXPECT_NEAR(headingOf(direction), heading, 1e-9);
            EXPECT_NEAR(elevationOf(direction), elevation, 1e-9);
        }
}

TEST(StageChoice, aFigureIsAddedAndTakenAway)
{
    StageChoice choice;
    choice.hasFigure = false;
    const Json without = onStage(Json::parse(kStagedPreset), DocumentKind::Preset, choice);
    EXPECT_FALSE(hasFigure(without));
    choice.hasFigure = true;
    EXPECT_TRUE(hasFigure(onStage(without, DocumentKind::Preset, choice)));
    EXPECT_TRUE(hasFigure(onStage(Json::parse(R"({"version": 1})"), DocumentKind::Preset, choice)));
}

TEST(StageChoice, theDocumentKeepsItAsOneEdit)
{
    auto session = Session::open("library:campfire", testing::TempDir());
    ASSERT_TRUE(session.ok());
    Session& s = **session;
    const std::string before = s.document.text();
    StageChoice choice;
    choice.name = "night";
    const uint64_t revision = s.shownRevision();
    s.setStage(choice);
    EXPECT_NE(s.shownRevision(), revision);
    EXPECT_EQ(s.document.text(), before); // a view changes no file
    EXPECT_NE(s.shownText(), before);
    const Json shown = Json::parse(s.shownText());
    s.exposureEv100 = 5.5f;
    s.keepStage();
    EXPECT_EQ(s.document.history().done(), 1u);
    EXPECT_EQ(s.stage(), StageChoice());
    EXPECT_EQ(s.document.json()["preview"]["lighting"], shown["preview"]["lighting"]);
    EXPECT_EQ(s.document.json()["preview"]["exposureEv100"], 5.5);
    s.undo();
    EXPECT_EQ(s.document.text(), before);
    s.keepStage(); // nothing is chosen
    EXPECT_EQ(s.document.text(), before);
}

TEST(StageChoice, anExposureIsKeptAlsoWhereThePreviewIsNone)
{
    for (const std::string wrong : {"3", "[]", "\"x\"", "null"}) {
        const std::string path = testing::TempDir() + "no-preview.fx.json";
        std::ofstream(path) << R"({"version": 1, "preview": )" << wrong << "}";
        auto session = Session::open(path, testing::TempDir());
        ASSERT_TRUE(session.ok()) << session.status().message();
        (*session)->exposureEv100 = 5.5f;
        (*session)->keepStage();
        EXPECT_EQ((*session)->document.json()["preview"], Json({{"exposureEv100", 5.5}})) << wrong;
        (*session)->close(); // no recovery file is left
    }
}

TEST(StageChoice, aTextThatIsNoPresetIsLeftToItsReaders)
{
    EXPECT_EQ(scene_file::presetOnStage("[1, 2", "night"), "[1, 2");
    EXPECT_EQ(scene_file::presetOnStage(R"({"preview": 3})", "night"), R"({"preview": 3})");
}

} // namespace
} // namespace fx::editor
