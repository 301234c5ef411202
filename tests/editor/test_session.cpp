#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/session/session.h"
#include "fxsdk/editor/session/time_edits.h"
#include "fxsdk/editor/session/time_marks.h"

#include "tests/tool/temporary_folder.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <filesystem>

namespace fx::editor {
namespace {

const std::string kText =
    R"({"version": 1, "duration": 4, "emitters": [{"name": "a", "emission": {"rate": 5}}]})";

TEST(Session, aFileThatChangesUnderEditsIsAConflict)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, kText);
    auto session = Session::open(path, folder / "state");
    ASSERT_TRUE(session.ok());
    Session& open = **session;
    open.run(open.document.set("/name", "mine"));
    test::writeText(path, R"({"version": 1, "name": "theirs"})");
    open.update(0.01);
    ASSERT_TRUE(open.conflict().has_value());
    open.takeTheirs();
    EXPECT_EQ(open.document.json()["name"], "theirs");
    EXPECT_EQ(open.selection, ""); // the emitter is gone
    open.undo();
    EXPECT_EQ(open.document.json()["name"], "mine");
}

TEST(Session, whatASessionDidNotSaveIsOfferedToTheNext)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, kText);
    {
        auto session = Session::open(path, folder / "state");
        ASSERT_TRUE(session.ok());
        (*session)->run((*session)->document.set("/name", "mine"));
        (*session)->update(0.01);
    }
    auto next = Session::open(path, folder / "state");
    ASSERT_TRUE(next.ok());
    ASSERT_TRUE((*next)->recovery().has_value());
    (*next)->recover();
    EXPECT_EQ((*next)->document.json()["name"], "mine");
    EXPECT_TRUE((*next)->document.isDirty());
    (*next)->close();
    EXPECT_FALSE((*Session::open(path, folder / "state"))->recovery().has_value());
}

TEST(Session, theTimelineFollowsTheTimeOfThePreview)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, R"({"version": 1, "preview": {"time": 2}})");
    auto session = Session::open(path, folder / "state");
    ASSERT_TRUE(session.ok());
    Session& open = **session;
    open.playback.scrub(1.0);
    EXPECT_FALSE(open.followPreview());
    EXPECT_EQ(open.playback.time(), 1.0); // nothing has changed
    open.run(open.document.set("/preview/time", 7));
    EXPECT_FALSE(open.followPreview());
    EXPECT_EQ(open.playback.time(), 7.0);
    EXPECT_GE(open.playback.end, 7.0);
    open.camera.look({0.0, 2.0, 8.0}, {0.0, 1.0, 0.0});
    open.keepCamera();
    EXPECT_TRUE(open.followPreview());
    EXPECT_EQ(open.document.json()["preview"]["camera"]["target"], Json::array({0.0, 1.0, 0.0}));
    open.undo();
    EXPECT_FALSE(open.document.json()["preview"].contains("camera"));
}

TEST(Session, theViewStaysWhileKeysOfTheCameraAreEditedAndWhenTheLastIsRemoved)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.scene.json").string();
    test::writeText(path, R"({"version": 1, "camera": {"position": [0, 1, 9], "target": [0, 1, 0]}})");
    auto session = Session::open(path, folder / "state");
    ASSERT_TRUE(session.ok());
    Session& open = **session;
    (void)open.followPreview();
    open.run(open.document.set("/camera/fovYDegrees", 40));
    EXPECT_TRUE(open.followPreview());
    open.run(addCameraKey(open.document, open.camera, 0.0));
    EXPECT_FALSE(open.followPreview());
    open.run(open.document.set("/camera/fovYDegrees", 50));
    EXPECT_FALSE(open.followPreview());
    open.run(removeTimed(open.document, "/camera/keys/0/time"));
    EXPECT_FALSE(open.hasCameraKeys());
    EXPECT_FALSE(open.followPreview());
    open.run(open.document.set("/camera/fovYDegrees", 60));
    EXPECT_TRUE(open.followPreview());
    open.followsCamera = true;
    open.run(addCameraKey(open.document, open.camera, 0.0));
    EXPECT_TRUE(open.followPreview());
}

