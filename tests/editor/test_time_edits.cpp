// Triggers and camera keys: marks of the timeline, and what adds, moves and removes them.
#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/session/session.h"
#include "fxsdk/editor/session/time_edits.h"
#include "fxsdk/editor/session/time_marks.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

const std::string kListening =
    R"({"version": 1, "prewarm": 2, "emitters": [{"name": "a", "emission": {"rate": 5},
    "events": [{"on": "host", "name": "shoot", "emit": "b"}, {"on": "host", "name": "stop", "emit": "b"}]},
    {"name": "b", "emission": {"rate": 0.1}}]})";
const std::string kMoving =
    R"({"version": 1, "camera": {"position": [0, 1, 9], "target": [0, 1, 0], "note": 3,
    "keys": [{"time": 1, "position": [0, 1, 9], "target": [0, 1, 0]}, {"time": 3, "position": [5, 1, 9], "target": [0, 1, 0]}]},
    "instances": [{"preset": "library:sparks"}, {"preset": "a.fx.json", "start": 2,
    "triggers": [{"time": 2.5, "name": "shoot"}, {"time": 4, "name": "shoot"}]}]})";

Document documentOf(const std::string& text, const std::string& name)
{
    auto document = Document::fromText(text, name);
    EXPECT_TRUE(document.ok()) << document.status().message();
    return std::move(*document);
}

std::vector<TimeMark> marksOf(const Document& document, MarkKind kind)
{
    std::vector<TimeMark> marks = timeMarks(document);
    std::erase_if(marks, [&](const TimeMark& mark) { return mark.kind != kind; });
    return marks;
}

TEST(TimeEdits, triggersOfAPresetAreAddedInOrderAndCountFromTheBeginningOfThePicture)
{
    Document document = documentOf(kListening, "a.fx.json");
    const std::string instance = triggeredInstance(document, "/emitters/0");
    EXPECT_EQ(triggerNames(document, "a.fx.json", instance), (std::vector<std::string>{"shoot", "stop"}));
    for (const double time : {3.0, 1.004, 2.0})
        ASSERT_TRUE(addTrigger(document, instance, "shoot", time).ok());
    EXPECT_EQ(document.history().done(), 3u);
    const std::vector<TimeMark> marks = marksOf(document, MarkKind::Trigger);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_EQ(marks[0].time, 1.0); // the prewarm is no time of the picture
    EXPECT_EQ(marks[2].time, 3.0);
    EXPECT_TRUE(findingsOf(document).empty()) << findingsOf(document)[0].diagnostic.message;
    EXPECT_EQ(timeAt(document, marks[1], 9.0), 3.0); // no trigger passes another one
    EXPECT_EQ(timeAt(document, marks[1], 0.0), 1.0);
    EXPECT_EQ(timeAt(document, marks[2], 9.0), 9.0);
    EXPECT_EQ(markText(document, marks[1]), "trigger \"shoot\" at 2.00 s");
    while (document.undo()) {
    }
    EXPECT_EQ(document.text(), kListening);
}

TEST(TimeEdits, theLastTriggerTakesItsListWithIt)
{
    Document document = documentOf(kListening, "a.fx.json");
    ASSERT_TRUE(addTrigger(document, "/preview/instance", "stop", 1.0).ok());
    ASSERT_TRUE(addTrigger(document, "/preview/instance", "stop", 2.0).ok());
    const uint64_t before = document.history().done();
    ASSERT_TRUE(removeTimed(document, "/preview/instance/triggers/0/time").ok());
    EXPECT_EQ(document.history().done(), before + 1);
    EXPECT_EQ(document.json()["preview"]["instance"]["triggers"].size(), 1u);
    ASSERT_TRUE(removeTimed(document, "/preview/instance/triggers/0/time").ok());
    EXPECT_FALSE(document.json()["preview"]["instance"].contains("triggers"));
    EXPECT_FALSE(removeTimed(document, "/preview/instance/triggers/0/time").ok());
}

TEST(TimeEdits, triggersOfASceneBelongToTheSelectedInstanceAndBeginWithIt)
{
    test::TemporaryFolder folder;
    test::writeText((folder / "a.fx.json").string(), kListening);
    const std::string path = (folder / "a.scene.json").string();
    Document document = documentOf(kMoving, path);
    EXPECT_EQ(triggeredInstance(document, ""), "/instances/0");
    EXPECT_TRUE(triggerNames(document, path, "/instances/0").empty());
    const std::string instance = triggeredInstance(document, "/instances/1/triggers/0");
    EXPECT_EQ(instance, "/instances/1");
    EXPECT_EQ(triggerNames(document, path, instance), (std::vector<std::string>{"shoot", "stop"}));
    ASSERT_TRUE(addTrigger(document, instance, "stop", 0.5).ok());
    EXPECT_EQ(document.json()["instances"][1]["triggers"][0],
              Json::parse(R"({"time": 2.0, "name": "stop"})"));
    EXPECT_FALSE(
        addTrigger(document, triggeredInstance(documentOf(R"({"version": 1})", "b.scene.json"), ""), "x", 0)
            .ok());
    const std::vector<TimeMark> marks = marksOf(document, MarkKind::Trigger);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_EQ(timeAt(document, marks[0], 0.0), 2.0); // not before its instance
}

