#include "fxsdk/scene_file/scene_file.h"
#include "fxsdk/scene_file/validate_file.h"
#include "tests/presets/temp_folder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <ostream>

using namespace fx::scene_file;
using fx::test::TempFolder;

namespace {

constexpr const char* kRocket = R"({"version": 1, "emitters": [
    {"name": "a", "lifetime": 1, "emission": {"rate": 1}, "events": [
        {"on": "host", "name": "boom", "emit": "b", "count": 5},
        {"on": "host", "name": "fizz", "emit": "b"}]},
    {"name": "b", "lifetime": 1}]})";

std::string sceneWith(const std::string& members)
{
    return R"({"version": 1, "camera": {}, "instances": [{"preset": "rocket.fx.json", "start": 0.5, )" +
           members + "}]}";
}

SceneInstance read(const std::string& members)
{
    const TempFolder folder;
    folder.write("rocket.fx.json", kRocket);
    const auto scene = loadSceneFile(folder.write("s.scene.json", sceneWith(members)));
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    return scene.ok() ? scene->instances.at(0) : SceneInstance{};
}

struct Broken
{
    const char* name;
    const char* members;
    const char* pointer; ///< below the instance
    const char* message;
};

void PrintTo(const Broken& broken, std::ostream* out)
{
    *out << broken.name;
}

constexpr Broken kBroken[] = {
    {"keysThatDoNotRise", R"("keys": [{"time": 1, "position": [0,0,0]}, {"time": 1, "position": [1,0,0]}])",
     "/keys/1/time", "not later than the time before"},
    {"keyOfNothing", R"("keys": [{"time": 1}])", "/keys/0", "neither position nor rotationDegrees"},
    {"keyWithoutTheOthersPosition", R"("keys": [{"time": 1, "position": [0,0,0]}, {"time": 2}])", "/keys/1",
     "no \"position\", which the first key has"},
    {"keyWithAPositionOfItsOwn",
     R"("keys": [{"time": 1, "rotationDegrees": [0,0,0]}, {"time": 2, "rotationDegrees": [0,0,0], "position": [0,0,0]}])",
     "/keys/1/position", "in every key or in none"},
    {"keysBesideAQuaternion", R"("quaternion": [0,0,0,1], "keys": [{"time": 1, "rotationDegrees": [0,0,0]}])",
     "/quaternion", "one of them"},
    {"keyWithoutTime", R"("keys": [{"position": [0,0,0]}])", "/keys/0", "\"time\" is missing"},
    {"misspelledKey", R"("keys": [{"time": 0, "positoin": [0,0,0]}])", "/keys/0/positoin",
     "did you mean \"position\"?"},
    {"speedAboveItsRange", R"("speed": 17)", "/speed", "from 0 to 16"},
    {"speedOfText", R"("speed": "fast")", "/speed", "or {\"steps\": [[time, value], ...]}"},
    {"stepAboveItsRange", R"("speed": {"steps": [[0, 1], [1, 99]]})", "/speed/steps/1/1", "from 0 to 16"},
    {"stepsThatDoNotRise", R"("speed": {"steps": [[2, 1], [1, 2]]})", "/speed/steps/1", "rising times"},
    {"switchOfNumber", R"("emitting": {"steps": [[0, 1]]})", "/emitting/steps/0/1", "true or false"},
    {"switchesThatDoNotRise", R"("emitting": {"steps": [[1, true], [1, false]]})", "/emitting/steps/1",
     "rising times"},
    {"nothingIsEverBorn", R"("emitting": {"steps": [[0, true], [0.5, false]]})", "/emitting",
     "or a later start"},
    {"triggerBeforeTheStart", R"("triggers": [{"time": 0.4, "name": "boom"}])", "/triggers/0/time",
     "allowed is 0.5 or later"},
    {"triggersThatFall", R"("triggers": [{"time": 2, "name": "boom"}, {"time": 1, "name": "boom"}])",
     "/triggers/1/time", "do not fall"},
    {"triggerOfNoMany", R"("triggers": [{"time": 2, "name": "boom", "count": 0}])", "/triggers/0/count",
     "from 1 to 65536"},
    {"misspelledTrigger", R"("triggers": [{"time": 2, "name": "bom"}])", "/triggers/0/name",
     "did you mean \"boom\"?"},
    {"unknownTrigger", R"("triggers": [{"time": 2, "name": "explode"}])", "/triggers/0/name",
     "it hears: boom fizz"},
    {"jumpBeforeTheStart", R"("seek": [{"time": 0.1, "to": 3}])", "/seek/0/time", "0.5 or later"},
    {"jumpToNowhere", R"("seek": [{"time": 1}])", "/seek/0", "\"to\" is missing"},
};

