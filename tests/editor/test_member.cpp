#include "fxsdk/editor/inspector/member.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fx::editor {
namespace {

Document documentOf(const std::string& text)
{
    auto document = Document::fromText(text, "a.fx.json");
    EXPECT_TRUE(document.ok());
    return std::move(*document);
}

TEST(Member, hasUnitRangeDefaultHelpAndCost)
{
    const Document document = documentOf(R"({"version": 1, "emitters": [{"radius": {"min": 1, "max": 2}}]})");
    const auto radius = memberAt(document, "/emitters/0/radius");
    ASSERT_TRUE(radius.has_value());
    EXPECT_EQ(radius->kind, MemberKind::Range);
    EXPECT_EQ(radius->unit, "m");
    EXPECT_EQ(radius->minimum, 0.0001);
    EXPECT_EQ(radius->maximum, 1000);
    EXPECT_EQ(radius->defaultValue, Json(0.5));
    EXPECT_FALSE(radius->help.empty());
    EXPECT_FALSE(radius->cost.empty());
    EXPECT_TRUE(radius->isPresent);
    EXPECT_TRUE(differsFromDefault(document, *radius));
}

TEST(Member, absentMembersHaveTheirDefault)
{
    const Document document = documentOf(R"({"version": 1, "emitters": [{}]})");
    const auto shape = memberAt(document, "/emitters/0/shape");
    ASSERT_TRUE(shape.has_value());
    EXPECT_FALSE(shape->isPresent);
    EXPECT_EQ(valueOf(document, *shape), Json("point"));
    EXPECT_NE(std::find(shape->choices.begin(), shape->choices.end(), "torus"), shape->choices.end());
    EXPECT_FALSE(memberAt(document, "/emitters/0/nothing").has_value());
}

TEST(Member, valuesOutOfTheSchemaAreRefused)
{
    const Document document = documentOf(R"({"version": 1, "emitters": [{}]})");
    const auto lifetime = memberAt(document, "/emitters/0/lifetime");
    EXPECT_TRUE(check(*lifetime, Json{{"min", 1}, {"max", 2}}).ok());
    EXPECT_NE(check(*lifetime, -1).message().find("from 0.01 to 3600"), std::string::npos);
    EXPECT_FALSE(check(*lifetime, Json{{"min", 1}}).ok());
    EXPECT_FALSE(check(*lifetime, "text").ok());
    EXPECT_EQ(limited(*lifetime, 9999), Json(3600.0));
    EXPECT_EQ(limited(*memberAt(document, "/emitters/0/maxParticles"), 12.6), Json(13));
}

TEST(Member, unknownMembersAreListed)
{
    const Document document = documentOf(R"({"version": 1, "emitters": [{"size": 1, "bogus": 2}]})");
    EXPECT_EQ(unknownMembersOf(document, "/emitters/0"), (std::vector<std::string>{"bogus"}));
}

} // namespace
} // namespace fx::editor