TEST(TimeEdits, cameraKeysAreAddedMovedReplacedAndRemovedAndTheRestIsKept)
{
    Document document = documentOf(kMoving, "a.scene.json");
    OrbitCamera camera;
    camera.look({1.00004, 2.0, 8.0}, {0.0, 1.0, 0.0});
    ASSERT_TRUE(addCameraKey(document, camera, 2.004).ok());
    const std::vector<TimeMark> marks = marksOf(document, MarkKind::CameraKey);
    ASSERT_EQ(marks.size(), 3u);
    EXPECT_EQ(marks[1].pointer, "/camera/keys/1/time");
    EXPECT_EQ(document.json()["camera"]["keys"][1],
              Json::parse(R"({"time": 2.0, "position": [1.0, 2.0, 8.0], "target": [0.0, 1.0, 0.0]})"));
    EXPECT_EQ(timeAt(document, marks[1], 7.0), 2.99); // times of keys differ
    EXPECT_EQ(timeAt(document, marks[1], 0.0), 1.01);
    camera.look({4.0, 2.0, 8.0}, {0.0, 1.0, 0.0});
    ASSERT_TRUE(addCameraKey(document, camera, 2.0).ok()); // replaces
    EXPECT_EQ(document.json()["camera"]["keys"].size(), 3u);
    EXPECT_EQ(document.json()["camera"]["keys"][1]["position"][0], 4.0);
    EXPECT_EQ(document.json()["camera"]["note"], 3);
    EXPECT_EQ(document.history().done(), 2u);
    ASSERT_TRUE(removeTimed(document, "/camera/keys/1/time").ok());
    EXPECT_EQ(document.json(), Json::parse(kMoving));
    EXPECT_EQ(document.text(), kMoving);
}

TEST(TimeEdits, timesAreRoundedAtTheLimitsOfADragToo)
{
    const auto sceneOf = [](const std::string& times) {
        std::string keys;
        for (size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
            end = times.find(' ', at);
            keys += std::string(keys.empty() ? "" : ", ") + R"({"time": )" + times.substr(at, end - at) +
                    R"(, "position": [0, 1, 9], "target": [0, 1, 0]})";
        }
        return documentOf(R"({"version": 1, "camera": {"keys": [)" + keys + "]}}", "a.scene.json");
    };
    const auto timesOf = [](const Document& document) {
        std::vector<double> times;
        for (const Json& key : document.json()["camera"]["keys"])
            times.push_back(key["time"].get<double>());
        return times;
    };
    Document document = sceneOf("0.06 0.5");
    TimeMark mark = marksOf(document, MarkKind::CameraKey)[1];
    EXPECT_EQ(timeAt(document, mark, 0.0), 0.07); // 0.06 + 0.01 is less
    ASSERT_TRUE(document.set(mark.pointer, timeAt(document, mark, 0.0)).ok());
    ASSERT_TRUE(addCameraKey(document, {}, 0.07).ok()); // replaces it
    EXPECT_EQ(timesOf(document), (std::vector{0.06, 0.07}));
    document = sceneOf("0.0654 0.5 0.6046"); // neighbors that are not rounded
    mark = marksOf(document, MarkKind::CameraKey)[1];
    EXPECT_EQ(timeAt(document, mark, 0.0), 0.08);
    EXPECT_EQ(timeAt(document, mark, 2.0), 0.59);
    document = sceneOf("0.061 0.066 0.071"); // without room between them
    EXPECT_EQ(timeAt(document, marksOf(document, MarkKind::CameraKey)[1], 2.0), 0.066);
    for (const auto& [times, wanted] :
         {std::pair<std::string, std::vector<double>>{"0.06999999999999999 1", {0.07, 1.0}},
          {"0.066 0.0724", {0.066, 0.07}},
          {"0.064 0.076", {0.064, 0.07, 0.076}}})
    {
        document = sceneOf(times);
        ASSERT_TRUE(addCameraKey(document, {}, 0.07).ok());
        EXPECT_EQ(timesOf(document), wanted) << times;
    }
}

TEST(TimeEdits, aSessionKnowsWhetherTheCameraMoves)
{
    test::TemporaryFolder folder;
    const std::string path = (folder / "a.scene.json").string();
    test::writeText(path, R"({"version": 1, "camera": {}, "instances": []})");
    auto session = Session::open(path, folder / "state");
    ASSERT_TRUE(session.ok());
    EXPECT_FALSE((*session)->hasCameraKeys());
    (*session)->run(addCameraKey((*session)->document, (*session)->camera, 0.0));
    EXPECT_TRUE((*session)->hasCameraKeys());
    for (const DocumentFinding& finding : findingsOf((*session)->document))
        EXPECT_TRUE(finding.diagnostic.warning) << finding.diagnostic.message;
}

} // namespace
} // namespace fx::editor
