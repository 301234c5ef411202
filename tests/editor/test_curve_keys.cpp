#include "fxsdk/editor/panels/curve_keys.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

TEST(CurveKeys, keysThatMoveTogetherKeepTheirDistanceAndOrder)
{
    Json keys = Json::parse("[[0, 0], [0.2, 1], [0.4, 2], [1, 3]]");
    moveKeys(keys, {1, 2}, 0.1, 0.5, 0.0, 10.0);
    EXPECT_EQ(keys, Json::parse("[[0, 0], [0.3, 1.5], [0.5, 2.5], [1, 3]]"));
    moveKeys(keys, {1, 2}, 5.0, 0.0, 0.0, 10.0);
    EXPECT_NEAR(keys[2][0].get<double>(), 1.0 - 1e-4, 1e-6);
    EXPECT_NEAR(keys[2][0].get<double>() - keys[1][0].get<double>(), 0.2, 1e-5);
}

TEST(CurveKeys, whatIsNoCurveIsFound)
{
    for (const char* text :
         {"1", "[1, 0.5, 0]", R"({"keys": [[0, 1]]})", R"({"keys": [[0, [1, 0, 0]], [1, [0, 0, 1]]]})"})
        EXPECT_TRUE(isCurve(Json::parse(text))) << text;
    for (const char* text : {"null", "\"a\"", "[1, 0]", "{}", R"({"keys": []})", R"({"keys": [[0]]})",
                             R"({"keys": [["a", 1]]})", R"({"keys": [[0, "a"]]})", R"({"keys": [7]})",
                             R"({"keys": [[0, 1], [1, [0, 0, 1]]]})", R"({"keys": [[0, [1, 0]]]})"})
        EXPECT_FALSE(isCurve(Json::parse(text))) << text;
}

TEST(CurveKeys, otherMembersOfACurveAreKept)
{
    const Json curve = curveOf(Json::parse(R"({"note": "mine", "keys": [[0, 1]]})"), Json::parse("[[0, 2]]"));
    EXPECT_EQ(curve, Json::parse(R"({"note": "mine", "keys": [[0, 2]]})"));
    EXPECT_EQ(curveOf(3, Json::parse("[[0, 2]]")), Json::parse(R"({"keys": [[0, 2]]})"));
}

TEST(CurveKeys, valuesStayInTheirRange)
{
    Json keys = Json::parse("[[0, 0.5]]");
    moveKeys(keys, {0}, 0.0, 9.0, 0.0, 1.0);
    EXPECT_EQ(keys[0][1], 1);
}

TEST(CurveKeys, anAddedKeyDoesNotChangeTheCurve)
{
    Json keys = Json::parse("[[0, 0], [1, 4]]");
    EXPECT_EQ(addKey(keys, 0.25), 1u);
    EXPECT_EQ(keys[1], Json::parse("[0.25, 1]"));
    EXPECT_DOUBLE_EQ(curveAt(keys, 0.625), 2.5);
    removeKeys(keys, {0, 1, 2});
    EXPECT_EQ(keys.size(), 1u);
}

TEST(CurveKeys, hotterBodiesAreBluer)
{
    const Json ramp = temperatureRamp(1000.0, 10000.0, 4);
    for (size_t i = 1; i < ramp.size(); ++i)
        EXPECT_GT(ramp[i][1][2].get<double>() / ramp[i][1][0].get<double>(),
                  ramp[i - 1][1][2].get<double>() / ramp[i - 1][1][0].get<double>());
}

TEST(CurveKeys, draggedKeysSnapToRoundTimesAndValues)
{
    const Json key = Json::array({0.42, 0.37});
    const KeyMove move = snapped(key, {0.1, 0.2}, 1.1); // steps of 1/20 and of 0.05
    EXPECT_NEAR(0.42 + move.time, 0.5, 1e-12);
    EXPECT_NEAR(0.37 + move.value, 0.55, 1e-12);
    EXPECT_NEAR(370.0 + snapped(Json::array({0.4, 370.0}), {0.0, 61.0}, 5000.0).value, 400.0, 1e-9);
    EXPECT_EQ(snapped(Json::array({0.4, Json::array({1, 1, 1})}), {0.0, 3.0}, 1.0).value, 3.0);
}

TEST(CurveKeys, displayColorsAreThoseOfSrgb)
{
    EXPECT_NEAR(toDisplay(0.21404f), 0.5f, 1e-4f);
    for (const float value : {-0.5f, 0.0f, 0.002f, 0.18f, 1.0f, 7.0f})
        EXPECT_NEAR(fromDisplay(toDisplay(value)), value, 1e-4f * std::max(1.0f, value));
}

} // namespace
} // namespace fx::editor
