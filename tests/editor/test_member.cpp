#include "fxsdk/editor/document/document_findings.h"
#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/inspector/new_element.h"

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

TEST(Member, theFirstNumberOfTheLightKeepsTheOthers)
{
    Document document = documentOf(R"({"version": 1, "emitters": [{}]})");
    const auto sun = memberAt(document, "/preview/lighting/sunIlluminance");
    ASSERT_TRUE(sun.has_value());
    EXPECT_EQ(valueOf(document, *sun), Json::array({40000, 34500, 27000}));
    EXPECT_TRUE(hasValue(document, *sun));
    ASSERT_TRUE(setMember(document, sun->pointer, Json::array({1, 2, 3})).ok());
    const Json& lighting = document.json()["preview"]["lighting"];
    EXPECT_EQ(lighting["sunIlluminance"], Json::array({1, 2, 3}));
    EXPECT_EQ(lighting["skyLuminance"], Json::array({2500, 3150, 4200}));
    EXPECT_TRUE(document.undo());
    EXPECT_FALSE(document.json().contains("preview"));
    ASSERT_TRUE(document.set("/preview", Json{{"lighting", {{"sunIlluminance", 5}}}}).ok());
    EXPECT_EQ(valueOf(document, *memberAt(document, "/preview/lighting/skyLuminance")), Json(0)); // as drawn
}

TEST(Member, placesWithoutADefaultBeginAtTheOriginAndHaveNoValue)
{
    const Document document =
        documentOf(R"({"version": 1, "preview": {"instance": {"keys": [{"time": 0}]}}})");
    const auto position = memberAt(document, "/preview/instance/keys/0/position");
    ASSERT_TRUE(position.has_value());
    EXPECT_EQ(valueOf(document, *position), Json::array({0, 0, 0}));
    EXPECT_FALSE(hasValue(document, *position));
}

TEST(NewElement, isLaterThanTheLastAndValid)
{
    Document document = documentOf(R"({"version": 1, "emitters": [{"name": "a"}, {"name": "b"}], "preview":
        {"instance": {"keys": [{"time": 2, "position": [1, 2, 3]}]}}})");
    const auto keys = memberAt(document, "/preview/instance/keys");
    ASSERT_TRUE(keys.has_value());
    EXPECT_EQ(*newElement(document, *keys), (Json{{"time", 3.0}, {"position", {1, 2, 3}}}));
    const auto events = memberAt(document, "/emitters/0/events");
    EXPECT_EQ((*newElement(document, *events))["emit"], "b");
    const auto triggers = memberAt(document, "/preview/instance/triggers");
    EXPECT_NE(newElement(document, *triggers).status().message().find("\"host\""), std::string::npos);
    ASSERT_TRUE(
        document.set("/emitters/0/events", Json::array({{{"on", "host"}, {"name", "go"}, {"cue", "c"}}}))
            .ok());
    EXPECT_EQ((*newElement(document, *triggers))["name"], "go");
}

TEST(NewElement, ofAnInstanceIsNotBeforeItsStart)
{
    const auto scene =
        Document::fromText(R"({"version": 1, "camera": {"position": [0, 1, 9], "target": [0, 1, 0]},
        "instances": [{"preset": "library:sparks", "start": 2}]})",
                           "a.scene.json");
    ASSERT_TRUE(scene.ok());
    const auto triggers = memberAt(*scene, "/instances/0/triggers");
    ASSERT_TRUE(triggers.has_value());
    const auto made = newElement(*scene, *triggers); // the events of the preset are not in the document
    ASSERT_TRUE(made.ok()) << made.status().message();
    EXPECT_EQ((*made)["time"], 2.0);
}

/// Adds an element twice to each array below an object, and expects no error.
void addToArrays(Document& io, const std::string& pointer, size_t& ioArrays)
{
    for (const Member& member : membersOf(io, pointer)) {
        if (member.kind == MemberKind::Object)
            addToArrays(io, member.pointer, ioArrays);
        const bool needsFile = member.name == "vectorFields"; // the name of its file cannot be guessed
        if (member.kind != MemberKind::Array || needsFile)
            continue;
        const size_t done = io.history().done();
        for (size_t added = 0; added < 2; ++added) {
            const base::Status status = addElement(io, member);
            if (!status) { // it says what it needs first, or that there is no room
                EXPECT_NE(status.message().find(member.pointer), std::string::npos) << status.message();
                continue;
            }
            for (const DocumentFinding& finding : findingsOf(io))
                if (!finding.diagnostic.warning)
                    ADD_FAILURE() << toString(finding.diagnostic) << "\n" << io.json().dump();
        }
        ++ioArrays;
        while (io.history().done() > done)
            io.undo();
    }
}

TEST(NewElement, makesNoErrors)
{
    Document document = documentOf(R"({"version": 1, "emitters": [{"name": "a", "emission": {"rate": 5}},
        {"name": "b", "emission": {"rate": 5}}],
        "preview": {"camera": {"position": [0, 1, 6], "target": [0, 1, 0]}, "instance": {}}})");
    size_t arrays = 0;
    addToArrays(document, "/emitters/0", arrays);
    addToArrays(document, "/preview", arrays);
    EXPECT_GT(arrays, 6u);
}

TEST(Member, unknownMembersAreListed)
{
    const Document document = documentOf(R"({"version": 1, "emitters": [{"size": 1, "bogus": 2}]})");
    EXPECT_EQ(unknownMembersOf(document, "/emitters/0"), (std::vector<std::string>{"bogus"}));
}

} // namespace
} // namespace fx::editor
