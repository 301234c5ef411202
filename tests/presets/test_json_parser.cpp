#include "fxsdk/presets/json_locator.h"
#include "fxsdk/presets/json_parser.h"

#include <gtest/gtest.h>

#include <array>

using namespace fx::preset;
using fx::base::Code;

namespace {

/// The only finding of a text that must be refused.
Diagnostic refusal(std::string_view text, Code code, const JsonLimits& limits = kPresetLimits)
{
    Findings findings;
    EXPECT_FALSE(parseJson(text, limits, findings).has_value());
    EXPECT_EQ(int(findings.firstCode()), int(code));
    const std::vector<Diagnostic> list = findings.locate(text, "t");
    EXPECT_EQ(list.size(), 1u);
    return list.empty() ? Diagnostic{} : list.front();
}

std::string repeated(const std::string& piece, size_t count)
{
    std::string text;
    for (size_t i = 0; i < count; ++i)
        text += piece;
    return text;
}

JsonLimits small()
{
    return {1000, 3, 10, 8, 4, 100'000};
}

bool accepts(std::string_view text, const JsonLimits& limits)
{
    Findings findings;
    return parseJson(text, limits, findings).has_value();
}

} // namespace

TEST(JsonParser, buildsTheDocumentThatTheTextDescribes)
{
    Findings findings;
    const auto document =
        parseJson(R"({"a":[1,-2.5,"x\u00e9",true,null,{}],"b":{"c":[]}})", kPresetLimits, findings);
    ASSERT_TRUE(document.has_value());
    EXPECT_EQ(*document, nlohmann::json::parse(R"({"a":[1,-2.5,"x\u00e9",true,null,{}],"b":{"c":[]}})"));
}

TEST(JsonParser, aMissingOrSuperfluousSeparatorIsReportedWhereItBelongs)
{
    struct Case
    {
        const char* text;
        int line, column;
        const char* says;
    };
    const Case cases[] = {
        {"{\n  \"a\": 1\n\n\n  \"b\": 2\n}", 2, 8, "a comma is missing after this value"},
        {"{\"a\": \"x\"\n\"b\": 2}", 1, 9, "a comma is missing after this value"},
        {"{\"a\": {\"c\": []}\n\"b\": 2}", 1, 15, "a comma is missing after this value"},
        {"[\n1\n-2]", 2, 1, "a comma is missing after this value"},
        {"[[1]\n[2]]", 1, 4, "a comma is missing after this value"},
        {"[true\n\nfalse]", 1, 5, "a comma is missing after this value"},
        {"{\"a\"\n1}", 1, 4, "a colon is missing after this name"},
        {"{\"a\": 1,\n}", 1, 8, "no value follows this comma"},
        {"[1,\n\n]", 1, 3, "no value follows this comma"},
    };
    for (const Case& c : cases) {
        const Diagnostic found = refusal(c.text, Code::Parse);
        EXPECT_EQ(int(found.line), c.line) << c.text;
        EXPECT_EQ(int(found.column), c.column) << c.text;
        EXPECT_NE(found.message.find(c.says), std::string::npos) << c.text << ": " << found.message;
    }
    for (const char* other : {"{\"a\": 1, 2}", "[1,, 2]", "{} {}", "[1 : 2]", "{\"a\" }", "[1 x]", "{"})
        EXPECT_EQ(refusal(other, Code::Parse).message.find("comma is missing"), std::string::npos) << other;
}

TEST(JsonParser, eachLimitHoldsExactly)
{
    EXPECT_TRUE(accepts("[[[]]]", small()));
    EXPECT_FALSE(accepts("[[[[]]]]", small()));
    EXPECT_TRUE(accepts("[1,2,3,4]", small()));
    EXPECT_FALSE(accepts("[1,2,3,4,5]", small()));
    EXPECT_TRUE(accepts("[[1,2,3],[1,2],[1]]", small()));    // 10 values
    EXPECT_FALSE(accepts("[[1,2,3],[1,2],[1,2]]", small())); // 11
    EXPECT_TRUE(accepts("\"12345678\"", small()));
    EXPECT_FALSE(accepts("\"123456789\"", small()));
    EXPECT_TRUE(accepts("{\"12345678\":12345678}", small()));
    EXPECT_FALSE(accepts("{\"123456789\":1}", small()));
    EXPECT_FALSE(accepts("[123456789]", small()));
    EXPECT_TRUE(accepts(" " + std::string(998, ' ') + "1", small()));
    EXPECT_FALSE(accepts(" " + std::string(999, ' ') + "1", small()));
}

TEST(JsonParser, anEscapedQuoteDoesNotEndAString)
{
    EXPECT_TRUE(accepts(R"(["\"","\\"])", small()));
    EXPECT_FALSE(accepts(R"(["\"\"\"\"\""])", small()));
}

TEST(JsonParser, aDepthBombIsRefusedAtItsThirtyThirdBracket)
{
    const Diagnostic d = refusal(std::string(1'000'000, '['), Code::TooLarge);
    EXPECT_EQ(d.line, 1);
    EXPECT_EQ(d.column, 33);
    EXPECT_EQ(d.pointer.substr(0, 4), "/0/0");
    EXPECT_NE(d.message.find("at most 32"), std::string::npos);
}

TEST(JsonParser, aNodeBombIsRefused)
{
    const std::string row = "[" + repeated("1,", 999) + "1],";
    const Diagnostic d = refusal("[" + repeated(row, 99) + "1]", Code::TooLarge);
    EXPECT_NE(d.message.find("at most 65536"), std::string::npos);
}

TEST(JsonParser, memoryOfTheDocumentIsBounded)
{
    JsonLimits limits = kSceneLimits;
    limits.documentBytes = 1000;
    EXPECT_NE(
        refusal("[" + repeated("{\"a\":1},", 100) + "1]", Code::TooLarge, limits).message.find("memory"),
        std::string::npos);
}

TEST(JsonParser, aNameThatOccursTwiceIsRefusedWhereItOccursAgain)
{
    const Diagnostic d = refusal("{\n \"a\": 1,\n \"b\": {\"a\": 2},\n \"a\": 3\n}", Code::Schema);
    EXPECT_EQ(d.line, 4);
    EXPECT_EQ(d.column, 2);
    EXPECT_EQ(d.pointer, "/a");
}

TEST(JsonParser, notANumberIsRefusedInEverySpelling)
{
    for (const char* word : {"NaN", "nan", "Infinity", "-Infinity", "inf", "-inf"}) {
        const Diagnostic d = refusal(std::string("{\"a\": ") + word + "}", Code::Parse);
        EXPECT_NE(d.message.find("NaN and Infinity"), std::string::npos) << word << ": " << d.message;
        EXPECT_EQ(d.pointer, "/a");
        EXPECT_GE(d.column, 7);
    }
    refusal("[1e999]", Code::Parse);
}

TEST(JsonParser, textThatIsNotUtf8IsRefusedAndTheMessageIsUtf8AllTheSame)
{
    for (const char* bytes : {"\"\xFF\xFE\"", "\"\xC0\x80\"", "\"\xED\xA0\x80\"", "\xFF\xFE[1]"}) {
        const Diagnostic d = refusal(bytes, Code::Parse);
        EXPECT_EQ(printable(d.message, 10'000), d.message);
    }
}

TEST(JsonParser, commentsTrailingCommasAndSecondValuesAreNotJson)
{
    for (const char* text : {"[1,]", "{\"a\":1,}", "/* */ 1", "1 2", "'a'", "{a:1}", "", "[1", "[1 2]"})
        refusal(text, Code::Parse);
}

TEST(JsonLocator, findsValuesNamesAndElements)
{
    const std::string text = "{\n  \"a\": [10, 20,\n    {\"b\\u0063/~\": \"x\"}]\n}";
    const std::array<std::string, 4> pointers{"", "/a", "/a/1", "/a/2/bc~1~0"};
    const std::vector<JsonPlace> places = locateJson(text, pointers);
    EXPECT_EQ(places[0].value, 0u);
    EXPECT_EQ(places[1].key, text.find("\"a\""));
    EXPECT_EQ(places[1].value, text.find("[10"));
    EXPECT_EQ(places[2].value, text.find("20"));
    EXPECT_EQ(places[2].key, text.find("20"));
    EXPECT_EQ(places[3].key, text.find("\"b\\u0063"));
    EXPECT_EQ(places[3].value, text.find("\"x\""));
}

TEST(JsonLocator, whatDoesNotExistIsFoundAtItsNearestAncestor)
{
    const std::string text = "{\"a\": {\"b\": 1}}";
    const std::array<std::string, 1> pointers{"/a/c/d"};
    EXPECT_EQ(locateJson(text, pointers)[0].value, text.find("{\"b\""));
}
