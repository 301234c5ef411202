#include "fxsdk/livelink/protocol/link_message.h"

#include <gtest/gtest.h>

#include <string>

using namespace fx::link;
using fx::base::Code;

namespace {

Code refusal(const std::string& message)
{
    uint64_t id = 0;
    const auto request = parseRequest(message, id);
    EXPECT_TRUE(request.ok() || !request.status().message().empty());
    return request.status().code();
}

} // namespace

TEST(LinkMessage, requestsAreReadAsTheyAreWritten)
{
    uint64_t id = 0;
    const auto hello = parseRequest(textOf(helloMessage("secret")), id);
    ASSERT_TRUE(hello.ok());
    EXPECT_EQ(hello->type, RequestType::Hello);
    EXPECT_EQ(hello->protocol, kProtocol);
    EXPECT_EQ(hello->token, "secret");
    EXPECT_EQ(id, 0u);
    const std::string text = "{\n \"name\": \"\xC3\xA9\"\n}";
    const auto replace = parseRequest(textOf(replaceMessage(7, "fire.fx.json", text, true)), id);
    ASSERT_TRUE(replace.ok()) << replace.status().message();
    EXPECT_EQ(replace->type, RequestType::Replace);
    EXPECT_EQ(replace->preset, "fire.fx.json");
    EXPECT_EQ(replace->text, text);
    EXPECT_TRUE(replace->restarts);
    EXPECT_EQ(id, 7u);
}

TEST(LinkMessage, aRefusedRequestHasACodeAndKeepsItsNumber)
{
    EXPECT_EQ(refusal(""), Code::Parse);
    EXPECT_EQ(refusal("{\"type\":"), Code::Parse);
    EXPECT_EQ(refusal("{\"type\": \"\xFF\"}"), Code::Parse); // not UTF-8
    EXPECT_EQ(refusal("[]"), Code::Schema);
    EXPECT_EQ(refusal("{}"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": 3})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "drop"})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "hello"})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "hello", "protocol": -1})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "list", "type": "list"})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "replace", "preset": "a", "text": ""})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "replace", "preset": "", "text": "a"})"), Code::Schema);
    EXPECT_EQ(refusal(R"({"type": "replace", "preset": "a", "text": "a", "mode": "now"})"), Code::Schema);
    EXPECT_EQ(refusal(std::string(40, '[') + std::string(40, ']')), Code::TooLarge);
    uint64_t id = 0;
    EXPECT_FALSE(parseRequest(R"({"type": "drop", "id": 12})", id).ok());
    EXPECT_EQ(id, 12u);
}

TEST(LinkMessage, unknownMembersAreIgnored)
{
    EXPECT_EQ(refusal(R"({"type": "list", "id": 1, "color": [1, 2]})"), Code::Ok);
}

TEST(LinkMessage, repliesNeedATypeAndANumber)
{
    EXPECT_TRUE(parseReply(R"({"type": "list", "id": 3})").ok());
    EXPECT_FALSE(parseReply(R"({"id": 3})").ok());
    EXPECT_FALSE(parseReply(R"({"type": "list", "id": "3"})").ok());
    EXPECT_FALSE(parseReply("null").ok());
    EXPECT_EQ(errorMessage(0, "parse", "x").count("id"), 0u);
    EXPECT_EQ(errorMessage(4, "parse", "x")["id"], 4);
}
