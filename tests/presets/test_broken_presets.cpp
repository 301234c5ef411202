#include "fxsdk/presets/preset_loader.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

using namespace fx::preset;
using fx::base::Code;
using fx::test::TempFolder;

namespace {

/// A preset that is broken in one way, and what its author must be told.
struct Broken
{
    const char* name;
    const char* text;
    Code code;
    int line;
    const char* pointer;
    const char* message; ///< part of it
};

void PrintTo(const Broken& broken, std::ostream* out)
{
    *out << broken.name;
}

// clang-format off: one case reads as one block
constexpr Broken kBroken[] = {
    {"wrongTypeOfNumber", "{\"version\":1,\n\"duration\":\"long\"}", Code::Schema, 2, "/duration",
     "found \"long\"; allowed is a number from 0 to 86400 [s]"},
    {"wrongTypeOfArray", "{\"version\":1,\n\"emitters\":{}}", Code::Schema, 2, "/emitters",
     "allowed is an array"},
    {"wrongTypeOfBoolean", "{\"version\":1,\n\"ground\":1}", Code::Schema, 2, "/ground", "true or false"},
    {"wrongTypeOfElement", "{\"version\":1,\"emitters\":[\n 7]}", Code::Schema, 2, "/emitters/0",
     "an object"},
    {"fractionOfWhole", "{\"version\":1,\n\"subSteps\":1.5}", Code::Schema, 2, "/subSteps",
     "a whole number from 1 to 16"},
    {"null", "{\"version\":1,\n\"name\":null}", Code::Schema, 2, "/name", "found null; allowed is a string"},
    {"unknownMember", "{\"version\":1,\n\"durration\":1}", Code::Schema, 2, "/durration",
     "did you mean \"duration\"?"},
    {"unknownMemberFarFromAll", "{\"version\":1,\n\"colour\":1}", Code::Schema, 2, "/colour", "known here: "},
    {"unknownInnerMember", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\n\"raduis\":1}]}",
     Code::Schema, 2, "/emitters/0/raduis", "did you mean \"radius\"?"},
    {"unknownMemberOfForces",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"forces\":{\n\"Drag\":1}}]}", Code::Schema, 2,
     "/emitters/0/forces/Drag", "did you mean \"drag\"?"},
    {"unknownMemberOfRange",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"speed\":{\"min\":1,\"max\":2,\n\"middle\":2}}"
     "]}",
     Code::Schema, 2, "/emitters/0/speed/middle", "known here: max min"},
    {"belowRange", "{\"version\":1,\n\"subSteps\":0}", Code::Schema, 2, "/subSteps",
     "found 0; allowed is a whole number from 1 to 16"},
    {"aboveRange", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\n\"heat\":11}]}", Code::Schema,
     2, "/emitters/0/heat", "from 0 to 10"},
    {"aboveRangeInsideVector", "{\"version\":1,\n\"wind\":[0,\n1000,0]}", Code::Schema, 3, "/wind/1",
     "found 1000"},
    {"aboveRangeInsideRange",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"lifetime\":{\"min\":1,\n\"max\":1e9}}]}",
     Code::Schema, 2, "/emitters/0/lifetime/max", "from 0.01 to 3600"},
    {"shortVector", "{\"version\":1,\n\"wind\":[0,1]}", Code::Schema, 2, "/wind",
     "found an array of 2 elements; allowed is [x, y, z]"},
    {"longColor", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\n\"albedoOverLife\":[0,0,0,1]}]}",
     Code::Schema, 2, "/emitters/0/albedoOverLife", "found an array of 4 elements; allowed is"},
    {"notInEnum", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\n\"shape\":\"cube\"}]}",
     Code::Schema, 2, "/emitters/0/shape",
     "found \"cube\"; allowed is one of \"point\", \"sphere\", \"box\", \"cone\""},
    {"missingRequired", "{\"version\":1,\"emitters\":[\n{}]}", Code::Schema, 2, "/emitters/0",
     "\"emission\" is missing"},
    {"nothingBorn", "{\"version\":1,\"emitters\":[{\n\"emission\":{}}]}", Code::Schema, 2,
     "/emitters/0/emission", "nothing would ever be born"},
    {"missingMax", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\n\"speed\":{\"min\":1}}]}",
     Code::Schema, 2, "/emitters/0/speed", "\"max\" is missing"},
    {"minAboveMax",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\n\"speed\":{\"min\":2,\"max\":1}}]}",
     Code::Schema, 2, "/emitters/0/speed", "min 2 above max 1"},
    {"keysOutOfOrder",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"sizeOverLife\":{\"keys\":[[0,1],[0.7,1],\n[0."
     "5,1]]}}]}",
     Code::Schema, 2, "/emitters/0/sizeOverLife/keys/2", "rising t"},
    {"noKeys", "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"sizeOverLife\":{\n\"keys\":[]}}]}",
     Code::Schema, 2, "/emitters/0/sizeOverLife/keys",
     "found an array of 0 elements; allowed is an array of 1 to 256 elements"},
    {"keyAfterDeath",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"sizeOverLife\":{\"keys\":[[\n1.5,1]]}}]}",
     Code::Schema, 2, "/emitters/0/sizeOverLife/keys/0/0", "found 1.5; allowed is a number from 0 to 1"},
    {"both",
     "{\"version\":1,\"emitters\":[{\"emission\":{\"rate\":1},\"opticalDepth\":1,\n\"crossSection\":1}]}",
     Code::Schema, 2, "/emitters/0/crossSection", "one of them"},
    {"missingVersion", "\n{\"name\":\"x\"}", Code::Schema, 2, "", "\"version\" is missing"},
    {"futureVersion", "{\n\"version\":999}", Code::Version, 2, "/version",
     "found 999; this library reads versions 0 to 1"},
    {"notAnObject", "\n[1,2]", Code::Schema, 2, "", "found an array of 2 elements"},
    {"empty", "", Code::Parse, 1, "", "empty"},
    {"onlySpace", " \n\n ", Code::Parse, 3, "", "unexpected end of input"},
    {"nan", "{\"version\":1,\n\"duration\":NaN}", Code::Parse, 2, "/duration",
     "NaN and Infinity are not numbers in JSON"},
    {"overflow", "{\"version\":1,\n\"duration\":1e400}", Code::Parse, 2, "/duration", "number overflow"},
    {"duplicate", "{\"version\":1,\n\"name\":\"a\",\n\"name\":\"b\"}", Code::Schema, 3, "/name",
     "occurs twice"},
    {"comment", "{\"version\":1,\n// why\n\"name\":\"a\"}", Code::Parse, 2, "/version", "not valid JSON"},
    {"trailingComma", "{\"version\":1,\n\"name\":\"a\",\n}", Code::Parse, 2, "/name",
     "no value follows this comma"},
    {"notUtf8", "{\"version\":1,\n\"name\":\"\xE4\"}", Code::Parse, 2, "/name", "UTF-8"},
    {"unclosedString", "{\"version\":1,\n\"name\":\"a}", Code::Parse, 2, "/name", "not valid JSON"},
    {"control", "{\"version\":1,\n\"name\":\"a\x01\"}", Code::Parse, 2, "/name", "not valid JSON"},
};
// clang-format on

std::string explosionText()
{
    for (const auto& entry : presetLibrary())
        if (entry.name == "explosion.fx.json")
            return std::string(entry.text);
    return {};
}

} // namespace