class BrokenPlay : public testing::TestWithParam<Broken>
{};

} // namespace

TEST(InstancePlay, readsEveryMember)
{
    const InstancePlay play =
        read(R"("speed": {"steps": [[1, 2], [3, 0]]}, "emitting": {"steps": [[2, false]]},
        "triggers": [{"time": 0.5, "name": "fizz"}, {"time": 0.5, "name": "boom", "count": 3}],
        "seek": [{"time": 1, "to": 4}])")
            .play;
    EXPECT_EQ(valueAt(play.speed, 0.9, 1.0), 1.0) << "before its first step";
    EXPECT_EQ(valueAt(play.speed, 1.0, 1.0), 2.0);
    EXPECT_EQ(valueAt(play.speed, 99.0, 1.0), 0.0);
    EXPECT_EQ(valueAt(play.emitting, 1.9, 1.0), 1.0);
    EXPECT_EQ(valueAt(play.emitting, 2.0, 1.0), 0.0);
    ASSERT_EQ(play.triggers.size(), 2u);
    EXPECT_EQ(play.triggers[0].count, 1u) << "by default";
    EXPECT_EQ(play.triggers[1].name, "boom");
    EXPECT_EQ(play.triggers[1].count, 3u);
    ASSERT_EQ(play.jumps.size(), 1u);
    EXPECT_EQ(play.jumps[0].to, 4.0);
    EXPECT_FALSE(play.moves || play.turns);
}

TEST(InstancePlay, oneValueHoldsFromTheBeginning)
{
    const InstancePlay play = read(R"("speed": 0.25, "emitting": true)").play;
    EXPECT_EQ(valueAt(play.speed, 0.0, 1.0), 0.25);
    EXPECT_EQ(valueAt(play.emitting, 0.0, 0.0), 1.0);
    EXPECT_TRUE(read(R"("seed": 3)").play.isEmpty());
}

TEST(InstancePlay, movesThroughItsKeysAsTheCameraDoes)
{
    const SceneInstance instance = read(R"("position": [9, 9, 9], "keys": [{"time": 1, "position": [0, 0, 0]},
        {"time": 2, "position": [4, 0, 0]}, {"time": 5, "position": [4, 6, 0]}, {"time": 6, "position": [0, 0, 3]}])");
    CameraPath camera;
    camera.keys = {{1, {0, 0, 0}, {}}, {2, {4, 0, 0}, {}}, {5, {4, 6, 0}, {}}, {6, {0, 0, 3}, {}}};
    for (double time = 0.0; time < 7.0; time += 0.1)
        EXPECT_EQ(instance.placementAt(time).position, camera.at(time).position) << time;
    EXPECT_EQ(instance.placementAt(0).rotation, instance.rotation) << "it does not turn";
}

TEST(InstancePlay, turnsAsOftenAsTheAnglesSay)
{
    const SceneInstance instance =
        read(R"("position": [1, 2, 3], "keys": [{"time": 0, "rotationDegrees": [0, 0, 0]},
        {"time": 2, "rotationDegrees": [0, 720, 0]}])");
    // halfway in time is halfway on the way, by symmetry: one whole turn; a quarter of the way is
    // 720 (3/16 - 2/64) = 112.5 degrees
    const glm::vec3 x(1, 0, 0);
    EXPECT_LT(glm::length(instance.placementAt(1).rotation * x - x), 1e-5f);
    const float angle = glm::radians(112.5f);
    EXPECT_LT(
        glm::length(instance.placementAt(0.5).rotation * x - glm::vec3(std::cos(angle), 0, -std::sin(angle))),
        1e-5f);
    EXPECT_EQ(instance.placementAt(1).position, glm::dvec3(1, 2, 3)) << "it does not move";
}

TEST_P(BrokenPlay, isRefusedAtItsPlaceWithTheRemedy)
{
    const TempFolder folder;
    folder.write("rocket.fx.json", kRocket);
    const auto found = fx::preset::validateFile(folder.write("s.scene.json", sceneWith(GetParam().members)));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].pointer, std::string("/instances/0") + GetParam().pointer);
    EXPECT_NE(found[0].message.find(GetParam().message), std::string::npos) << found[0].message;
    EXPECT_GT(found[0].line, 0);
}

INSTANTIATE_TEST_SUITE_P(All, BrokenPlay, testing::ValuesIn(kBroken),
                         [](const auto& row) { return std::string(row.param.name); });
