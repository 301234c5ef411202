#include "fxsdk/editor/document/json_writer.h"
#include "fxsdk/editor/document/text_difference.h"
#include "fxsdk/presets/preset_loader.h"

#include <gtest/gtest.h>

namespace fx::editor {
namespace {

std::string edited(const std::string& text, const std::string& pointer, const Json& value)
{
    const Json before = Json::parse(text);
    Json after = before;
    after[Json::json_pointer(pointer)] = value;
    return writeJson(after, before, text);
}

TEST(JsonWriter, anEqualDocumentGivesTheSameBytes)
{
    const std::string text = "{ \"b\":1.50,\n\"a\" : [1e3 , 0.10] }  \n";
    EXPECT_EQ(writeJson(Json::parse(text), Json::parse(text), text), text);
}

TEST(JsonWriter, anEditedNumberIsTheOnlyDifference)
{
    const std::string text = "{ \"b\":1.50,\n\"a\" : [1e3 , 0.10] }  \n";
    EXPECT_EQ(edited(text, "/a/1", 7), "{ \"b\":1.50,\n\"a\" : [1e3 , 7] }  \n");
}

TEST(JsonWriter, anEditOfALibraryPresetDiffersInOneLine)
{
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        const std::string text(file.text);
        const std::string after = edited(text, "/name", "another name");
        size_t changed = 0;
        for (const DifferenceLine& line : difference(text, after))
            changed += line.mark != ' ' ? 1 : 0;
        EXPECT_EQ(changed, 2u) << file.name;
        EXPECT_EQ(Json::parse(after)["name"], "another name");
    }
}

TEST(JsonWriter, anAddedElementKeepsTheLinesOfTheOthers)
{
    const std::string text = "{\n  \"list\": [\n    {\"a\": 1.0},\n    {\"b\": 2.0}\n  ]\n}\n";
    const Json before = Json::parse(text);
    Json after = before;
    after["list"].insert(after["list"].begin() + 1, Json{{"c", 3}});
    EXPECT_EQ(writeJson(after, before, text),
              "{\n  \"list\": [\n    {\"a\": 1.0},\n    {\"c\": 3},\n    {\"b\": 2.0}\n  ]\n}\n");
}

TEST(JsonWriter, longValuesGetOneLinePerMember)
{
    const Json document{{"text", std::string(150, 'x')}, {"list", {1, 2}}};
    EXPECT_EQ(writeJson(document),
              "{\n  \"text\": \"" + std::string(150, 'x') + "\",\n  \"list\": [1, 2]\n}\n");
}

TEST(JsonWriter, everyTextIsReadBackAsTheSameDocument)
{
    const Json document{
        {"a", 0.1}, {"b", 1e-7}, {"c", "quote \" \\ \n"}, {"d", Json::object()}, {"e", {true, nullptr}}};
    EXPECT_EQ(Json::parse(writeJson(document)), document);
}

TEST(TextDifference, showsRemovedAndAddedLinesWithContext)
{
    EXPECT_EQ(toString(difference("a\nb\nc\nd\n", "a\nb\nX\nd\n", 1)), " ...\n b\n-c\n+X\n d\n");
    EXPECT_TRUE(difference("a\n", "a\n").empty());
}

} // namespace
} // namespace fx::editor