class BrokenPreset : public ::testing::TestWithParam<Broken>
{};

INSTANTIATE_TEST_SUITE_P(Each, BrokenPreset, ::testing::ValuesIn(kBroken),
                         [](const auto& each) { return std::string(each.param.name); });

TEST_P(BrokenPreset, isRefusedWithLinePointerAndRemedy)
{
    const Broken& broken = GetParam();
    const TempFolder folder;
    const std::string path = folder.write("broken.fx.json", broken.text);
    std::vector<Diagnostic> diagnostics;
    const auto loaded = loadPresetFile(path, &diagnostics);
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(int(loaded.status().code()), int(broken.code));
    ASSERT_EQ(diagnostics.size(), 1u) << loaded.status().message();
    EXPECT_EQ(diagnostics[0].file, path);
    EXPECT_EQ(diagnostics[0].line, broken.line) << diagnostics[0].message;
    EXPECT_GE(diagnostics[0].column, 1);
    EXPECT_EQ(diagnostics[0].pointer, broken.pointer) << diagnostics[0].message;
    EXPECT_NE(diagnostics[0].message.find(broken.message), std::string::npos) << diagnostics[0].message;
    EXPECT_EQ(loaded.status().message(), toString(diagnostics[0]));
}

TEST(BrokenPresets, aFileThatIsNotThereIsNotFound)
{
    const TempFolder folder;
    std::vector<Diagnostic> diagnostics;
    const auto loaded = loadPresetFile(folder.path() + "/none.fx.json", &diagnostics);
    EXPECT_EQ(int(loaded.status().code()), int(Code::NotFound));
    EXPECT_EQ(diagnostics.size(), 1u);
}

