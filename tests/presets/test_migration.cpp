#include "fxsdk/presets/migration.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/emitters/emitter_def.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace fx::preset;
using fx::base::Code;

namespace {

constexpr const char* kVersion0 = R"({
  "version": 0,
  "emitters": [
    {"shape": "cone", "extent": 3, "size": {"min": 0.25, "max": 0.5}, "angle": 90, "emission": {"rate": 1}}
  ]
})";

/// Steps of a format that has seen two changes.
void appendA(nlohmann::json& document, Findings&)
{
    document["log"] = document.value("log", std::string()) + "a";
}
void appendB(nlohmann::json& document, Findings&)
{
    document["log"] = document.value("log", std::string()) + "b";
}
constexpr MigrationStep kTwoSteps[] = {{0, appendA}, {1, appendB}};

std::string logOf(int version)
{
    nlohmann::json document{{"version", version}};
    Findings findings;
    EXPECT_TRUE(migrate(document, 2, kTwoSteps, findings));
    EXPECT_EQ(document["version"], 2);
    return document.value("log", std::string());
}

} // namespace

TEST(Migration, takesEveryStepFromTheDocumentsVersionOnAndInOrder)
{
    EXPECT_EQ(logOf(0), "ab");
    EXPECT_EQ(logOf(1), "b");
    EXPECT_EQ(logOf(2), "");
}

TEST(Migration, aPresetOfVersion0MeansWhatItMeantThen)
{
    const auto loaded = loadPresetText(kVersion0, "old");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const auto& emitter = dynamic_cast<const fx::sim::EmitterDef&>(*loaded->effect->solvers.at(0));
    EXPECT_FLOAT_EQ(emitter.radius.min, 0.25f);
    EXPECT_FLOAT_EQ(emitter.radius.max, 0.5f);
    EXPECT_FLOAT_EQ(emitter.size.x, 3.0f);
    EXPECT_FLOAT_EQ(emitter.angle, std::numbers::pi_v<float> / 2);
    ASSERT_EQ(loaded->warnings.size(), 1u);
    EXPECT_EQ(loaded->warnings[0].pointer, "/version");
    EXPECT_EQ(loaded->warnings[0].line, 2);
}

TEST(Migration, anErrorInAMigratedMemberIsShownWhereTheOldTextHasIt)
{
    std::vector<Diagnostic> diagnostics;
    const std::string text =
        "{\"version\": 0,\n \"emitters\": [{\"emission\": {\"rate\": 1},\n   \"size\": -1}]}";
    EXPECT_FALSE(loadPresetText(text, "old", &diagnostics).ok());
    ASSERT_EQ(diagnostics.size(), 2u);
    EXPECT_TRUE(diagnostics[0].warning);
    EXPECT_EQ(diagnostics[1].line, 3);
    EXPECT_EQ(diagnostics[1].pointer, "/emitters/0/radius");
}

TEST(Migration, documentsOfUnexpectedShapePassThroughUnharmed)
{
    for (const char* text : {R"({"version":0,"emitters":7})", R"({"version":0,"emitters":[1,"a",null]})",
                             R"({"version":0,"emitters":{}})"})
        EXPECT_FALSE(loadPresetText(text, "old").ok());
}

TEST(Migration, versionsThatAreMissingOrNotKnownAreRefusedByName)
{
    const auto code = [](const char* text) { return int(loadPresetText(text, "t").status().code()); };
    EXPECT_EQ(code("{}"), int(Code::Schema));
    EXPECT_EQ(code(R"({"version":"1"})"), int(Code::Schema));
    EXPECT_EQ(code(R"({"version":1.5})"), int(Code::Schema));
    EXPECT_EQ(code(R"({"version":-1})"), int(Code::Schema));
    EXPECT_EQ(code(R"({"version":2})"), int(Code::Version));
    EXPECT_EQ(code(R"({"version":99999999999999})"), int(Code::Version));
    EXPECT_NE(loadPresetText(R"({"version":2})", "t").status().message().find("0 to 1"), std::string::npos);
}