TEST(Session, aViewThatIsKeptIsAValidCamera)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, R"({"version": 1, "preview": {"camera": {"position": [0, 1, 9], "target": [0, 1, 0],
        "orthographicHeight": 4}}})");
    auto session = Session::open(path, folder / "state");
    ASSERT_TRUE(session.ok());
    (*session)->camera.look({0.0, 2.0, 8.0}, {0.0, 1.0, 0.0});
    (*session)->keepCamera();
    for (const DocumentFinding& finding : findingsOf((*session)->document))
        EXPECT_TRUE(finding.diagnostic.warning) << finding.diagnostic.message;
}

TEST(Session, theTimelineBeginsAfterThePrewarm)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, R"({"version": 1, "duration": 10, "prewarm": 3, "emitters": [
        {"emission": {"bursts": [{"time": 5, "count": 2}]}}]})");
    auto session = Session::open(path, folder / "state");
    ASSERT_TRUE(session.ok());
    EXPECT_EQ((*session)->playback.end, 7.0);
    const std::vector<TimeMark> marks = timeMarks((*session)->document);
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_EQ(marks[0].time, 2.0);
    EXPECT_EQ(timeAt((*session)->document, marks[0], 4.0), 7.0); // dragged to 4 s of the picture
}

TEST(Session, anEndWithoutSavingKeepsWhatWasEdited)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.fx.json").string();
    test::writeText(path, kText);
    {
        auto session = Session::open(path, folder / "state");
        ASSERT_TRUE(session.ok());
        EXPECT_EQ((*session)->keepForRecovery(), ""); // nothing was edited
        (*session)->run((*session)->document.set("/name", "mine"));
        EXPECT_TRUE(std::filesystem::exists((*session)->keepForRecovery()));
    }
    {
        auto unanswered = Session::open(path, folder / "state");
        ASSERT_TRUE(unanswered.ok());
        (*unanswered)->close();
    }
    auto next = Session::open(path, folder / "state");
    ASSERT_TRUE(next.ok());
    EXPECT_TRUE((*next)->recovery().has_value());
}

TEST(Playback, timesAreWholeSteps)
{
    Playback playback;
    playback.end = 2.0;
    playback.scrub(1.003);
    EXPECT_EQ(playback.step(), 60);
    playback.isPlaying = true;
    for (int i = 0; i < 144; ++i)
        playback.advance(1.0 / 144.0);
    EXPECT_NEAR(playback.time(), 2.0, 1.01 / 60.0);
    playback.isLooping = false;
    playback.advance(5.0);
    EXPECT_EQ(playback.step(), 120);
    EXPECT_FALSE(playback.isPlaying);
}

TEST(OrbitCamera, orbitKeepsTargetAndDistance)
{
    OrbitCamera camera;
    camera.look({3.0, 4.0, 12.0}, {0.0, 0.0, 0.0});
    EXPECT_NEAR(glm::distance(camera.position(), glm::dvec3(3.0, 4.0, 12.0)), 0.0, 1e-9);
    camera.orbit(1.0, 9.0);
    EXPECT_NEAR(glm::length(camera.position()), 13.0, 1e-9);
    camera.zoom(0.5);
    EXPECT_NEAR(glm::length(camera.position()), 6.5, 1e-9);
}

TEST(Session, aNewFileIsWrittenBySaveUnlessTheFileHasAppeared)
{
    test::TemporaryFolder folder;
    auto session = Session::begin((folder / "a.fx.json").string(), folder / "state");
    ASSERT_TRUE(session.ok());
    (*session)->save();
    EXPECT_TRUE(std::filesystem::exists(folder / "a.fx.json")) << (*session)->message;
    auto late = Session::begin((folder / "b.fx.json").string(), folder / "state");
    ASSERT_TRUE(late.ok());
    test::writeText((folder / "b.fx.json").string(), "{}");
    (*late)->save();
    EXPECT_EQ(std::filesystem::file_size(folder / "b.fx.json"), 2u);
}

} // namespace
} // namespace fx::editor