TEST(BrokenPresets, hugeFilesAreRefusedByTheirSize)
{
    const TempFolder folder;
    const std::string path = folder.write("huge.fx.json", "{");
    std::filesystem::resize_file(path, 100'000'000);
    const auto loaded = loadPresetFile(path);
    EXPECT_EQ(int(loaded.status().code()), int(Code::TooLarge));
    EXPECT_NE(loaded.status().message().find("100000000 bytes"), std::string::npos);
}

TEST(BrokenPresets, bombsAreRefusedByDepthNodesAndLengths)
{
    const auto code = [](const std::string& text) { return int(loadPresetText(text, "t").status().code()); };
    EXPECT_EQ(code(std::string(4'000'000, '[')), int(Code::TooLarge));
    std::string objects;
    for (int i = 0; i < 500'000; ++i)
        objects += "{\"a\":";
    EXPECT_EQ(code(objects), int(Code::TooLarge));
    std::string nodes = "{\"version\":1,\"emitters\":[";
    for (int i = 0; i < 70'000; ++i)
        nodes += "0,";
    EXPECT_EQ(code(nodes + "0]}"), int(Code::TooLarge));
    EXPECT_EQ(code("{\"version\":1,\"name\":\"" + std::string(1'000'000, 'a') + "\"}"), int(Code::TooLarge));
    EXPECT_EQ(code("{\"version\":" + std::string(1'000'000, '1') + "}"), int(Code::TooLarge));
    EXPECT_EQ(code(std::string(5'000'000, ' ')), int(Code::TooLarge));
}

TEST(BrokenPresets, everyTruncationOfTheExplosionIsRefusedWhereTheTextEnds)
{
    const std::string text = explosionText();
    const size_t end = text.find_last_of('}');
    ASSERT_NE(end, std::string::npos);
    for (size_t length = 0; length <= end; length += 10) {
        std::vector<Diagnostic> diagnostics;
        const auto loaded = loadPresetText(text.substr(0, length), "cut", &diagnostics);
        ASSERT_FALSE(loaded.ok()) << length;
        ASSERT_EQ(int(loaded.status().code()), int(Code::Parse)) << length;
        ASSERT_EQ(diagnostics.size(), 1u) << length;
        const int lines = 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(length), '\n'));
        ASSERT_EQ(diagnostics[0].line, lines) << length << ": " << diagnostics[0].message;
    }
}

TEST(BrokenPresets, damagedBytesNeverCrashTheLoader)
{
    const std::string text = explosionText();
    for (size_t at = 0; at < text.size(); at += 37) {
        std::string damaged = text;
        for (size_t i = at; i < std::min(at + 4, text.size()); ++i)
            damaged[i] = char(damaged[i] ^ 0x55);
        static_cast<void>(loadPresetText(damaged, "damaged"));
    }
}

TEST(BrokenPresets, allErrorsOfAFileAreReportedInTheOrderOfTheText)
{
    std::vector<Diagnostic> diagnostics;
    static_cast<void>(loadPresetText(
        "{\"version\": 1,\n \"wind\": 5,\n \"emitters\": [{\"emission\": {},\n   \"heat\": 20,\n"
        "   \"hte\": 1}],\n \"ground\": \"yes\"}",
        "many", &diagnostics));
    ASSERT_EQ(diagnostics.size(), 4u);
    EXPECT_EQ(toString(diagnostics[0]),
              "many:2:10: /wind: found 5; allowed is [x, y, z] with numbers from -100 to 100 [m/s]");
    EXPECT_EQ(diagnostics[1].line, 4);
    EXPECT_EQ(diagnostics[2].line, 5);
    EXPECT_EQ(diagnostics[2].column, 4) << "the name that nobody knows, not its value";
    EXPECT_EQ(diagnostics[3].line, 6);
}

TEST(BrokenPresets, messagesStaySmallHoweverLongTheNamesInTheFileAre)
{
    std::string text = "{\"version\":1";
    for (int i = 0; i < 500; ++i)
        text += ",\"" + std::string(3000, char('a' + i % 26)) + std::to_string(i) + "\":0";
    std::vector<Diagnostic> diagnostics;
    const auto loaded = loadPresetText(text + "}", std::string(5000, 'f'), &diagnostics);
    ASSERT_FALSE(loaded.ok());
    EXPECT_LE(loaded.status().message().size(), 1024u);
    EXPECT_GT(loaded.status().message().size(), 100u);
    for (const Diagnostic& diagnostic : diagnostics)
        EXPECT_LE(diagnostic.message.size(), 1024u);
}
